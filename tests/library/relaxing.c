/* Sites that move. */
#include "promise.h"

static int32_t stop_at_once(void* user, const char* stage, double fraction) {
  (void)user;
  (void)stage;
  (void)fraction;
  return 1;
}

static const double* numbers(const vorpipe_relaxation* relaxation, vorpipe_relaxation_field field,
                             uint64_t rows) {
  vorpipe_array array = {NULL, 0, 0, 0};
  DONE(vorpipe_relaxation_array(relaxation, field, &array));
  PROMISE(array.count == rows && array.type == VORPIPE_DOUBLE);
  return array.data;
}

/* Step by step and all at once come to the same places; the energy falls. */
static void steps(vorpipe_session* session, const vorpipe_input* input) {
  vorpipe_relax_options options = {sizeof options};
  vorpipe_relaxation *whole = NULL, *slow = NULL;
  vorpipe_report report = {sizeof report};
  vorpipe_array taken = {NULL, 0, 0, 0};
  const double* trace;
  int32_t more = 1;
  int diagrams = 0;
  options.method = VORPIPE_RELAX_LLOYD;
  options.iterations = 5;
  DONE(vorpipe_relax(session, input, &options, &whole));
  DONE(vorpipe_relax_begin(session, input, &options, &slow));
  while (more != 0) {
    DONE(vorpipe_relaxation_step(slow, &more));
    diagrams += more;
  }
  PROMISE(diagrams == 5);
  PROMISE(vorpipe_relaxation_end(whole) == VORPIPE_RELAX_ITERATIONS);
  trace = numbers(whole, VORPIPE_RELAXED_TRACE, 6);
  PROMISE(trace[0] == 0 && trace[25] == 5);
  PROMISE(trace[6] < trace[1] && trace[26] < trace[21]);
  DONE(vorpipe_relaxation_array(whole, VORPIPE_RELAXED_TAKEN, &taken));
  PROMISE(taken.count == 6 && taken.type == VORPIPE_UINT8 && ((const uint8_t*)taken.data)[5] == 1);
  PROMISE(memcmp(numbers(whole, VORPIPE_RELAXED_SITES, 100), numbers(slow, VORPIPE_RELAXED_SITES, 100),
                 200 * sizeof(double)) == 0);
  DONE(vorpipe_relaxation_report(whole, &report));
  PROMISE(report.ok == 100 && vorpipe_relaxation_note(whole, 0) == NULL);
  vorpipe_relaxation_free(whole);
  vorpipe_relaxation_free(slow);
  vorpipe_relaxation_free(NULL);
}

/* What was reached is an input in the same domain, and a file. */
static void results(vorpipe_session* session, const vorpipe_input* input) {
  vorpipe_relaxation* relaxation = NULL;
  vorpipe_input *moved = NULL, *read = NULL;
  vorpipe_diagram* diagram = NULL;
  double before[4], after[4];
  DONE(vorpipe_relax(session, input, NULL, &relaxation));
  DONE(vorpipe_relaxation_input(relaxation, &moved));
  DONE(vorpipe_input_domain(input, before));
  DONE(vorpipe_input_domain(moved, after));
  PROMISE(memcmp(before, after, sizeof before) == 0);
  DONE(vorpipe_cells(session, moved, NULL, &diagram));
  PROMISE(vorpipe_diagram_area_sum(diagram) > 0);
  DONE(vorpipe_relaxation_save(relaxation, "relaxed.csv"));
  DONE(vorpipe_input_read("relaxed.csv", 1, &read));
  PROMISE(vorpipe_input_count(read) == 100);
  REFUSED(VORPIPE_INPUT, "relaxed.png", vorpipe_relaxation_save(relaxation, "relaxed.png"));
  REFUSED(VORPIPE_INPUT, "array", vorpipe_relaxation_array(relaxation, 1, NULL));
  vorpipe_diagram_free(diagram);
  vorpipe_input_free(read);
  vorpipe_input_free(moved);
  vorpipe_relaxation_free(relaxation);
}

void relaxing_promises(vorpipe_session* session) {
  vorpipe_relax_options options = {sizeof options};
  vorpipe_relaxation* relaxation = NULL;
  vorpipe_input* input = NULL;
  DONE(vorpipe_input_read("random:100", 3, &input));
  steps(session, input);
  results(session, input);
  options.progress = stop_at_once;
  REFUSED(VORPIPE_CANCELLED, "", vorpipe_relax(session, input, &options, &relaxation));
  PROMISE(relaxation == NULL);
  options.progress = NULL;
  options.method = 7;
  REFUSED(VORPIPE_INPUT, "method", vorpipe_relax_begin(session, input, &options, &relaxation));
  PROMISE(relaxation == NULL);
  vorpipe_input_free(input);
}

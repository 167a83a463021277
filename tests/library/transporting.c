/* Weights for masses that are prescribed. */
#include <math.h>

#include "promise.h"

static const void* values(const vorpipe_transported* transported, vorpipe_transported_field field,
                          uint64_t rows, int32_t columns) {
  vorpipe_array array = {NULL, 0, 0, 0};
  DONE(vorpipe_transported_array(transported, field, &array));
  PROMISE(array.count == rows && array.columns == columns);
  return array.data;
}

/* Whether each of 100 cells has its mass. */
static int is_even(const double* masses, double each) {
  int k, even = 1;
  for (k = 0; k < 100; ++k) even = even && fabs(masses[k] - each) <= 1e-8 * each;
  return even;
}

static int32_t count_steps(void* user, const vorpipe_transport_step* step) {
  uint64_t* steps = user;
  PROMISE(step->struct_size == sizeof *step && step->diagram == *steps);
  ++*steps;
  return 0;
}

static int32_t stop_at_second(void* user, const vorpipe_transport_step* step) {
  (void)user;
  return step->diagram >= 1;
}

/* Equal areas; and with the weights that were found there is nothing left to do. */
static void equal_areas(vorpipe_session* session, vorpipe_input* input) {
  vorpipe_transport_options options = {sizeof options};
  vorpipe_transported *found = NULL, *again = NULL;
  vorpipe_report report = {sizeof report};
  vorpipe_input* weighted = NULL;
  vorpipe_diagram* diagram = NULL;
  vorpipe_array areas = {NULL, 0, 0, 0};
  const double* trace;
  uint64_t steps = 0;
  options.watch = count_steps;
  options.watch_user = &steps;
  DONE(vorpipe_transport(session, input, &options, &found));
  PROMISE(vorpipe_transported_end(found) == VORPIPE_TRANSPORT_CONVERGED && steps > 1);
  trace = values(found, VORPIPE_TRANSPORTED_TRACE, steps, 9);
  PROMISE(trace[9 * (steps - 1) + 5] <= 1e-8 && trace[9 * (steps - 1) + 3] == 1);
  PROMISE(is_even(values(found, VORPIPE_TRANSPORTED_MASSES, 100, 1), 0.01));
  values(found, VORPIPE_TRANSPORTED_CENTROIDS, 100, 2);
  values(found, VORPIPE_TRANSPORTED_STATUS, 100, 1);
  DONE(vorpipe_transported_report(found, &report));
  PROMISE(report.ok == 100 && vorpipe_transported_note(found, 0) == NULL);
  PROMISE(vorpipe_transported_cost(found) > 0);
  DONE(vorpipe_transported_input(found, &weighted));
  DONE(vorpipe_cells(session, weighted, NULL, &diagram));
  DONE(vorpipe_diagram_array(diagram, VORPIPE_CELL_AREA, &areas));
  PROMISE(is_even(areas.data, 0.01));
  DONE(vorpipe_transport(session, weighted, NULL, &again));
  trace = values(again, VORPIPE_TRANSPORTED_TRACE, 1, 9);
  PROMISE(trace[1] == 0);
  DONE(vorpipe_transported_save(found, "transported.csv"));
  REFUSED(VORPIPE_INPUT, "transported.png", vorpipe_transported_save(found, "transported.png"));
  vorpipe_diagram_free(diagram);
  vorpipe_input_free(weighted);
  vorpipe_transported_free(again);
  vorpipe_transported_free(found);
  vorpipe_transported_free(NULL);
}

/* Masses as parts of each other; a free surface; what ends early has what was reached. */
static void other_masses(vorpipe_session* session, const vorpipe_input* input) {
  vorpipe_transport_options options = {sizeof options};
  vorpipe_transported* found = NULL;
  double masses[100];
  const double* areas;
  int k;
  for (k = 0; k < 100; ++k) masses[k] = 1 + k % 4;
  options.masses = masses;
  options.mass_count = 100;
  options.normalize = 1;
  DONE(vorpipe_transport(session, input, &options, &found));
  areas = values(found, VORPIPE_TRANSPORTED_AREAS, 100, 1);
  for (k = 0; k < 100; ++k) PROMISE(fabs(areas[k] - masses[k] / 250) < 1e-9);
  vorpipe_transported_free(found);
  options.masses = NULL;
  options.mass_count = 0;
  options.normalize = 0;
  options.fill = 0.3;
  DONE(vorpipe_transport(session, input, &options, &found));
  PROMISE(is_even(values(found, VORPIPE_TRANSPORTED_AREAS, 100, 1), 0.003));
  vorpipe_transported_free(found);
  options.fill = 0;
  options.watch = stop_at_second;
  DONE(vorpipe_transport(session, input, &options, &found));
  PROMISE(vorpipe_transported_end(found) == VORPIPE_TRANSPORT_CANCELLED);
  values(found, VORPIPE_TRANSPORTED_WEIGHTS, 100, 1);
  vorpipe_transported_free(found);
}

static void refused_masses(vorpipe_session* session, const vorpipe_input* input) {
  vorpipe_transport_options options = {sizeof options};
  vorpipe_transported* found = NULL;
  double masses[100] = {0};
  options.masses = masses;
  options.mass_count = 99;
  REFUSED(VORPIPE_INPUT, "99", vorpipe_transport(session, input, &options, &found));
  options.mass_count = 100;
  REFUSED(VORPIPE_INPUT, "site 0", vorpipe_transport(session, input, &options, &found));
  PROMISE(vorpipe_last_subject() == VORPIPE_SUBJECT_MASSES);
  options.masses = NULL;
  REFUSED(VORPIPE_INPUT, "masses", vorpipe_transport(session, input, &options, &found));
  options.mass_count = 0;
  options.fill = 1.5;
  REFUSED(VORPIPE_INPUT, "fill", vorpipe_transport(session, input, &options, &found));
  options.fill = 0.5;
  options.normalize = 1;
  REFUSED(VORPIPE_INPUT, "normalize", vorpipe_transport(session, input, &options, &found));
  REFUSED(VORPIPE_INPUT, "session", vorpipe_transport(NULL, input, NULL, &found));
  REFUSED(VORPIPE_INPUT, "transported", vorpipe_transported_array(NULL, 1, NULL));
  PROMISE(found == NULL);
}

void transporting_promises(vorpipe_session* session) {
  vorpipe_input* input = NULL;
  DONE(vorpipe_input_read("random:100", 3, &input));
  DONE(vorpipe_input_set_box(input, 0, 0, 1, 1, 0));
  equal_areas(session, input);
  other_masses(session, input);
  refused_masses(session, input);
  vorpipe_input_free(input);
}

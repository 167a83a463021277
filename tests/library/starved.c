/* What there is no memory for: run with refusals.so before it. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <string.h>

#include "promise.h"
#include "vorpipe_c.h"

int broken_promises = 0;

static void (*refuse)(long nth, int all);

/* The first call of a thread that fails. */
static void first_failure(void) {
  vorpipe_input* input = NULL;
  refuse(1, 1);
  REFUSED(VORPIPE_DEVICE, "memory", vorpipe_input_read("random:10", 1, &input));
  refuse(0, 0);
  PROMISE(input == NULL);
}

/* A step that was refused memory, and that for its message, has not been. */
static void relaxation(void) {
  vorpipe_session_options options = {sizeof options};
  vorpipe_session* session = NULL;
  vorpipe_input* input = NULL;
  vorpipe_relaxation* moves = NULL;
  int32_t more = 1;
  options.backend = "cpu";
  options.threads = 1;
  DONE(vorpipe_session_open(&options, &session));
  DONE(vorpipe_input_read("random:25", 1, &input));
  DONE(vorpipe_relax_begin(session, input, NULL, &moves));
  refuse(1, 1);
  PROMISE(vorpipe_relaxation_step(moves, &more) == VORPIPE_DEVICE);
  refuse(0, 0);
  DONE(vorpipe_relaxation_step(moves, &more));
  PROMISE(more == 1);
  vorpipe_relaxation_free(moves);
  vorpipe_input_free(input);
  vorpipe_session_free(session);
}

/* An outline is not wrong where there is no memory to check it. */
static void outline(void) {
  const double ring[] = {1, 1, 9, 1, 9, 9, 8, 5, 1, 9};
  const uint64_t rings[] = {0, 5}, polygons[] = {0, 1};
  vorpipe_outline given = {sizeof given};
  vorpipe_code code = VORPIPE_DEVICE;
  long nth;
  given.point_count = 5;
  given.ring_count = given.polygon_count = 1;
  given.points = ring;
  given.ring_offsets = rings;
  given.polygon_offsets = polygons;
  for (nth = 1; code != VORPIPE_DONE; ++nth) {
    double box[4];
    vorpipe_input* input = NULL;
    DONE(vorpipe_input_read("random:10", 1, &input));
    DONE(vorpipe_input_set_outline(input, &given));
    refuse(nth, 0);
    code = vorpipe_input_domain(input, box);
    refuse(0, 0);
    PROMISE(code == VORPIPE_DONE || code == VORPIPE_DEVICE);
    vorpipe_input_free(input);
  }
  PROMISE(nth > 20);
}

int main(void) {
  *(void**)&refuse = dlsym(RTLD_DEFAULT, "vorpipe_refuse_memory");
  if (refuse == NULL) return 1;
  first_failure();
  relaxation();
  outline();
  return broken_promises != 0;
}

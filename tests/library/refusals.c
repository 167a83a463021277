/* Bad input gets a code, a line that names it, and what it is about; nothing is written. */
#include <math.h>
#include <stdlib.h>

#include "promise.h"

static void structs(vorpipe_session* session, const vorpipe_input* input) {
  struct {
    vorpipe_cells_options known;
    int32_t from_the_future;
  } newer;
  vorpipe_cells_options options = {0};
  vorpipe_diagram* diagram = NULL;
  vorpipe_report report = {0};
  memset(&newer, 0, sizeof newer);
  REFUSED(VORPIPE_INPUT, "struct_size", vorpipe_cells(session, input, &options, &diagram));
  newer.known.struct_size = sizeof newer;
  DONE(vorpipe_cells(session, input, &newer.known, &diagram));
  REFUSED(VORPIPE_INPUT, "struct_size", vorpipe_diagram_report(diagram, &report));
  /* A program that was built when the report ended earlier. */
  memset(&report, 0xFF, sizeof report);
  report.struct_size = (uint32_t)((char*)&report.ok - (char*)&report);
  DONE(vorpipe_diagram_report(diagram, &report));
  PROMISE(strcmp(report.backend, "cpu") == 0 && report.ok == UINT64_MAX);
  vorpipe_diagram_free(diagram);
  diagram = NULL;
  newer.from_the_future = 1;
  REFUSED(VORPIPE_INPUT, "does not know", vorpipe_cells(session, input, &newer.known, &diagram));
  options.struct_size = sizeof options;
  options.detail = 77;
  REFUSED(VORPIPE_INPUT, "detail", vorpipe_cells(session, input, &options, &diagram));
  PROMISE(diagram == NULL);
}

static void sites(vorpipe_session* session) {
  double x[] = {0, 1}, y[] = {0, NAN};
  vorpipe_sites given = {sizeof given};
  vorpipe_input* input = NULL;
  vorpipe_diagram* diagram = NULL;
  given.count = 2;
  given.x = x;
  REFUSED(VORPIPE_INPUT, "y: is NULL", vorpipe_input_create(&given, &input));
  given.y = y;
  REFUSED(VORPIPE_INPUT, "site 1 is not finite", vorpipe_input_create(&given, &input));
  PROMISE(vorpipe_last_subject() == VORPIPE_SUBJECT_SITES && input == NULL);
  given.count = UINT64_MAX;
  REFUSED(VORPIPE_INPUT, "of at most", vorpipe_input_create(&given, &input));
  given.count = 0;
  DONE(vorpipe_input_create(&given, &input));
  PROMISE(vorpipe_cells(session, input, NULL, &diagram) == VORPIPE_INPUT);
  vorpipe_input_free(input);
  input = NULL;
  REFUSED(VORPIPE_INPUT, "nowhere.csv", vorpipe_input_read("nowhere.csv", 1, &input));
  REFUSED(VORPIPE_INPUT, "sites: is NULL", vorpipe_input_read(NULL, 1, &input));
}

struct nested {
  vorpipe_session* session;
  const vorpipe_input* input;
  int refused, done;
};

/* Progress that runs its own session. */
static int32_t run_again(void* user, const char* stage, double fraction) {
  struct nested* nested = user;
  vorpipe_diagram* diagram = NULL;
  vorpipe_picture* picture = NULL;
  vorpipe_relaxation* relaxation = NULL;
  vorpipe_fluid* fluid = NULL;
  (void)stage;
  (void)fraction;
  REFUSED(VORPIPE_DEVICE, "busy", vorpipe_cells(nested->session, nested->input, NULL, &diagram));
  REFUSED(VORPIPE_DEVICE, "busy", vorpipe_render(nested->session, nested->input, NULL, &picture));
  REFUSED(VORPIPE_DEVICE, "busy", vorpipe_draw_save(nested->session, nested->input, NULL, "busy.svg"));
  REFUSED(VORPIPE_DEVICE, "busy", vorpipe_relax(nested->session, nested->input, NULL, &relaxation));
  REFUSED(VORPIPE_DEVICE, "busy", vorpipe_fluid_read(nested->session, "shear", 16, NULL, &fluid));
  PROMISE(diagram == NULL && picture == NULL && relaxation == NULL && fluid == NULL);
  ++nested->refused;
  return 0;
}

static int32_t run_between(void* user, const vorpipe_fluid_figures* figures) {
  struct nested* nested = user;
  vorpipe_diagram* diagram = NULL;
  (void)figures;
  DONE(vorpipe_cells(nested->session, nested->input, NULL, &diagram));
  vorpipe_diagram_free(diagram);
  ++nested->done;
  return 0;
}

/* A session has one run at a time; between the steps of a fluid it is free. */
static void busy_sessions(vorpipe_session* session, const vorpipe_input* input) {
  struct nested nested = {session, input, 0, 0};
  vorpipe_cells_options cells = {sizeof cells};
  vorpipe_relax_options moves = {sizeof moves};
  vorpipe_transport_options masses = {sizeof masses};
  vorpipe_fluid_options flows = {sizeof flows};
  vorpipe_fluid_run_options steps = {sizeof steps};
  vorpipe_diagram* diagram = NULL;
  vorpipe_relaxation* relaxation = NULL;
  vorpipe_transported* found = NULL;
  vorpipe_fluid* fluid = NULL;
  cells.progress = moves.progress = masses.progress = flows.progress = run_again;
  cells.progress_user = moves.progress_user = masses.progress_user = flows.progress_user = &nested;
  moves.iterations = masses.diagrams = 2;
  DONE(vorpipe_cells(session, input, &cells, &diagram));
  PROMISE(nested.refused > 0);
  nested.refused = 0;
  DONE(vorpipe_relax(session, input, &moves, &relaxation));
  PROMISE(nested.refused > 0);
  nested.refused = 0;
  DONE(vorpipe_transport(session, input, &masses, &found));
  PROMISE(nested.refused > 0);
  nested.refused = 0;
  DONE(vorpipe_fluid_read(session, "shear", 16, &flows, &fluid));
  steps.steps = 2;
  steps.watch = run_between;
  steps.watch_user = &nested;
  DONE(vorpipe_fluid_run(fluid, &steps));
  PROMISE(nested.refused > 0 && nested.done == 2);
  vorpipe_fluid_free(fluid);
  vorpipe_transported_free(found);
  vorpipe_relaxation_free(relaxation);
  vorpipe_diagram_free(diagram);
}

/* A message that is too long to be kept ends so. */
static void long_messages(void) {
  char path[10000];
  vorpipe_input* input = NULL;
  size_t k;
  for (k = 0; k + 1 < sizeof path; ++k) path[k] = k % 3 == 0 ? '\xE2' : k % 3 == 1 ? '\x82' : '\xAC';
  path[sizeof path - 1] = 0;
  REFUSED(VORPIPE_INPUT, "\xE2\x82\xAC...", vorpipe_input_read(path, 1, &input));
  PROMISE(strlen(vorpipe_last_error()) < sizeof path);
}

void refusals(vorpipe_session* session) {
  const double weights[] = {1, 2};
  vorpipe_session_options options = {sizeof options};
  vorpipe_session* none = NULL;
  vorpipe_input* input = NULL;
  vorpipe_diagram* diagram = NULL;
  vorpipe_picture* picture = NULL;
  vorpipe_render_options render = {sizeof render};
  vorpipe_array array;
  const char* disabled = "noSuchFeature";
  options.backend = "gpu";
  REFUSED(VORPIPE_INPUT, "gpu", vorpipe_session_open(&options, &none));
  options.backend = "cpu";
  options.disabled_count = 1;
  options.disabled = &disabled;
  REFUSED(VORPIPE_INPUT, "noSuchFeature", vorpipe_session_open(&options, &none));
  PROMISE(none == NULL);
  sites(session);
  DONE(vorpipe_input_read("random:10", 1, &input));
  structs(session, input);
  busy_sessions(session, input);
  long_messages();
  REFUSED(VORPIPE_INPUT, "2 for 10", vorpipe_input_set_weights(input, weights, 2));
  PROMISE(vorpipe_last_subject() == VORPIPE_SUBJECT_WEIGHTS);
  REFUSED(VORPIPE_INPUT, "from 2 to 1", vorpipe_input_random_weights(input, 2, 1, 1));
  REFUSED(VORPIPE_INPUT, "from -1e+308 to", vorpipe_input_random_weights(input, -1e308, 1e308, 1));
  REFUSED(VORPIPE_INPUT, "periodic", vorpipe_input_set_box(input, 0, 0, 1, 1, 4));
  render.width = -1;
  render.height = 5;
  PROMISE(vorpipe_render(session, input, &render, &picture) == VORPIPE_INPUT);
  render.width = 5;
  render.colormap = "gray50";
  REFUSED(VORPIPE_INPUT, "gray50", vorpipe_render(session, input, &render, &picture));
  render.colormap = NULL;
  render.color = VORPIPE_BY_WEIGHT;
  REFUSED(VORPIPE_INPUT, "weight", vorpipe_render(session, input, &render, &picture));
  DONE(vorpipe_cells(session, input, NULL, &diagram));
  REFUSED(VORPIPE_INPUT, "field", vorpipe_diagram_array(diagram, 999, &array));
  REFUSED(VORPIPE_INPUT, "cells.xls", vorpipe_diagram_save(diagram, "cells.xls"));
  REFUSED(VORPIPE_INPUT, "nowhere", vorpipe_diagram_save(diagram, "nowhere/cells.csv"));
  DONE(vorpipe_input_set_box(input, 1, 1, 0, 0, VORPIPE_PERIODIC_NONE));
  vorpipe_diagram_free(diagram);
  diagram = NULL;
  PROMISE(vorpipe_cells(session, input, NULL, &diagram) == VORPIPE_INPUT);
  PROMISE(vorpipe_last_subject() == VORPIPE_SUBJECT_DOMAIN && diagram == NULL);
  REFUSED(VORPIPE_INPUT, "session: is NULL", vorpipe_cells(NULL, input, NULL, &diagram));
  vorpipe_input_free(input);
}

/* Fluids, and the cells of free surfaces. */
#include <math.h>

#include "promise.h"

static const double* values(const vorpipe_fluid* fluid, vorpipe_fluid_field field, uint64_t rows,
                            int32_t columns) {
  vorpipe_array array = {NULL, 0, 0, 0};
  DONE(vorpipe_fluid_array(fluid, field, &array));
  PROMISE(array.count == rows && array.columns == columns);
  return array.data;
}

static uint64_t rows_of(const vorpipe_diagram* diagram, vorpipe_diagram_field field, const void** data) {
  vorpipe_array array = {NULL, 0, 0, 0};
  DONE(vorpipe_diagram_array(diagram, field, &array));
  if (data != NULL) *data = array.data;
  return array.count;
}

/* Stops after the third step. */
static int32_t until_three(void* user, const vorpipe_fluid_figures* figures) {
  uint64_t* calls = user;
  PROMISE(figures->struct_size == sizeof *figures && figures->step == ++*calls);
  return figures->step == 3;
}

static int32_t refuse_progress(void* user, const char* stage, double fraction) {
  (void)stage;
  (void)fraction;
  return *(int*)user;
}

/* A vortex that keeps its energy; what is saved goes on to the same bytes. */
static void steps_of_a_vortex(vorpipe_session* session) {
  vorpipe_fluid_options options = {sizeof options};
  vorpipe_fluid_run_options run = {sizeof run};
  vorpipe_fluid_figures figures = {sizeof figures};
  vorpipe_fluid *fluid = NULL, *again = NULL;
  vorpipe_report report = {sizeof report};
  double before[200], start;
  int32_t more = 0;
  uint64_t calls = 0;
  int k;
  options.scheme = VORPIPE_FLUID_PROJECTION;
  options.step = 0.02;
  DONE(vorpipe_fluid_read(session, "taylor-green", 100, &options, &fluid));
  DONE(vorpipe_fluid_last(fluid, &figures));
  start = figures.energy;
  PROMISE(figures.step == 0 && start > 0.2 && figures.energy == figures.kinetic);
  DONE(vorpipe_fluid_step(fluid, &figures, &more));
  PROMISE(more == 1 && figures.step == 1 && fabs(figures.time - 0.02) < 1e-15 && figures.worst <= 1e-6);
  DONE(vorpipe_fluid_save(fluid, "vortex.npz"));
  DONE(vorpipe_fluid_read(session, "vortex.npz", 0, NULL, &again));
  run.has_until = 1;
  run.until = 0.09;
  DONE(vorpipe_fluid_run(fluid, &run));
  DONE(vorpipe_fluid_run(again, &run));
  PROMISE(vorpipe_fluid_ended(fluid) == VORPIPE_FLUID_TIME);
  DONE(vorpipe_fluid_last(fluid, &figures));
  PROMISE(figures.time == 0.09 && figures.step == 5 && fabs(figures.energy / start - 1) < 0.01);
  PROMISE(memcmp(values(fluid, VORPIPE_FLUID_SITES, 100, 2), values(again, VORPIPE_FLUID_SITES, 100, 2),
                 sizeof before) == 0);
  PROMISE(memcmp(values(fluid, VORPIPE_FLUID_PRESSURES, 100, 1),
                 values(again, VORPIPE_FLUID_PRESSURES, 100, 1), sizeof before / 2) == 0);
  values(fluid, VORPIPE_FLUID_WEIGHTS, 100, 1);
  values(fluid, VORPIPE_FLUID_DENSITIES, 0, 1);
  DONE(vorpipe_fluid_report(fluid, &report));
  PROMISE(report.ok == 100 && vorpipe_fluid_note(fluid, 0) == NULL);
  memcpy(before, values(fluid, VORPIPE_FLUID_VELOCITIES, 100, 2), sizeof before);
  DONE(vorpipe_fluid_push(fluid, before, 100));
  for (k = 0; k < 200; ++k) {
    PROMISE(values(fluid, VORPIPE_FLUID_VELOCITIES, 100, 2)[k] == 2 * before[k]);
  }
  DONE(vorpipe_fluid_save(fluid, "vortex.csv"));
  REFUSED(VORPIPE_INPUT, "vortex.png", vorpipe_fluid_save(fluid, "vortex.png"));
  vorpipe_fluid_free(again);
  vorpipe_fluid_free(fluid);
  vorpipe_fluid_free(NULL);
  DONE(vorpipe_fluid_read(session, "shear", 64, NULL, &fluid));
  run.has_until = 0;
  run.watch = until_three;
  run.watch_user = &calls;
  DONE(vorpipe_fluid_run(fluid, &run));
  PROMISE(calls == 3 && vorpipe_fluid_ended(fluid) == VORPIPE_FLUID_GOES_ON);
  run.watch = NULL;
  run.has_until = 1;
  run.until = 0.2;
  DONE(vorpipe_fluid_run(fluid, &run));
  run.has_until = 0;
  REFUSED(VORPIPE_INPUT, "until", vorpipe_fluid_run(fluid, &run));
  run.steps = 1;
  DONE(vorpipe_fluid_run(fluid, &run));
  DONE(vorpipe_fluid_last(fluid, &figures));
  PROMISE(figures.time > 0.2);
  vorpipe_fluid_free(fluid);
}

#ifndef HEADER_OF_0_1
/* The energy of a vortex decays by exp(-4 pi^2 viscosity time). */
static void friction(vorpipe_session* session) {
  vorpipe_fluid_options options = {sizeof options};
  vorpipe_fluid_run_options run = {sizeof run};
  vorpipe_fluid_figures figures = {sizeof figures};
  vorpipe_fluid* fluid = NULL;
  double start;
  options.viscosity = 0.05;
  DONE(vorpipe_fluid_read(session, "taylor-green", 256, &options, &fluid));
  DONE(vorpipe_fluid_last(fluid, &figures));
  start = figures.kinetic;
  run.has_until = 1;
  run.until = 0.2;
  DONE(vorpipe_fluid_run(fluid, &run));
  DONE(vorpipe_fluid_last(fluid, &figures));
  PROMISE(fabs(log(start / figures.kinetic) / 0.39478 - 1) < 0.02);
  PROMISE(vorpipe_fluid_velocity_error(fluid) > 0 && vorpipe_fluid_velocity_error(fluid) < 0.1);
  PROMISE(isnan(vorpipe_fluid_velocity_error(NULL)));
  vorpipe_fluid_free(fluid);
  options.viscosity = 0;
  options.centering = -1;
  REFUSED(VORPIPE_INPUT, "centering", vorpipe_fluid_read(session, "taylor-green", 256, &options, &fluid));
  options.centering = 0;
  options.walls = VORPIPE_WALLS_NO_SLIP;
  REFUSED(VORPIPE_INPUT, "walls", vorpipe_fluid_read(session, "taylor-green", 256, &options, &fluid));
}
#endif

/* A step that is cancelled has not been; the fluid goes on as if nothing had happened. */
static void cancelled_step(vorpipe_session* session) {
  vorpipe_fluid_options options = {sizeof options};
  vorpipe_fluid_run_options run = {sizeof run};
  vorpipe_fluid *fluid = NULL, *other = NULL;
  int refuses = 0;
  int32_t more = 1;
  options.step = 0.01;
  DONE(vorpipe_fluid_read(session, "taylor-green", 100, &options, &other));
  options.progress = refuse_progress;
  options.progress_user = &refuses;
  DONE(vorpipe_fluid_read(session, "taylor-green", 100, &options, &fluid));
  run.steps = 2;
  DONE(vorpipe_fluid_run(fluid, &run));
  refuses = 1;
  DONE(vorpipe_fluid_step(fluid, NULL, &more));
  PROMISE(more == 0 && vorpipe_fluid_ended(fluid) == VORPIPE_FLUID_CANCELLED);
  refuses = 0;
  DONE(vorpipe_fluid_run(fluid, &run));
  run.steps = 4;
  DONE(vorpipe_fluid_run(other, &run));
  PROMISE(memcmp(values(fluid, VORPIPE_FLUID_SITES, 100, 2), values(other, VORPIPE_FLUID_SITES, 100, 2),
                 200 * sizeof(double)) == 0);
  vorpipe_fluid_free(fluid);
  vorpipe_fluid_free(other);
}

/* Whether the parts of borders close around each cell. */
static int are_closed(const vorpipe_diagram* diagram) {
  const void *offsets = NULL, *parts = NULL, *neighbors = NULL;
  uint64_t i, k, cells = rows_of(diagram, VORPIPE_BORDER_OFFSETS, &offsets) - 1, arcs = 0;
  rows_of(diagram, VORPIPE_BORDER_PARTS, &parts);
  rows_of(diagram, VORPIPE_BORDER_NEIGHBORS, &neighbors);
  for (i = 0; i < cells; ++i) {
    const uint64_t begin = ((const uint64_t*)offsets)[i], end = ((const uint64_t*)offsets)[i + 1];
    for (k = begin; k < end; ++k) {
      const double* part = (const double*)parts + 5 * k;
      const double* next = (const double*)parts + 5 * (k + 1 < end ? k + 1 : begin);
      if (part[2] != next[0] || part[3] != next[1]) return 0;
      if ((part[4] > 0) != (((const int64_t*)neighbors)[k] == VORPIPE_WALL_OUTLINE)) return 0;
      arcs += part[4] > 0;
    }
  }
  return arcs > 0;
}

/* The cells of what falls, those of a transport with air, and what has air around it. */
static void cells_with_air(vorpipe_session* session) {
  vorpipe_transport_options options = {sizeof options};
  vorpipe_render_options looks = {sizeof looks};
  vorpipe_input *input = NULL, *filled = NULL;
  vorpipe_transported* found = NULL;
  vorpipe_fluid* fluid = NULL;
  vorpipe_diagram* cells = NULL;
  vorpipe_picture* picture = NULL;
  vorpipe_locator* locator = NULL;
  vorpipe_array ids = {NULL, 0, 0, 0};
  const double corner[2] = {3.9, 2.9};
  uint32_t site = 0;
  uint64_t k, air = 0;
  DONE(vorpipe_fluid_read(session, "dam-break", 100, NULL, &fluid));
  DONE(vorpipe_fluid_step(fluid, NULL, NULL));
  DONE(vorpipe_fluid_input(fluid, &input));
  DONE(vorpipe_cells(session, input, NULL, &cells));
  PROMISE(fabs(vorpipe_diagram_area_sum(cells) - 2) < 1e-5 && are_closed(cells));
  REFUSED(VORPIPE_INPUT, "free surface", vorpipe_diagram_check(cells, 0, NULL, NULL));
  DONE(vorpipe_locator_create(input, 0, &locator));
  DONE(vorpipe_locator_find(locator, corner, 1, &site));
  PROMISE(site == VORPIPE_NO_SITE);
  looks.width = 40;
  looks.height = 30;
  DONE(vorpipe_render(session, input, &looks, &picture));
  DONE(vorpipe_picture_array(picture, VORPIPE_PICTURE_IDS, &ids));
  for (k = 0; k < 1200; ++k) air += ((const uint32_t*)ids.data)[k] == VORPIPE_NO_SITE;
  PROMISE(air > 900 && air < 1100); /* of 1200, of which a sixth is water */
  DONE(vorpipe_draw_save(session, input, NULL, "dam.svg"));
  vorpipe_picture_free(picture);
  vorpipe_locator_free(locator);
  vorpipe_diagram_free(cells);
  vorpipe_input_free(input);
  vorpipe_fluid_free(fluid);
  DONE(vorpipe_input_read("random:100", 3, &input));
  DONE(vorpipe_input_set_box(input, 0, 0, 1, 1, 0));
  options.fill = 0.3;
  DONE(vorpipe_transport(session, input, &options, &found));
  DONE(vorpipe_transported_input(found, &filled));
  DONE(vorpipe_cells(session, filled, NULL, &cells));
  PROMISE(fabs(vorpipe_diagram_area_sum(cells) - 0.3) < 1e-8 && are_closed(cells));
  vorpipe_diagram_free(cells);
  DONE(vorpipe_input_set_surface(filled, VORPIPE_SURFACE_NONE));
  DONE(vorpipe_cells(session, filled, NULL, &cells));
  PROMISE(fabs(vorpipe_diagram_area_sum(cells) - 1) < 1e-12);
  PROMISE(rows_of(cells, VORPIPE_BORDER_PARTS, NULL) == 0);
  REFUSED(VORPIPE_INPUT, "surface", vorpipe_input_set_surface(filled, 2));
  vorpipe_diagram_free(cells);
  vorpipe_input_free(filled);
  vorpipe_transported_free(found);
  vorpipe_input_free(input);
}

static void refused_fluids(vorpipe_session* session) {
  vorpipe_fluid_options options = {sizeof options};
  vorpipe_fluid_run_options run = {sizeof run};
  vorpipe_fluid* fluid = NULL;
  vorpipe_input* input = NULL;
  double velocities[20] = {0};
  REFUSED(VORPIPE_INPUT, "dam-break", vorpipe_fluid_read(session, "dam", 0, NULL, &fluid));
  REFUSED(VORPIPE_INPUT, "none.npz", vorpipe_fluid_read(session, "none.npz", 0, NULL, &fluid));
  DONE(vorpipe_input_read("random:10", 3, &input));
  options.velocities = velocities;
  options.count = 9;
  REFUSED(VORPIPE_INPUT, "count: 9 for 10", vorpipe_fluid_begin(session, input, &options, &fluid));
  REFUSED(VORPIPE_INPUT, "velocities", vorpipe_fluid_read(session, "shear", 0, &options, &fluid));
  options.count = 10;
  velocities[3] = NAN;
  REFUSED(VORPIPE_INPUT, "velocity", vorpipe_fluid_begin(session, input, &options, &fluid));
  velocities[3] = 0;
  options.step = -1;
  REFUSED(VORPIPE_INPUT, "step", vorpipe_fluid_begin(session, input, &options, &fluid));
  options.step = 0;
  options.scheme = 3;
  REFUSED(VORPIPE_INPUT, "scheme", vorpipe_fluid_begin(session, input, &options, &fluid));
  options.scheme = VORPIPE_FLUID_USUAL;
  DONE(vorpipe_input_set_surface(input, VORPIPE_SURFACE_FREE));
  REFUSED(VORPIPE_INPUT, "volume", vorpipe_fluid_begin(session, input, &options, &fluid));
  DONE(vorpipe_input_set_surface(input, VORPIPE_SURFACE_NONE));
  DONE(vorpipe_input_set_hull(input));
  DONE(vorpipe_fluid_begin(session, input, &options, &fluid));
  vorpipe_fluid_free(fluid);
  DONE(vorpipe_input_set_box(input, 0, 0, 1, 1, 0));
  DONE(vorpipe_fluid_begin(session, input, &options, &fluid));
  REFUSED(VORPIPE_INPUT, "until", vorpipe_fluid_run(fluid, &run));
  REFUSED(VORPIPE_INPUT, "count", vorpipe_fluid_push(fluid, velocities, 11));
  velocities[0] = INFINITY;
  REFUSED(VORPIPE_INPUT, "site 0", vorpipe_fluid_push(fluid, velocities, 10));
  REFUSED(VORPIPE_INPUT, "fluid", vorpipe_fluid_step(NULL, NULL, NULL));
  vorpipe_fluid_free(fluid);
  vorpipe_input_free(input);
}

void flowing_promises(vorpipe_session* session) {
  PROMISE(strcmp(vorpipe_name(VORPIPE_FLUID_CASES, 0), "taylor-green") == 0);
  PROMISE(vorpipe_name(VORPIPE_FLUID_CASES, 7) == NULL);
  steps_of_a_vortex(session);
#ifndef HEADER_OF_0_1
  friction(session);
#endif
  cancelled_step(session);
  cells_with_air(session);
  refused_fluids(session);
}

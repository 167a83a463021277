#include <math.h>
#include <stdlib.h>

#include "promise.h"

static vorpipe_array arrayOf(const vorpipe_diagram* diagram, vorpipe_diagram_field field) {
  vorpipe_array array = {NULL, 0, 0, 0};
  DONE(vorpipe_diagram_array(diagram, field, &array));
  return array;
}

static vorpipe_diagram* cellsOf(vorpipe_session* session, const vorpipe_input* input, vorpipe_detail detail) {
  vorpipe_cells_options options = {sizeof options};
  vorpipe_diagram* diagram = NULL;
  options.detail = detail;
  DONE(vorpipe_cells(session, input, &options, &diagram));
  return diagram;
}

/* Two sites share the unit square by halves. */
static void halves(vorpipe_session* session) {
  const double points[] = {0.25, 0.5, 0.75, 0.5};
  vorpipe_sites sites = {sizeof sites};
  vorpipe_input* input = NULL;
  vorpipe_diagram* diagram;
  vorpipe_array area, offsets, neighbors, vertices;
  uint64_t walls = 0, others = 0, k;
  sites.count = 2;
  sites.x = points;
  sites.y = points + 1;
  sites.position_stride = 2 * sizeof(double);
  DONE(vorpipe_input_create(&sites, &input));
  DONE(vorpipe_input_set_box(input, 0, 0, 1, 1, VORPIPE_PERIODIC_NONE));
  diagram = cellsOf(session, input, VORPIPE_EVERYTHING);
  area = arrayOf(diagram, VORPIPE_CELL_AREA);
  PROMISE(area.count == 2 && area.type == VORPIPE_DOUBLE && area.columns == 1);
  PROMISE(((const double*)area.data)[0] == 0.5 && ((const double*)area.data)[1] == 0.5);
  offsets = arrayOf(diagram, VORPIPE_CELL_OFFSETS);
  PROMISE(offsets.count == 3 && ((const uint64_t*)offsets.data)[2] == 8);
  neighbors = arrayOf(diagram, VORPIPE_CELL_NEIGHBORS);
  for (k = 0; k < neighbors.count; ++k) {
    const int64_t neighbor = ((const int64_t*)neighbors.data)[k];
    walls += neighbor <= VORPIPE_WALL_XMIN && neighbor >= VORPIPE_WALL_YMAX;
    others += neighbor >= 0;
  }
  PROMISE(walls == 6 && others == 2);
  vertices = arrayOf(diagram, VORPIPE_CELL_VERTICES);
  PROMISE(vertices.count == 8 && vertices.columns == 2);
  PROMISE(vorpipe_diagram_area_sum(diagram) == 1);
  vorpipe_diagram_free(diagram);
  vorpipe_input_free(input);
}

/* Weights, a period and a density say what they do, and every array has the shape that the header tells. */
static void shapes(vorpipe_session* session) {
  const vorpipe_diagram_field by_site[] = {
      VORPIPE_CELL_STATUS,   VORPIPE_CELL_OWNER,          VORPIPE_CELL_AREA, VORPIPE_CELL_PERIMETER,
      VORPIPE_CELL_CENTROID, VORPIPE_CELL_SECOND_MOMENTS, VORPIPE_CELL_MASS, VORPIPE_CELL_MASS_CENTROID};
  const int32_t columns[] = {1, 1, 1, 1, 2, 3, 1, 2};
  const double density[] = {1, 2, 3, 4};
  double* weights = calloc(500, sizeof(double));
  double mass = 0;
  vorpipe_input* input = NULL;
  vorpipe_diagram* diagram;
  vorpipe_array array;
  uint64_t edges;
  size_t k;
  for (k = 0; k < 500; ++k) weights[k] = 1e-4 * (double)(k % 7);
  DONE(vorpipe_input_read("random:500", 3, &input));
  PROMISE(vorpipe_input_count(input) == 500);
  DONE(vorpipe_input_set_weights(input, weights, 500));
  DONE(vorpipe_input_set_box(input, 0, 0, 1, 1, VORPIPE_PERIODIC_XY));
  DONE(vorpipe_input_set_density(input, density, 2, 2));
  diagram = cellsOf(session, input, VORPIPE_EVERYTHING);
  for (k = 0; k < sizeof by_site / sizeof by_site[0]; ++k) {
    array = arrayOf(diagram, by_site[k]);
    PROMISE(array.count == 500 && array.columns == columns[k] && array.data != NULL);
  }
  array = arrayOf(diagram, VORPIPE_CELL_OFFSETS);
  edges = ((const uint64_t*)array.data)[500];
  PROMISE(array.count == 501 && array.type == VORPIPE_UINT64);
  PROMISE(arrayOf(diagram, VORPIPE_CELL_NEIGHBORS).count == edges);
  PROMISE(arrayOf(diagram, VORPIPE_CELL_EDGE_LENGTHS).count == edges);
  array = arrayOf(diagram, VORPIPE_CELL_NEIGHBOR_SHIFTS);
  PROMISE(array.count == edges && array.columns == 2 && array.type == VORPIPE_INT32);
  array = arrayOf(diagram, VORPIPE_CELL_RING_STARTS);
  PROMISE(array.count == 0 && array.data == NULL);
  array = arrayOf(diagram, VORPIPE_CELL_MASS);
  for (k = 0; k < 500; ++k) mass += ((const double*)array.data)[k];
  PROMISE(fabs(mass - 2.5) < 1e-12);
  DONE(vorpipe_diagram_check(diagram, 2, NULL, NULL));
  DONE(vorpipe_input_random_weights(input, 0, 1e-4, 3));
  vorpipe_diagram_free(diagram);

  diagram = cellsOf(session, input, VORPIPE_MEASURES);
  PROMISE(arrayOf(diagram, VORPIPE_CELL_AREA).count == 500);
  PROMISE(arrayOf(diagram, VORPIPE_CELL_VERTICES).count == 0);
  REFUSED(VORPIPE_INPUT, "more detail", vorpipe_diagram_save(diagram, "x.npz"));
  vorpipe_diagram_free(diagram);
  vorpipe_input_free(input);
  free(weights);
}

typedef struct {
  char* bytes;
  size_t size, calls, most;
} buffer;

static int32_t keep(void* user, const void* bytes, size_t count) {
  buffer* to = user;
  if (to->size + count > to->most) return 1;
  to->bytes = realloc(to->bytes, to->size + count);
  memcpy(to->bytes + to->size, bytes, count);
  to->size += count;
  ++to->calls;
  return 0;
}

/* Every format: what the caller gets are the bytes of the file. */
static void formats(vorpipe_session* session) {
  vorpipe_input* input = NULL;
  vorpipe_diagram* diagram;
  const char* format;
  size_t index, count = 0;
  DONE(vorpipe_input_read("clusters:300", 5, &input));
  diagram = cellsOf(session, input, VORPIPE_EVERYTHING);
  for (index = 0; (format = vorpipe_name(VORPIPE_CELLS_FORMATS, index)) != NULL; ++index) {
    buffer memory = {NULL, 0, 0, (size_t)-1};
    char path[64], read[4096];
    FILE* file;
    size_t position = 0, part;
    snprintf(path, sizeof path, "cells.%s", format);
    DONE(vorpipe_diagram_write(diagram, format, keep, &memory));
    DONE(vorpipe_diagram_save(diagram, path));
    file = fopen(path, "rb");
    PROMISE(file != NULL);
    while (file != NULL && (part = fread(read, 1, sizeof read, file)) > 0) {
      PROMISE(position + part <= memory.size && memcmp(memory.bytes + position, read, part) == 0);
      position += part;
    }
    PROMISE(position == memory.size && position > 1000);
    if (file != NULL) fclose(file);
    remove(path);
    memory.most = memory.size;
    REFUSED(VORPIPE_DEVICE, format, vorpipe_diagram_write(diagram, format, keep, &memory));
    free(memory.bytes);
    ++count;
  }
  PROMISE(count >= 9);
  vorpipe_diagram_free(diagram);
  vorpipe_input_free(input);
}

static int32_t stopAtHalf(void* user, const char* stage, double fraction) {
  int* calls = user;
  ++*calls;
  return stage != NULL && fraction > 0.5;
}

static void progress(vorpipe_session* session) {
  vorpipe_cells_options options = {sizeof options};
  vorpipe_input* input = NULL;
  vorpipe_diagram* diagram = NULL;
  int calls = 0;
  DONE(vorpipe_input_read("random:200000", 1, &input));
  options.progress = stopAtHalf;
  options.progress_user = &calls;
  PROMISE(vorpipe_cells(session, input, &options, &diagram) == VORPIPE_CANCELLED);
  PROMISE(diagram == NULL && calls > 1);
  vorpipe_input_free(input);
}

/* A diagram agrees with itself, and with that of another session; not with that of other sites. */
static void comparison(vorpipe_session* session) {
  vorpipe_cells_difference difference = {sizeof difference};
  vorpipe_input *input = NULL, *other = NULL;
  vorpipe_diagram *a, *b;
  uint64_t bytes = 0;
  vorpipe_report report = {sizeof report};
  DONE(vorpipe_input_read("random:400", 1, &input));
  DONE(vorpipe_input_read("random:400", 2, &other));
  a = cellsOf(session, input, VORPIPE_EVERYTHING);
  b = cellsOf(session, other, VORPIPE_EVERYTHING);
  DONE(vorpipe_diagrams_compare(a, a, &difference));
  PROMISE(difference.equal == 400 && difference.worst_area == 0);
  PROMISE(vorpipe_diagrams_compare(a, b, &difference) == VORPIPE_DIFFERENT);
  PROMISE(difference.areas > 300);
  DONE(vorpipe_diagram_report(a, &report));
  PROMISE(strcmp(report.backend, "cpu") == 0 && report.ok == 400 && report.note_count == 0);
  PROMISE(report.validation_count == 0 && vorpipe_diagram_validation(a, 0) == NULL);
  PROMISE(report.cells_ms >= 0 && vorpipe_diagram_note(a, 0) == NULL);
  DONE(vorpipe_cells_memory(session, input, NULL, &bytes));
  PROMISE(bytes > 1000000 && bytes < vorpipe_memory_limit());
  vorpipe_diagram_free(a);
  vorpipe_diagram_free(b);
  vorpipe_diagram_free(NULL);
  vorpipe_input_free(input);
  vorpipe_input_free(other);
}

/* Euler's formula for the square with the world around it; a place near a site is in its cell. */
static void sharedAndFound(vorpipe_session* session) {
  const double places[] = {0.25, 0.25, 0.75, 0.75, 2, 2};
  const double points[] = {0.2, 0.2, 0.8, 0.8, 0.2, 0.9};
  uint32_t found[3] = {9, 9, 9};
  vorpipe_sites sites = {sizeof sites};
  vorpipe_input* input = NULL;
  vorpipe_diagram* diagram;
  vorpipe_locator* locator = NULL;
  vorpipe_array array;
  uint64_t vertices, edges, k;
  DONE(vorpipe_input_read("random:1000", 1, &input));
  diagram = cellsOf(session, input, VORPIPE_POLYGONS);
  vertices = arrayOf(diagram, VORPIPE_SHARED_VERTICES).count;
  array = arrayOf(diagram, VORPIPE_EDGE_CELLS);
  edges = array.count;
  PROMISE(vertices + 1001 == edges + 2);
  for (k = 0; k < edges; ++k) {
    const int64_t* cells = (const int64_t*)array.data + 2 * k;
    PROMISE(cells[0] >= 0 && (cells[1] > cells[0] || cells[1] < 0));
  }
  PROMISE(arrayOf(diagram, VORPIPE_VERTEX_OF).count == arrayOf(diagram, VORPIPE_CELL_VERTICES).count);
  PROMISE(arrayOf(diagram, VORPIPE_EDGE_OF).count == arrayOf(diagram, VORPIPE_CELL_NEIGHBORS).count);
  PROMISE(arrayOf(diagram, VORPIPE_EDGE_VERTICES).columns == 2);
  PROMISE(arrayOf(diagram, VORPIPE_EDGE_ENTRY).count == edges);
  vorpipe_diagram_free(diagram);
  diagram = cellsOf(session, input, VORPIPE_MEASURES);
  REFUSED(VORPIPE_INPUT, "vertices", vorpipe_diagram_array(diagram, VORPIPE_VERTEX_OF, &array));
  vorpipe_diagram_free(diagram);
  vorpipe_input_free(input);
  input = NULL;

  sites.count = 3;
  sites.x = points;
  sites.y = points + 1;
  sites.position_stride = 2 * sizeof(double);
  DONE(vorpipe_input_create(&sites, &input));
  DONE(vorpipe_input_set_box(input, 0, 0, 1, 1, VORPIPE_PERIODIC_NONE));
  DONE(vorpipe_locator_create(input, 1, &locator));
  DONE(vorpipe_locator_find(locator, places, 3, found));
  PROMISE(found[0] == 0 && found[1] == 1 && found[2] == VORPIPE_NO_SITE);
  DONE(vorpipe_locator_find(locator, NULL, 0, NULL));
  vorpipe_locator_free(locator);
  vorpipe_input_free(input);
}

#ifndef HEADER_OF_0_1
/* The triangles of each cell fill it, however the domain is cut; and sites of floats move. */
static void meshOf(vorpipe_session* session, const vorpipe_input* input) {
  vorpipe_diagram* diagram = cellsOf(session, input, VORPIPE_POLYGONS);
  const vorpipe_array area = arrayOf(diagram, VORPIPE_CELL_AREA);
  const vorpipe_array places = arrayOf(diagram, VORPIPE_MESH_VERTICES);
  const vorpipe_array owners = arrayOf(diagram, VORPIPE_MESH_SITES);
  const vorpipe_array triangles = arrayOf(diagram, VORPIPE_MESH_TRIANGLES);
  const float* at = places.data;
  const uint32_t *owner = owners.data, *corner = triangles.data;
  double* filled = calloc(area.count, sizeof(double));
  uint64_t k, mixed = 0, wrong = 0;
  PROMISE(places.type == VORPIPE_FLOAT && places.columns == 2 && owners.count == places.count);
  PROMISE(triangles.type == VORPIPE_UINT32 && triangles.columns == 3 && triangles.count > area.count);
  PROMISE(places.count == arrayOf(diagram, VORPIPE_CELL_VERTICES).count);
  for (k = 0; k < triangles.count; ++k) {
    const uint32_t a = corner[3 * k], b = corner[3 * k + 1], c = corner[3 * k + 2];
    mixed += owner[a] != owner[b] || owner[a] != owner[c];
    filled[owner[a]] += 0.5 * (((double)at[2 * b] - at[2 * a]) * ((double)at[2 * c + 1] - at[2 * a + 1]) -
                               ((double)at[2 * b + 1] - at[2 * a + 1]) * ((double)at[2 * c] - at[2 * a]));
  }
  for (k = 0; k < area.count; ++k) wrong += fabs(filled[k] - ((const double*)area.data)[k]) > 1e-6;
  PROMISE(mixed == 0 && wrong == 0);
  free(filled);
  vorpipe_diagram_free(diagram);
  diagram = cellsOf(session, input, VORPIPE_MEASURES);
  PROMISE(arrayOf(diagram, VORPIPE_MESH_TRIANGLES).count == 0);
  vorpipe_diagram_free(diagram);
}

static void meshes(vorpipe_session* session) {
  /* a U around 0.5, 0.8, and a hole in its left arm */
  const double corners[] = {0,   0, 1, 0, 1,   1,   0.7, 1,   0.7, 0.3, 0.3, 0.3,
                            0.3, 1, 0, 1, 0.1, 0.5, 0.1, 0.6, 0.2, 0.6, 0.2, 0.5};
  const uint64_t rings[] = {0, 8, 12}, polygons[] = {0, 2};
  vorpipe_outline outline = {sizeof outline};
  vorpipe_input* input = NULL;
  DONE(vorpipe_input_read("random:40", 11, &input));
  meshOf(session, input);
  DONE(vorpipe_input_set_box(input, 0, 0, 1, 1, VORPIPE_PERIODIC_XY));
  meshOf(session, input);
  outline.point_count = 12;
  outline.ring_count = 2;
  outline.polygon_count = 1;
  outline.points = corners;
  outline.ring_offsets = rings;
  outline.polygon_offsets = polygons;
  DONE(vorpipe_input_set_outline(input, &outline));
  meshOf(session, input);
  vorpipe_input_free(input);
}

/* Of two sites opposite to each other each has half of the Earth. */
static void globes(vorpipe_session* session) {
  const double degrees[] = {10, 20, 190, -20}, places[] = {0, 0, -150, -30};
  const double half_sphere = 6.283185307179586, half_earth = 510065621.724 / 2;
  uint32_t found[] = {9, 9};
  vorpipe_sites sites = {sizeof sites};
  vorpipe_input* input = NULL;
  vorpipe_render_options look = {sizeof look};
  vorpipe_locator* locator = NULL;
  vorpipe_picture* picture = NULL;
  vorpipe_relaxation* relaxation = NULL;
  vorpipe_transported* transported = NULL;
  vorpipe_diagram* diagram;
  vorpipe_array array;
  sites.count = 2;
  sites.x = degrees;
  sites.y = degrees + 1;
  sites.position_stride = 2 * sizeof(double);
  DONE(vorpipe_input_create(&sites, &input));
  DONE(vorpipe_input_set_globe(input));
  diagram = cellsOf(session, input, VORPIPE_EVERYTHING);
  array = arrayOf(diagram, VORPIPE_CELL_SOLID_ANGLE);
  PROMISE(array.count == 2 && fabs(((const double*)array.data)[1] - half_sphere) < 1e-12);
  PROMISE(fabs(((const double*)arrayOf(diagram, VORPIPE_CELL_AREA).data)[0] / half_earth - 1) < 1e-11);
  PROMISE(arrayOf(diagram, VORPIPE_CELL_SECOND_MOMENTS).count == 0);
  DONE(vorpipe_diagram_check(diagram, 1, NULL, NULL));
  DONE(vorpipe_locator_create(input, 1, &locator));
  DONE(vorpipe_locator_find(locator, places, 2, found));
  PROMISE(found[0] == 0 && found[1] == 1);
  vorpipe_locator_free(locator);
  vorpipe_diagram_free(diagram);
  DONE(vorpipe_render(session, input, NULL, &picture));
  PROMISE(vorpipe_picture_width(picture) == 1000 && vorpipe_picture_height(picture) == 500);
  DONE(vorpipe_picture_check(picture, 1, NULL, NULL));
  vorpipe_picture_free(picture);
  look.view_from_longitude = 10;
  look.view_from_latitude = 20;
  look.has_view_from = 1;
  look.graticule = 30;
  DONE(vorpipe_render(session, input, &look, &picture));
  PROMISE(vorpipe_picture_width(picture) == vorpipe_picture_height(picture));
  DONE(vorpipe_picture_array(picture, VORPIPE_PICTURE_IDS, &array));
  PROMISE(((const uint32_t*)array.data)[500 * 1000 + 500] == 0 && *(const uint32_t*)array.data == VORPIPE_NO_SITE);
  vorpipe_picture_free(picture);
  look.fit = VORPIPE_FIT_STRETCH;
  REFUSED(VORPIPE_INPUT, "fit: is of a plane", vorpipe_render(session, input, &look, &picture));
  vorpipe_input_free(input);
  DONE(vorpipe_input_read("random:300", 1, &input));
  DONE(vorpipe_input_set_globe(input));
  diagram = cellsOf(session, input, VORPIPE_POLYGONS);
  PROMISE(fabs(vorpipe_diagram_area_sum(diagram) / (2 * half_earth) - 1) < 1e-11);
  vorpipe_diagram_free(diagram);
  DONE(vorpipe_relax(session, input, NULL, &relaxation));
  DONE(vorpipe_relaxation_array(relaxation, VORPIPE_RELAXED_TRACE, &array));
  PROMISE(((const double*)array.data)[5 * (array.count - 1) + 2] < 1.05);
  vorpipe_input_free(input);
  DONE(vorpipe_relaxation_input(relaxation, &input));
  diagram = cellsOf(session, input, VORPIPE_MEASURES);
  PROMISE(fabs(vorpipe_diagram_area_sum(diagram) / (2 * half_earth) - 1) < 1e-11);
  vorpipe_diagram_free(diagram);
  vorpipe_relaxation_free(relaxation);
  REFUSED(VORPIPE_INPUT, "globe: masses", vorpipe_transport(session, input, NULL, &transported));
  vorpipe_input_free(input);
}

static double firstArea(vorpipe_session* session, const vorpipe_input* input) {
  vorpipe_diagram* diagram = cellsOf(session, input, VORPIPE_MEASURES);
  const double area = ((const double*)arrayOf(diagram, VORPIPE_CELL_AREA).data)[0];
  vorpipe_diagram_free(diagram);
  return area;
}

static void moves(vorpipe_session* session) {
  float rows[] = {0.25F, 0.5F, 1, 0.75F, 0.5F, 1, 0.5F, 0.5F, 1};
  const double doubles[] = {0.5, 0.5, 1.5, 0.5}, weights[] = {0, 0.5};
  const vorpipe_text name = {"a", 1}, names[] = {name, name};
  vorpipe_sites_float sites = {sizeof sites};
  vorpipe_sites other = {sizeof other};
  vorpipe_input* input = NULL;
  sites.count = 2;
  sites.x = rows;
  sites.y = rows + 1;
  sites.position_stride = 3 * sizeof(float);
  DONE(vorpipe_input_create_float(&sites, &input));
  PROMISE(fabs(firstArea(session, input) - 0.5 * 0.55 * 0.05) < 1e-9); /* a box around the two */
  rows[3] = 1.25F;
  DONE(vorpipe_input_set_sites_float(input, &sites));
  PROMISE(fabs(firstArea(session, input) - 0.5 * 1.1 * 0.1) < 1e-7); /* which follows them */
  DONE(vorpipe_input_set_box(input, 0, 0, 2, 1, VORPIPE_PERIODIC_NONE));
  PROMISE(fabs(firstArea(session, input) - 0.75) < 1e-12);
  other.count = 2;
  other.x = doubles;
  other.y = doubles + 1;
  other.position_stride = 2 * sizeof(double);
  DONE(vorpipe_input_set_sites(input, &other));
  PROMISE(fabs(firstArea(session, input) - 1) < 1e-12); /* the box stays */
  DONE(vorpipe_input_set_weights(input, weights, 2));
  DONE(vorpipe_input_set_sites(input, &other));
  PROMISE(fabs(firstArea(session, input) - 0.75) < 1e-12); /* so do weights */
  sites.count = 3;
  REFUSED(VORPIPE_INPUT, "weights: 2 for 3 sites", vorpipe_input_set_sites_float(input, &sites));
  PROMISE(vorpipe_input_count(input) == 2);
  sites.weight = rows + 2;
  sites.weight_stride = 3 * sizeof(float);
  DONE(vorpipe_input_set_sites_float(input, &sites));
  PROMISE(vorpipe_input_count(input) == 3);
  sites.count = 2;
  DONE(vorpipe_input_set_sites_float(input, &sites));
  DONE(vorpipe_input_add_attribute(input, "name", VORPIPE_TEXT, names, 2));
  sites.count = 0;
  REFUSED(VORPIPE_INPUT, "sites: there are none", vorpipe_input_set_sites_float(input, &sites));
  sites.count = 2;
  sites.position_stride = 2;
  REFUSED(VORPIPE_INPUT, "position_stride: 2 bytes, where a number has 4",
          vorpipe_input_set_sites_float(input, &sites));
  sites.position_stride = 3 * sizeof(float);
  sites.weight_stride = 3;
  REFUSED(VORPIPE_INPUT, "weight_stride: 3 bytes, where a number has 4",
          vorpipe_input_set_sites_float(input, &sites));
  sites.weight_stride = 3 * sizeof(float);
  other.position_stride = 7;
  REFUSED(VORPIPE_INPUT, "position_stride: 7 bytes, where a number has 8",
          vorpipe_input_set_sites(input, &other));
  PROMISE(vorpipe_input_count(input) == 2);
  sites.count = 3;
  REFUSED(VORPIPE_INPUT, "attributes: are of 2 sites, not of 3",
          vorpipe_input_set_sites_float(input, &sites));
  rows[0] = NAN;
  REFUSED(VORPIPE_INPUT, "site 0 is not finite", vorpipe_input_set_sites_float(input, &sites));
  vorpipe_input_free(input);
}
#endif

#ifndef HEADER_OF_0_1
/* Two sites share a box in space by halves. */
static void inSpace(vorpipe_session* session) {
  const double points[] = {0.5, 0.5, 0.5, 1.5, 0.5, 0.5};
  const vorpipe_diagram_field of_polyhedra[] = {VORPIPE_CELL_SECOND_MOMENTS, VORPIPE_FACE_OFFSETS,
                                                VORPIPE_FACE_VERTICES, VORPIPE_SPACE_VERTICES,
                                                VORPIPE_VERTEX_SITE_OFFSETS, VORPIPE_VERTEX_SITES};
  const uint64_t counts[] = {2, 13, 48, 12, 13, 48};
  vorpipe_sites sites = {sizeof sites};
  vorpipe_render_options picture = {sizeof picture};
  vorpipe_report report = {sizeof report};
  vorpipe_cells_difference difference = {sizeof difference};
  vorpipe_input* input = NULL;
  vorpipe_diagram* diagram;
  vorpipe_picture* drawn = NULL;
  vorpipe_array array;
  double box[4];
  size_t k;
  sites.count = 2;
  sites.x = points;
  sites.y = points + 1;
  sites.z = points + 2;
  sites.position_stride = 3 * sizeof(double);
  DONE(vorpipe_input_create(&sites, &input));
  DONE(vorpipe_input_set_box3(input, 0, 0, 0, 2, 1, 1));
  diagram = cellsOf(session, input, VORPIPE_EVERYTHING);
  PROMISE(vorpipe_diagram_dimension(diagram) == 3 && vorpipe_diagram_volume_sum(diagram) == 2);
  PROMISE(vorpipe_diagram_area_sum(diagram) == 0);
  DONE(vorpipe_diagram_check(diagram, 0, NULL, NULL));
  DONE(vorpipe_diagram_report(diagram, &report));
  PROMISE(report.ok == 2);
  array = arrayOf(diagram, VORPIPE_CELL_VOLUME);
  PROMISE(array.count == 2 && array.type == VORPIPE_DOUBLE && ((const double*)array.data)[1] == 1);
  array = arrayOf(diagram, VORPIPE_CELL_SURFACE);
  PROMISE(((const double*)array.data)[0] == 6);
  array = arrayOf(diagram, VORPIPE_CELL_CENTROID);
  PROMISE(array.columns == 3 && ((const double*)array.data)[3] == 1.5);
  array = arrayOf(diagram, VORPIPE_CELL_NEIGHBORS);
  PROMISE(array.count == 12 && ((const int64_t*)array.data)[0] == VORPIPE_WALL_ZMAX);
  PROMISE(((const int64_t*)array.data)[5] == 1 && ((const int64_t*)array.data)[11] == 0);
  PROMISE(arrayOf(diagram, VORPIPE_FACE_AREA).count == 12);
  for (k = 0; k < 6; ++k) PROMISE(arrayOf(diagram, of_polyhedra[k]).count == counts[k]);
  REFUSED(VORPIPE_INPUT, "no array 3", vorpipe_diagram_array(diagram, VORPIPE_CELL_AREA, &array));
  REFUSED(VORPIPE_INPUT, "in space", vorpipe_diagram_save_edges(diagram, "edges.csv"));
  REFUSED(VORPIPE_INPUT, "in space", vorpipe_diagrams_compare(diagram, diagram, &difference));
  DONE(vorpipe_diagram_save(diagram, "space.vtu"));
  REFUSED(VORPIPE_INPUT, "known are .npz", vorpipe_diagram_save(diagram, "space.geojson"));
  vorpipe_diagram_free(diagram);
  diagram = cellsOf(session, input, VORPIPE_MEASURES);
  for (k = 0; k < 6; ++k) PROMISE(arrayOf(diagram, of_polyhedra[k]).count == 0);
  REFUSED(VORPIPE_INPUT, "more detail", vorpipe_diagram_save(diagram, "space.obj"));
  vorpipe_diagram_free(diagram);
  /* Heavier by 1/2, the first has half as much again; by 4, all, and its cell is apart from the other site. */
  for (k = 0; k < 2; ++k) {
    const double weights[] = {k == 0 ? 0.5 : 4, 0};
    DONE(vorpipe_input_set_weights(input, weights, 2));
    diagram = cellsOf(session, input, VORPIPE_EVERYTHING);
    DONE(vorpipe_diagram_check(diagram, 0, NULL, NULL));
    array = arrayOf(diagram, VORPIPE_CELL_VOLUME);
    PROMISE(fabs(((const double*)array.data)[0] - (k == 0 ? 1.25 : 2)) < 1e-12);
    array = arrayOf(diagram, VORPIPE_CELL_STATUS);
    PROMISE(((const uint8_t*)array.data)[1] == (k == 0 ? VORPIPE_OK : VORPIPE_EMPTY));
    DONE(vorpipe_diagram_save(diagram, "weighed.npz"));
    vorpipe_diagram_free(diagram);
  }
  /* Repeated along x each has two faces with the other; by a lattice of the same vectors as well. */
  for (k = 0; k < 2; ++k) {
    const double none[] = {0, 0}, vectors[] = {2, 0, 0, 0, 1, 0, 0, 0, 1};
    DONE(vorpipe_input_set_weights(input, none, 2));
    if (k == 0) DONE(vorpipe_input_set_periodic3(input, 1, 0, 0));
    if (k == 1) DONE(vorpipe_input_set_lattice(input, vectors));
    diagram = cellsOf(session, input, VORPIPE_EVERYTHING);
    DONE(vorpipe_diagram_check(diagram, 0, NULL, NULL));
    PROMISE(fabs(vorpipe_diagram_volume_sum(diagram) - 2) < 1e-12);
    array = arrayOf(diagram, VORPIPE_FACE_SHIFTS);
    PROMISE(array.count == 12 && array.type == VORPIPE_INT32);
    if (k == 0) PROMISE(((const int32_t*)array.data)[3 * 4] == -1 && ((const int32_t*)array.data)[3 * 5] == 0);
    vorpipe_diagram_free(diagram);
  }
  REFUSED(VORPIPE_INPUT, "periodic3", vorpipe_input_set_periodic3(input, 1, 1, 1));
  REFUSED(VORPIPE_INPUT, "vectors", vorpipe_input_set_lattice(input, NULL));
  DONE(vorpipe_input_set_box3(input, 0, 0, 0, 2, 1, 1));
  REFUSED(VORPIPE_INPUT, "cells alone", vorpipe_render(session, input, &picture, &drawn));
  REFUSED(VORPIPE_INPUT, "cells alone", vorpipe_input_domain(input, box));
  DONE(vorpipe_input_set_box(input, 0, 0, 1, 1, VORPIPE_PERIODIC_X));
  REFUSED(VORPIPE_INPUT, "box3", vorpipe_cells(session, input, NULL, &diagram));
  vorpipe_input_free(input);
  sites.z = NULL;
  DONE(vorpipe_input_create(&sites, &input));
  REFUSED(VORPIPE_INPUT, "no z", vorpipe_input_set_box3(input, 0, 0, 0, 1, 1, 1));
  REFUSED(VORPIPE_INPUT, "no z", vorpipe_input_set_lattice(input, points));
  diagram = cellsOf(session, input, VORPIPE_MEASURES);
  PROMISE(vorpipe_diagram_dimension(diagram) == 2 && vorpipe_diagram_volume_sum(diagram) == 0);
  REFUSED(VORPIPE_INPUT, "29", vorpipe_diagram_array(diagram, VORPIPE_CELL_VOLUME, &array));
  vorpipe_diagram_free(diagram);
  vorpipe_input_free(input);
}
#endif

void cells_promises(vorpipe_session* session) {
#ifndef HEADER_OF_0_1
  globes(session);
  meshes(session);
  moves(session);
  inSpace(session);
#endif
  sharedAndFound(session);
  halves(session);
  shapes(session);
  formats(session);
  progress(session);
  comparison(session);
}

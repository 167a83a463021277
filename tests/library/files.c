/* Files as people have them: what is read of them, what is written of their cells. */
#include <math.h>
#include <stdlib.h>

#include "promise.h"

typedef struct text {
  char bytes[20000];
  size_t size;
} text;

/* A vorpipe_write into a text, which keeps what there is room for. */
static int32_t append(void* user, const void* bytes, size_t count) {
  text* to = user;
  const size_t room = sizeof to->bytes - 1 - to->size;
  const size_t kept = count < room ? count : room;
  memcpy(to->bytes + to->size, bytes, kept);
  to->size += kept;
  to->bytes[to->size] = 0;
  return 0;
}

static void fileOf(const char* path, const char* content) {
  FILE* file = fopen(path, "w");
  fputs(content, file);
  fclose(file);
}

static int isText(vorpipe_text value, const char* expected) {
  return value.size == strlen(expected) && memcmp(value.data, expected, value.size) == 0;
}

/* Whether a note of the input has these words. */
int hasNote(const vorpipe_input* input, const char* words) {
  size_t k;
  for (k = 0; vorpipe_input_note(input, k) != NULL; ++k) {
    if (strstr(vorpipe_input_note(input, k), words) != NULL) return 1;
  }
  return 0;
}

/* Columns by name, rows without a place, attributes with their types. */
static vorpipe_input* readInput(void) {
  const char* columns[] = {"lon", "lat"};
  vorpipe_read_options options = {sizeof options};
  vorpipe_input* input = NULL;
  vorpipe_text value = {NULL, 0};
  fileOf("stations.csv", "name;code;lat;lon\nRome;7;42;12\nTerni;;42.5;13\nnowhere;9;;\nAncona;8;43;12.5\n");
  REFUSED(VORPIPE_INPUT, "stations.csv", vorpipe_input_read_with("stations.csv", NULL, &input));
  options.skip_missing = 1;
  options.columns = columns;
  options.column_count = 2;
  options.keep_attributes = 1;
  DONE(vorpipe_input_read_with("stations.csv", &options, &input));
  PROMISE(vorpipe_input_count(input) == 3 && vorpipe_input_skipped(input) == 1);
  PROMISE(vorpipe_input_attribute_count(input) == 2);
  PROMISE(strcmp(vorpipe_input_attribute_name(input, 0), "name") == 0);
  PROMISE(vorpipe_input_attribute_type(input, 0) == VORPIPE_TEXT);
  PROMISE(vorpipe_input_attribute_type(input, 1) == VORPIPE_INTEGER);
  DONE(vorpipe_input_attribute(input, 0, 2, &value));
  PROMISE(isText(value, "Ancona"));
  DONE(vorpipe_input_attribute(input, 1, 1, &value));
  PROMISE(value.data == NULL);
  PROMISE(vorpipe_input_attribute_name(input, 2) == NULL && vorpipe_input_attribute_type(input, 2) == 0);
  REFUSED(VORPIPE_INPUT, "attribute", vorpipe_input_attribute(input, 2, 0, &value));
  REFUSED(VORPIPE_INPUT, "site", vorpipe_input_attribute(input, 0, 3, &value));
  remove("stations.csv");
  return input;
}

/* Attributes of the caller's are in files of cells beside those that were read; a wrong one is not taken. */
static void attributes(vorpipe_session* session, vorpipe_input* input) {
  const vorpipe_text numbers[] = {{"1.5", 3}, {NULL, 0}, {"-2", 2}}, words[] = {{"a", 1}, {"b", 1}, {"c", 1}};
  vorpipe_diagram* diagram = NULL;
  text written = {{0}, 0};
  DONE(vorpipe_input_add_attribute(input, "height", VORPIPE_INFERRED, numbers, 3));
  PROMISE(vorpipe_input_attribute_type(input, 2) == VORPIPE_REAL);
  DONE(vorpipe_input_add_attribute(input, "Area", VORPIPE_TEXT, words, 3));
  REFUSED(VORPIPE_INPUT, "of site 0 is not an integer",
          vorpipe_input_add_attribute(input, "letters", VORPIPE_INTEGER, words, 3));
  REFUSED(VORPIPE_INPUT, "2 values for 3 sites",
          vorpipe_input_add_attribute(input, "letters", VORPIPE_TEXT, words, 2));
  REFUSED(VORPIPE_INPUT, "type", vorpipe_input_add_attribute(input, "letters", 6, words, 3));
  REFUSED(VORPIPE_INPUT, "name: is NULL", vorpipe_input_add_attribute(input, NULL, VORPIPE_TEXT, words, 3));
  PROMISE(vorpipe_input_attribute_count(input) == 4);
  DONE(vorpipe_cells(session, input, NULL, &diagram));
  DONE(vorpipe_diagram_write(diagram, "geojson", append, &written));
  PROMISE(strstr(written.bytes, "\"Terni\"") != NULL && strstr(written.bytes, "1.5") != NULL);
  PROMISE(strstr(written.bytes, "letters") == NULL && strstr(written.bytes, "\"input_Area\"") != NULL);
  PROMISE(hasNote(input, "input_Area"));
  vorpipe_diagram_free(diagram);
}

/* In a plane amid the sites: kilometers, a check that holds, positions in degrees, files that say so. */
static void projected(vorpipe_session* session, vorpipe_input* input) {
  const double inside[] = {12.1, 42.1, 80, 80};
  double box[4];
  uint32_t found[2];
  uint64_t bytes = 0;
  int64_t epsg = 0;
  vorpipe_system_kind kind = 0;
  vorpipe_diagram* diagram = NULL;
  vorpipe_locator* locator = NULL;
  vorpipe_array vertices;
  uint64_t k;
  text written = {{0}, 0};
  DONE(vorpipe_input_set_system(input, VORPIPE_SYSTEM_DEGREES, 0));
  DONE(vorpipe_input_system(input, &kind, &epsg));
  PROMISE(kind == VORPIPE_SYSTEM_DEGREES && epsg == 4326);
#ifndef HEADER_OF_0_1
  DONE(vorpipe_input_name_system(input, "EPSG:4258"));
  DONE(vorpipe_input_system(input, &kind, &epsg));
  PROMISE(kind == VORPIPE_SYSTEM_DEGREES && epsg == 4258);
  REFUSED(VORPIPE_INPUT, "Mars", vorpipe_input_name_system(input, "Mars"));
  REFUSED(VORPIPE_INPUT, "there is none", vorpipe_input_name_outline_system(input, "EPSG:4258"));
#endif
  DONE(vorpipe_input_set_system(input, VORPIPE_SYSTEM_DEGREES, 0));
  REFUSED(VORPIPE_INPUT, "", vorpipe_input_project(input, 12, 91));
  DONE(vorpipe_input_domain(input, box));
  PROMISE(box[0] > 11 && box[2] < 14 && vorpipe_input_note(input, 0) != NULL);
  PROMISE(hasNote(input, "vorpipe_input_project makes a local plane"));
  DONE(vorpipe_input_project(input, NAN, NAN));
  DONE(vorpipe_input_set_margin(input, 0, 0));
  DONE(vorpipe_input_domain(input, box));
  PROMISE(box[2] - box[0] > 80 && box[2] - box[0] < 90);
  DONE(vorpipe_cells(session, input, NULL, &diagram));
  PROMISE(fabs(vorpipe_diagram_area_sum(diagram) - 9100) < 300);
  DONE(vorpipe_diagram_check(diagram, 0, NULL, NULL));
  DONE(vorpipe_diagram_array(diagram, VORPIPE_CELL_VERTICES, &vertices));
  for (k = 0; k < vertices.count; ++k) PROMISE(fabs(((const double*)vertices.data)[2 * k] - 12.5) < 0.6);
  DONE(vorpipe_diagram_write_edges(diagram, "geojson", append, &written));
  PROMISE(strstr(written.bytes, "LineString") != NULL);
  DONE(vorpipe_locator_create(input, 0, &locator));
  DONE(vorpipe_locator_find(locator, inside, 2, found));
  PROMISE(found[0] == 0 && found[1] == VORPIPE_NO_SITE);
  DONE(vorpipe_cells_memory(session, input, NULL, &bytes));
  PROMISE(bytes > 1000000);
  vorpipe_locator_free(locator);
  vorpipe_diagram_free(diagram);
}

/* Hulls, margins, districts that touch, rings that cross themselves. */
static void domains(vorpipe_session* session) {
  const double points[] = {0, 0, 1, 1, 1, 0, 0, 1}, corners[] = {0, 0, 2, 0, 0, 2};
  const uint64_t rings[] = {0, 4}, polygons[] = {0, 1};
  vorpipe_outline bow = {sizeof bow, 4, 1, 1, points, rings, polygons};
  vorpipe_sites sites = {sizeof sites, 3, corners, corners + 1, NULL, 2 * sizeof(double), 0};
  vorpipe_input* input = NULL;
  vorpipe_diagram* diagram = NULL;
  double box[4];
  DONE(vorpipe_input_create(&sites, &input));
  DONE(vorpipe_input_set_hull(input));
  DONE(vorpipe_cells(session, input, NULL, &diagram));
  PROMISE(fabs(vorpipe_diagram_area_sum(diagram) - 2) < 1e-12);
  vorpipe_diagram_free(diagram);
  REFUSED(VORPIPE_INPUT, "none to repair", vorpipe_input_repair_outline(input));
  REFUSED(VORPIPE_INPUT, "margin", vorpipe_input_set_margin(input, -1, 0));
  DONE(vorpipe_input_set_margin(input, 0.5, 1));
  DONE(vorpipe_input_domain(input, box));
  PROMISE(box[0] <= -0.9 && box[3] >= 2.9);
  vorpipe_input_free(input);
  DONE(vorpipe_input_read("random:50", 1, &input));
  DONE(vorpipe_input_set_outline(input, &bow));
  diagram = NULL;
  REFUSED(VORPIPE_INPUT, "vorpipe_input_repair_outline mends it",
          vorpipe_cells(session, input, NULL, &diagram));
  PROMISE(diagram == NULL);
  DONE(vorpipe_input_repair_outline(input));
  DONE(vorpipe_cells(session, input, NULL, &diagram));
  PROMISE(fabs(vorpipe_diagram_area_sum(diagram) - 0.5) < 1e-12);
  PROMISE(strstr(vorpipe_input_note(input, 0), "repaired") != NULL && vorpipe_input_note(input, 1) == NULL);
  DONE(vorpipe_input_project(input, NAN, NAN));
  REFUSED(VORPIPE_INPUT, "project: is for files in degrees, not for random:50",
          vorpipe_input_domain(input, box));
  vorpipe_diagram_free(diagram);
  vorpipe_input_free(input);
}

/* Records without a polygon are left out of features, and of nothing else. */
static void onlyCells(vorpipe_session* session) {
  const double x[] = {0.2, 0.8, 5}, y[] = {0.5, 0.5, 5};
  vorpipe_sites sites = {sizeof sites, 3, x, y, NULL, 0, 0};
  vorpipe_write_options options = {sizeof options, 1};
  vorpipe_input* input = NULL;
  vorpipe_diagram* diagram = NULL;
  text all = {{0}, 0}, some = {{0}, 0};
  DONE(vorpipe_input_create(&sites, &input));
  DONE(vorpipe_input_set_box(input, 0, 0, 1, 1, VORPIPE_PERIODIC_NONE));
  DONE(vorpipe_cells(session, input, NULL, &diagram));
  DONE(vorpipe_diagram_write(diagram, "geojsonl", append, &all));
  DONE(vorpipe_diagram_write_with(diagram, "geojsonl", &options, append, &some));
  PROMISE(strstr(all.bytes, "\"empty\"") != NULL && strstr(some.bytes, "\"empty\"") == NULL);
  REFUSED(VORPIPE_INPUT, "only_cells", vorpipe_diagram_write_with(diagram, "npz", &options, append, &some));
  options.struct_size = 0;
  REFUSED(VORPIPE_INPUT, "struct_size", vorpipe_diagram_save_with(diagram, "cells.geojson", &options));
  DONE(vorpipe_diagram_save_edges(diagram, "edges.csv"));
  PROMISE(remove("edges.csv") == 0);
  REFUSED(VORPIPE_INPUT, "edges.xls", vorpipe_diagram_save_edges(diagram, "edges.xls"));
  vorpipe_diagram_free(diagram);
  vorpipe_input_free(input);
}

void files_promises(vorpipe_session* session) {
  vorpipe_input* input = readInput();
  attributes(session, input);
  projected(session, input);
  vorpipe_input_free(input);
  domains(session);
  onlyCells(session);
  PROMISE(strcmp(vorpipe_name(VORPIPE_SITES_FORMATS, 0), "csv") == 0);
  PROMISE(vorpipe_name(VORPIPE_EDGES_FORMATS, 0) != NULL && vorpipe_name(VORPIPE_PICTURE_FORMATS, 5) != NULL);
}

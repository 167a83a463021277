#include <math.h>

#include "promise.h"

static double areaSum(vorpipe_session* session, const vorpipe_input* input) {
  vorpipe_diagram* diagram = NULL;
  double sum;
  DONE(vorpipe_cells(session, input, NULL, &diagram));
  DONE(vorpipe_diagram_check(diagram, 0, NULL, NULL));
  sum = vorpipe_diagram_area_sum(diagram);
  vorpipe_diagram_free(diagram);
  return sum;
}

/* A square with a square hole, as the caller's and out of a file. */
static void outlines(vorpipe_session* session) {
  const double points[] = {0, 0, 4, 0, 4, 4, 0, 4, 1, 1, 2, 1, 2, 2, 1, 2};
  const uint64_t rings[] = {0, 4, 8}, polygons[] = {0, 2};
  const uint64_t wrong[] = {0, 9, 8};
  vorpipe_outline outline = {sizeof outline};
  vorpipe_input* input = NULL;
  FILE* file = fopen("outline.wkt", "w");
  fprintf(file, "POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0), (1 1, 2 1, 2 2, 1 2, 1 1))\n");
  fclose(file);
  outline.point_count = 8;
  outline.ring_count = 2;
  outline.polygon_count = 1;
  outline.points = points;
  outline.ring_offsets = rings;
  outline.polygon_offsets = polygons;
  DONE(vorpipe_input_read("random:200", 1, &input));
  DONE(vorpipe_input_set_outline(input, &outline));
  PROMISE(fabs(areaSum(session, input) - 15) < 1e-11);
  vorpipe_input_free(input);
  input = NULL;
  DONE(vorpipe_input_read("random:200", 1, &input));
  DONE(vorpipe_input_read_outline(input, "outline.wkt"));
  PROMISE(fabs(areaSum(session, input) - 15) < 1e-11);
  outline.ring_offsets = wrong;
  REFUSED(VORPIPE_INPUT, "ring_offsets", vorpipe_input_set_outline(input, &outline));
  REFUSED(VORPIPE_INPUT, "nowhere.wkt", vorpipe_input_read_outline(input, "nowhere.wkt"));
  PROMISE(fabs(areaSum(session, input) - 15) < 1e-11);
  vorpipe_input_free(input);
  remove("outline.wkt");
}

static void name_all(vorpipe_input* input) {
  vorpipe_text names[50];
  uint64_t k;
  for (k = 0; k < 50; ++k) names[k] = (vorpipe_text){"a", 1};
  DONE(vorpipe_input_add_attribute(input, "name", VORPIPE_TEXT, names, vorpipe_input_count(input)));
}

/* Sites that have moved keep the domain that was found before, whatever is said of them later; and another
 * one that is set. */
static void domains_of_moved(vorpipe_session* session) {
  double before[4], after[4];
  int kind;
  for (kind = 0; kind < 3; ++kind) {
    vorpipe_input *input = NULL, *moved = NULL;
    vorpipe_relaxation* relaxation = NULL;
    DONE(vorpipe_input_read("random:20", 1, &input));
    DONE(vorpipe_input_set_hull(input));
    if (kind == 1) DONE(vorpipe_input_set_margin(input, 1, 0));
    if (kind == 2) {
      const double x[] = {0, 10, 10, 0, 5, 3}, y[] = {0, 0, 10, 10, 5, 4};
      vorpipe_sites sites = {sizeof sites};
      sites.count = 6;
      sites.x = x;
      sites.y = y;
      vorpipe_input_free(input);
      DONE(vorpipe_input_create(&sites, &input));
      DONE(vorpipe_input_project(input, NAN, NAN));
    }
    DONE(vorpipe_relax(session, input, NULL, &relaxation));
    DONE(vorpipe_relaxation_input(relaxation, &moved));
    DONE(vorpipe_input_domain(input, before));
    name_all(moved);
    DONE(vorpipe_input_random_weights(moved, 0, 1e-9, 1));
    DONE(vorpipe_input_set_system(moved, VORPIPE_SYSTEM_UNKNOWN, 0));
    DONE(vorpipe_input_domain(moved, after));
    PROMISE(memcmp(before, after, sizeof before) == 0);
    PROMISE(fabs(areaSum(session, moved) / areaSum(session, input) - 1) < 1e-12);
    DONE(vorpipe_input_set_margin(moved, 2, 1));
    DONE(vorpipe_input_domain(moved, after));
    PROMISE(after[2] > before[2]);
    if (kind == 2) {
      DONE(vorpipe_input_set_system(moved, VORPIPE_SYSTEM_PLANE, 0));
      REFUSED(VORPIPE_INPUT, "plane", vorpipe_input_domain(moved, after));
    }
    vorpipe_relaxation_free(relaxation);
    vorpipe_input_free(moved);
    vorpipe_input_free(input);
  }
}

/* A pattern was spread over its outline once. */
static void patterns_that_moved(vorpipe_session* session) {
  const double triangle[] = {100, 100, 140, 100, 120, 160}, other[] = {90, 90, 150, 90, 120, 170};
  const uint64_t rings[] = {0, 3}, polygons[] = {0, 1};
  vorpipe_outline outline = {sizeof outline};
  vorpipe_input *input = NULL, *moved = NULL;
  vorpipe_transported* found = NULL;
  vorpipe_diagram* cells = NULL;
  vorpipe_report report = {sizeof report};
  int time;
  outline.point_count = 3;
  outline.ring_count = outline.polygon_count = 1;
  outline.points = triangle;
  outline.ring_offsets = rings;
  outline.polygon_offsets = polygons;
  DONE(vorpipe_input_read("random:50", 1, &input));
  DONE(vorpipe_input_set_outline(input, &outline));
  DONE(vorpipe_transport(session, input, NULL, &found));
  DONE(vorpipe_transported_input(found, &moved));
  name_all(moved);
  for (time = 0; time < 2; ++time) {
    DONE(vorpipe_cells(session, moved, NULL, &cells));
    DONE(vorpipe_diagram_report(cells, &report));
    PROMISE(report.ok == 50);
    vorpipe_diagram_free(cells);
    outline.points = other;
    DONE(vorpipe_input_set_outline(moved, &outline));
  }
  vorpipe_input_free(moved);
  vorpipe_transported_free(found);
  vorpipe_input_free(input);
}

#ifndef HEADER_OF_0_1
/* An outline in another system than the sites, and a density with a place. */
static void systems_and_places(vorpipe_session* session) {
  const double x[] = {1, 2, 3}, y[] = {1, 2, 1}, corners[] = {0, 0, 4, 0, 4, 2, 0, 2};
  const double pixels[] = {1, 2, 3, 4, 5, 6, 7, 8};
  const uint64_t rings[] = {0, 4}, polygons[] = {0, 1};
  double box[4];
  vorpipe_sites sites = {sizeof sites};
  vorpipe_outline outline = {sizeof outline};
  vorpipe_input* input = NULL;
  vorpipe_diagram* cells = NULL;
  vorpipe_array masses;
  sites.count = 3;
  sites.x = x;
  sites.y = y;
  outline.point_count = 4;
  outline.ring_count = outline.polygon_count = 1;
  outline.points = corners;
  outline.ring_offsets = rings;
  outline.polygon_offsets = polygons;
  DONE(vorpipe_input_create(&sites, &input));
  DONE(vorpipe_input_set_outline(input, &outline));
  DONE(vorpipe_input_name_system(input, "EPSG:25832"));
  DONE(vorpipe_input_name_outline_system(input, "OGC:CRS84"));
  REFUSED(VORPIPE_INPUT, "in EPSG:4326, sites in EPSG:25832", vorpipe_input_domain(input, box));
  DONE(vorpipe_input_name_outline_system(input, "EPSG:25832"));
  DONE(vorpipe_input_domain(input, box));
  REFUSED(VORPIPE_INPUT, "there is none", vorpipe_input_set_density_box(input, 0, 0, 1, 1));
  DONE(vorpipe_input_set_density(input, pixels, 4, 2));
  REFUSED(VORPIPE_INPUT, "is no box", vorpipe_input_set_density_box(input, 1, 0, 1, 1));
  DONE(vorpipe_input_set_density_box(input, 2, 0, 6, 2));
  DONE(vorpipe_cells(session, input, NULL, &cells));
  PROMISE(hasNote(input, "cover 50 % of the domain"));
  DONE(vorpipe_diagram_array(cells, VORPIPE_CELL_MASS, &masses));
  PROMISE(masses.count == 3);
  PROMISE(fabs(((const double*)masses.data)[0] + ((const double*)masses.data)[1] +
               ((const double*)masses.data)[2] - (1 + 2 + 5 + 6)) < 1e-12);
  vorpipe_diagram_free(cells);
  vorpipe_input_free(input);
}
#endif

/* Weights and sites out of files; the default domain is the box of the sites, grown by 5 %. */
static void files(vorpipe_session* session) {
  vorpipe_input* input = NULL;
  FILE* file = fopen("sites.csv", "w");
  fprintf(file, "x,y\n0,0\n10,0\n10,10\n0,10\n");
  fclose(file);
  file = fopen("weights.txt", "w");
  fprintf(file, "1\n2\n3\n4\n");
  fclose(file);
  DONE(vorpipe_input_read("sites.csv", 1, &input));
  PROMISE(vorpipe_input_count(input) == 4);
  PROMISE(fabs(areaSum(session, input) - 121) < 1e-10);
  DONE(vorpipe_input_read_weights(input, "weights.txt"));
  PROMISE(fabs(areaSum(session, input) - 121) < 1e-10);
  vorpipe_input_free(input);
  remove("sites.csv");
  remove("weights.txt");
}

void input_promises(vorpipe_session* session) {
  outlines(session);
  domains_of_moved(session);
  patterns_that_moved(session);
#ifndef HEADER_OF_0_1
  systems_and_places(session);
#endif
  files(session);
}

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
  files(session);
}

/* How pictures look: scales of colors, legends, what becomes of a domain's aspect; pictures as shapes. */
#include <math.h>
#include <stdlib.h>

#include "promise.h"

/* Counts bytes, and keeps the first ones. */
typedef struct counted {
  char first[6];
  uint64_t size;
} counted;

static int32_t count(void* user, const void* bytes, size_t size) {
  counted* to = user;
  size_t k;
  for (k = 0; k < size && to->size + k < 5; ++k) to->first[to->size + k] = ((const char*)bytes)[k];
  to->size += size;
  return 0;
}

/* Which values the colors stand for. */
static void keys(vorpipe_session* session, const vorpipe_input* input) {
  vorpipe_render_options options = {sizeof options};
  vorpipe_color_key key = {sizeof key};
  vorpipe_picture* picture = NULL;
  const double* ticks;
  options.width = options.height = 120;
  options.color = VORPIPE_BY_AREA;
  options.color_scale = VORPIPE_SCALE_LOG;
  options.has_range = 1;
  options.range_low = 0.001;
  options.range_high = 0.1;
  options.legend = 1;
  options.edges = 1;
  options.edge_width = 3;
  DONE(vorpipe_render(session, input, &options, &picture));
  DONE(vorpipe_picture_key(picture, &key));
  PROMISE(key.color == VORPIPE_BY_AREA && key.scale == VORPIPE_SCALE_LOG);
  PROMISE(key.low == 0.001 && key.high == 0.1);
  PROMISE(key.ticks.count >= 2 && key.ticks.columns == 2 && key.ticks.type == VORPIPE_DOUBLE);
  ticks = key.ticks.data;
  PROMISE(ticks[0] == 0 && fabs(ticks[1] - 0.001) < 1e-9);
  vorpipe_picture_free(picture);
  options.color = VORPIPE_BY_SITE;
  picture = NULL;
  PROMISE(vorpipe_render(session, input, &options, &picture) == VORPIPE_INPUT && picture == NULL);
  options.color = VORPIPE_BY_AREA;
  options.color_scale = 4;
  REFUSED(VORPIPE_INPUT, "color_scale", vorpipe_render(session, input, &options, &picture));
  options.color_scale = VORPIPE_SCALE_AUTOMATIC;
  options.edge_width = 1000;
  PROMISE(vorpipe_render(session, input, &options, &picture) == VORPIPE_INPUT);
  /* A program that was built when the options ended earlier. */
  options.struct_size = (uint32_t)((char*)&options.color_scale - (char*)&options);
  DONE(vorpipe_render(session, input, &options, &picture));
  DONE(vorpipe_picture_key(picture, &key));
  PROMISE(key.scale == VORPIPE_SCALE_QUANTILE);
  vorpipe_picture_free(picture);
}

#ifndef HEADER_OF_0_1
/* Colors by their names. */
static void colors(vorpipe_session* session, const vorpipe_input* input) {
  vorpipe_render_options options = {sizeof options};
  vorpipe_picture* picture = NULL;
  vorpipe_array a;
  options.width = options.height = 20;
  options.no_fill = 1;
  options.background = "#12345678";
  DONE(vorpipe_render(session, input, &options, &picture));
  DONE(vorpipe_picture_array(picture, VORPIPE_PICTURE_RGBA, &a));
  PROMISE(memcmp(a.data, "\x12\x34\x56\x78", 4) == 0);
  vorpipe_picture_free(picture);
  picture = NULL;
  options.edge_color = "reddish";
  REFUSED(VORPIPE_INPUT, "edge_color", vorpipe_render(session, input, &options, &picture));
}
#endif

/* What is drawn over cells, and smooth edges of them: ids stay. */
static void marks(vorpipe_session* session, const vorpipe_input* input) {
  vorpipe_render_options options = {sizeof options};
  vorpipe_picture *plain = NULL, *marked = NULL;
  vorpipe_array a, b;
  uint64_t bytes = 0, more = 0;
  options.width = options.height = 120;
  options.no_fill = 1;
  DONE(vorpipe_render(session, input, &options, &plain));
  DONE(vorpipe_picture_array(plain, VORPIPE_PICTURE_RGBA, &a));
  PROMISE(((const unsigned char*)a.data)[0] == 255);
  DONE(vorpipe_render_memory(session, input, &options, &bytes));
  options.edges = options.dual = options.labels = 1;
  options.antialias = 3;
  options.label_size = 6;
  DONE(vorpipe_render_memory(session, input, &options, &more));
  PROMISE(more > bytes);
  DONE(vorpipe_render(session, input, &options, &marked));
  DONE(vorpipe_picture_array(marked, VORPIPE_PICTURE_RGBA, &b));
  PROMISE(memcmp(a.data, b.data, 4 * 120 * 120) != 0);
  DONE(vorpipe_picture_array(plain, VORPIPE_PICTURE_IDS, &a));
  DONE(vorpipe_picture_array(marked, VORPIPE_PICTURE_IDS, &b));
  PROMISE(memcmp(a.data, b.data, 4 * 120 * 120) == 0);
  vorpipe_picture_free(plain);
  vorpipe_picture_free(marked);
  marked = NULL;
  options.antialias = 9;
  PROMISE(vorpipe_render(session, input, &options, &marked) == VORPIPE_INPUT && marked == NULL);
}

/* A part of the plane: the site at its corner is that of the place. */
static void views(vorpipe_session* session, const vorpipe_input* input) {
  vorpipe_render_options options = {sizeof options};
  vorpipe_picture *whole = NULL, *part = NULL;
  vorpipe_array a, b;
  options.width = options.height = 120;
  DONE(vorpipe_render(session, input, &options, &whole));
  options.width = options.height = 60;
  options.has_view = 1;
  options.view_xmax = options.view_ymax = 0.5;
  DONE(vorpipe_render(session, input, &options, &part));
  DONE(vorpipe_picture_array(whole, VORPIPE_PICTURE_IDS, &a));
  DONE(vorpipe_picture_array(part, VORPIPE_PICTURE_IDS, &b));
  PROMISE(memcmp((const uint32_t*)a.data + 119 * 120, (const uint32_t*)b.data + 59 * 60, 60 * 4) == 0);
  vorpipe_picture_free(whole);
  vorpipe_picture_free(part);
  part = NULL;
  options.view_xmin = 0.5;
  REFUSED(VORPIPE_INPUT, "view", vorpipe_render(session, input, &options, &part));
}

/* A domain keeps its aspect on request, else arrays fill the picture; files tell the place of pixels. */
static void places(vorpipe_session* session) {
  const double x[] = {0, 4}, y[] = {0, 1};
  vorpipe_sites sites = {sizeof sites, 2, x, y, NULL, 0, 0};
  vorpipe_render_options options = {sizeof options};
  vorpipe_input* input = NULL;
  vorpipe_picture* picture = NULL;
  vorpipe_array ids;
  counted written = {{0}, 0};
  DONE(vorpipe_input_create(&sites, &input));
  DONE(vorpipe_input_set_box(input, 0, 0, 4, 1, VORPIPE_PERIODIC_NONE));
  options.width = options.height = 40;
  options.fit = VORPIPE_FIT_LETTERBOX;
  DONE(vorpipe_render(session, input, &options, &picture));
  DONE(vorpipe_picture_array(picture, VORPIPE_PICTURE_IDS, &ids));
  PROMISE(((const uint32_t*)ids.data)[0] == VORPIPE_NO_SITE);
  DONE(vorpipe_picture_check(picture, 0, NULL, NULL));
  DONE(vorpipe_picture_write(picture, "tif", count, &written));
  PROMISE(strncmp(written.first, "II*", 3) == 0);
  memset(&written, 0, sizeof written);
  DONE(vorpipe_picture_write(picture, "pgw", count, &written));
  PROMISE(strncmp(written.first, "0.1", 3) == 0);
  DONE(vorpipe_picture_save(picture, "looks.png"));
  REFUSED(VORPIPE_INPUT, "picture.svg", vorpipe_picture_save(picture, "picture.svg"));
  vorpipe_picture_free(picture);
  DONE(vorpipe_picture_read("looks.png", &picture));
  REFUSED(VORPIPE_INPUT, "was read", vorpipe_picture_write(picture, "pgw", count, &written));
  vorpipe_picture_free(picture);
  options.fit = VORPIPE_FIT_AUTOMATIC;
  DONE(vorpipe_render(session, input, &options, &picture));
  DONE(vorpipe_picture_array(picture, VORPIPE_PICTURE_IDS, &ids));
  PROMISE(((const uint32_t*)ids.data)[0] == 0);
  vorpipe_picture_free(picture);
  vorpipe_input_free(input);
  remove("looks.png");
}

static void shapes(vorpipe_session* session, const vorpipe_input* input) {
  vorpipe_render_options options = {sizeof options};
  counted written = {{0}, 0};
  FILE* file;
  options.color = VORPIPE_BY_AREA;
  options.legend = 1;
  options.width = options.height = 200;
  DONE(vorpipe_draw(session, input, &options, "pdf", count, &written));
  PROMISE(strncmp(written.first, "%PDF", 4) == 0 && written.size > 1000);
  DONE(vorpipe_draw_save(session, input, NULL, "looks.svg"));
  PROMISE((file = fopen("looks.svg", "r")) != NULL);
  if (file != NULL) fclose(file);
  remove("looks.svg");
  REFUSED(VORPIPE_INPUT, "made of pixels", vorpipe_draw_save(session, input, NULL, "looks.png"));
  REFUSED(VORPIPE_INPUT, "looks.xls", vorpipe_draw_save(session, input, NULL, "looks.xls"));
  options.color = VORPIPE_BY_WEIGHT;
  REFUSED(VORPIPE_INPUT, "weight", vorpipe_draw_save(session, input, &options, "looks.svg"));
  PROMISE(fopen("looks.svg", "r") == NULL);
}

void looks_promises(vorpipe_session* session) {
  vorpipe_input* input = NULL;
  DONE(vorpipe_input_read("random:100", 1, &input));
  keys(session, input);
  marks(session, input);
#ifndef HEADER_OF_0_1
  colors(session, input);
#endif
  views(session, input);
  shapes(session, input);
  places(session);
  vorpipe_input_free(input);
}

#include <stdlib.h>

#include "promise.h"

static vorpipe_picture* drawn(vorpipe_session* session, const vorpipe_input* input, vorpipe_color color) {
  vorpipe_render_options options = {sizeof options};
  vorpipe_picture* picture = NULL;
  options.width = 120;
  options.height = 80;
  options.color = color;
  DONE(vorpipe_render(session, input, &options, &picture));
  return picture;
}

static vorpipe_array arrayOf(const vorpipe_picture* picture, vorpipe_picture_field field) {
  vorpipe_array array = {NULL, 0, 0, 0};
  DONE(vorpipe_picture_array(picture, field, &array));
  return array;
}

/* Files of a picture are read as what was drawn. */
static void readBack(const vorpipe_picture* picture) {
  vorpipe_picture_difference difference = {sizeof difference};
  vorpipe_picture* read = NULL;
  DONE(vorpipe_picture_save(picture, "picture.png"));
  DONE(vorpipe_picture_read("picture.png", &read));
  PROMISE(vorpipe_picture_width(read) == 120 && arrayOf(read, VORPIPE_PICTURE_IDS).count == 0);
  DONE(vorpipe_pictures_compare(picture, read, &difference));
  PROMISE(difference.equal == 120 * 80);
  REFUSED(VORPIPE_INPUT, "not known", vorpipe_picture_check(read, 0, NULL, NULL));
  vorpipe_picture_free(read);
  read = NULL;
  DONE(vorpipe_picture_save(picture, "ids.npy"));
  DONE(vorpipe_picture_read("ids.npy", &read));
  DONE(vorpipe_pictures_compare(picture, read, &difference));
  PROMISE(difference.equal == 120 * 80 && difference.wrong == 0);
  vorpipe_picture_free(read);
  remove("picture.png");
  remove("ids.npy");
}

void pictures_promises(vorpipe_session* session) {
  vorpipe_picture_difference difference = {sizeof difference};
  vorpipe_report report = {sizeof report};
  vorpipe_input *input = NULL, *other = NULL;
  vorpipe_picture *picture, *by_area, *of_others;
  vorpipe_array array;
  uint64_t bytes = 0, k;
  DONE(vorpipe_input_read("random:150", 1, &input));
  DONE(vorpipe_input_read("random:150", 9, &other));
  picture = drawn(session, input, VORPIPE_BY_SITE);
  array = arrayOf(picture, VORPIPE_PICTURE_RGBA);
  PROMISE(array.count == 80 && array.columns == 480 && array.type == VORPIPE_UINT8);
  array = arrayOf(picture, VORPIPE_PICTURE_IDS);
  PROMISE(array.count == 80 && array.columns == 120 && array.type == VORPIPE_UINT32);
  for (k = 0; k < 120 * 80; ++k) PROMISE(((const uint32_t*)array.data)[k] < 150);
  PROMISE(arrayOf(picture, VORPIPE_PICTURE_STATUS).count == 150);
  PROMISE(arrayOf(picture, VORPIPE_PICTURE_OWNER).count == 150);
  DONE(vorpipe_picture_check(picture, 0, NULL, NULL));
  DONE(vorpipe_picture_report(picture, &report));
  PROMISE(report.ok == 150 && vorpipe_picture_note(picture, 0) == NULL);
  readBack(picture);

  by_area = drawn(session, input, VORPIPE_BY_AREA);
  DONE(vorpipe_pictures_compare(picture, by_area, NULL));
  of_others = drawn(session, other, VORPIPE_BY_SITE);
  PROMISE(vorpipe_pictures_compare(picture, of_others, &difference) == VORPIPE_DIFFERENT);
  PROMISE(difference.wrong > 1000);
  DONE(vorpipe_render_memory(session, input, NULL, &bytes));
  PROMISE(bytes > 1000000);
  vorpipe_picture_free(picture);
  vorpipe_picture_free(by_area);
  vorpipe_picture_free(of_others);
  vorpipe_picture_free(NULL);
  vorpipe_input_free(input);
  vorpipe_input_free(other);
}

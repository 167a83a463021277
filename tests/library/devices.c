#include "promise.h"

/* The list has "cpu", and what a session says of its device. */
void devices_promises(void) {
  vorpipe_devices* devices = NULL;
  vorpipe_device_info info = {sizeof info};
  size_t index, count, usable = 0;
  uint64_t limit = 0;
  DONE(vorpipe_devices_find(NULL, &devices));
  count = vorpipe_devices_count(devices);
  PROMISE(count >= 4);
  for (index = 0; index < count; ++index) {
    DONE(vorpipe_devices_get(devices, index, &info));
    PROMISE(info.backend[0] != 0);
    PROMISE(info.usable || info.reason[0] != 0);
    if (!info.usable) continue;
    ++usable;
    if (strcmp(info.backend, "vulkan-geometry") != 0) continue;
    PROMISE(vorpipe_devices_feature(devices, index, "geometryShader") == 1);
    DONE(vorpipe_devices_limit(devices, index, "maxTexelBufferElements", &limit));
    PROMISE(limit >= 65536);
  }
  PROMISE(usable >= 1);
  PROMISE(vorpipe_devices_feature(devices, 0, "noSuchFeature") == -1);
  REFUSED(VORPIPE_INPUT, "index", vorpipe_devices_get(devices, count, &info));
  vorpipe_devices_free(devices);
  PROMISE(vorpipe_name(VORPIPE_BACKENDS, 0) != NULL && vorpipe_name(VORPIPE_BACKENDS, 100) == NULL);
  PROMISE(vorpipe_name(99, 0) == NULL);
}

/* The self-test of "cpu", and what it refuses. */
static int32_t count(void* user, const void* bytes, size_t number) {
  *(size_t*)user += bytes != NULL ? number : 0;
  return 0;
}

void selftest_promises(void) {
  vorpipe_selftest_options options = {sizeof options};
  const vorpipe_limit limit = {"noSuchLimit", 1};
  size_t size = 0;
  options.quick = 1;
  options.backend = "cpu";
  DONE(vorpipe_selftest(&options, count, &size));
  PROMISE(size > 1000);
  options.limit_count = 1;
  options.limits = &limit;
  REFUSED(VORPIPE_INPUT, "noSuchLimit", vorpipe_selftest(&options, NULL, NULL));
}

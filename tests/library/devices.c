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

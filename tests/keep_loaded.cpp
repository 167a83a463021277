// Loaded before all else: what was opened stays until the process ends. With the address sanitizer because
// the leak checker names drivers and layers, as lsan.supp does, only while they are there; where devices are
// opened by the hundred because a driver and a layer take long to load.
extern "C" __attribute__((visibility("default"))) int dlclose(void* /*handle*/) { return 0; }

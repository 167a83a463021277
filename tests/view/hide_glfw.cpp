// Loaded before all else: GLFW's library is nowhere, as on machines without it.
#include <dlfcn.h>

#include <cstring>

extern "C" __attribute__((visibility("default"))) void* dlopen(const char* name, int how) {
  if (name != nullptr && std::strstr(name, "glfw") != nullptr) return nullptr;
  using Open = void* (*)(const char*, int);
  static const auto next = reinterpret_cast<Open>(dlsym(RTLD_NEXT, "dlopen"));
  return next(name, how);
}

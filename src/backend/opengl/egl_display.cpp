#include "backend/opengl/egl_display.h"

#include <fmt/core.h>

#include <string>

namespace vorpipe::opengl {
namespace {

// Functions of extensions are fetched by name: libepoxy would end the process over a missing one.
template <class Function>
Function extensionFunction(const char* name) {
  return reinterpret_cast<Function>(eglGetProcAddress(name));
}

bool hasClientExtension(std::string_view name) {
  return hasExtension(eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS), name);
}

}  // namespace

bool hasExtension(const char* list, std::string_view name) {
  return list != nullptr && fmt::format(" {} ", list).find(fmt::format(" {} ", name)) != std::string::npos;
}

Result<EGLDisplay> openDisplay(EGLenum platform, void* native) {
  const auto get_display = extensionFunction<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  EGLDisplay display = get_display == nullptr ? EGL_NO_DISPLAY : get_display(platform, native, nullptr);
  if (display == EGL_NO_DISPLAY) {
    return tl::unexpected(
        Error{ErrorCode::device, fmt::format("there is no display for it (EGL error {:#x})", eglGetError())});
  }
  if (eglInitialize(display, nullptr, nullptr) == EGL_FALSE) {
    return tl::unexpected(
        Error{ErrorCode::device, fmt::format("the driver does not start (EGL error {:#x})", eglGetError())});
  }
  return display;
}

std::vector<EGLDeviceEXT> eglDevices() {
  const bool lists =
      hasClientExtension("EGL_EXT_device_enumeration") || hasClientExtension("EGL_EXT_device_base");
  if (!lists || !hasClientExtension("EGL_EXT_platform_device")) return {};
  const auto query = extensionFunction<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  EGLint count = 0;
  if (query == nullptr || query(0, nullptr, &count) == EGL_FALSE || count <= 0) return {};
  std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
  if (query(count, devices.data(), &count) == EGL_FALSE) return {};
  devices.resize(static_cast<std::size_t>(count));
  return devices;
}

bool isSoftware(EGLDeviceEXT device) {
  const auto query = extensionFunction<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
  return query != nullptr && hasExtension(query(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
}

bool hasSurfacelessPlatform() {
  return hasClientExtension("EGL_EXT_platform_base") && hasClientExtension("EGL_MESA_platform_surfaceless");
}

}  // namespace vorpipe::opengl

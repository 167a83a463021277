// Contexts through EGL, without a display: on a device (EGL_EXT_platform_device, which Mesa and NVIDIA
// share), or where no device gives one, on Mesa's surfaceless platform. The default display is never
// requested: without an X server or a Wayland compositor that fails, or hangs.
#include <dlfcn.h>
#include <epoxy/egl.h>
#include <fmt/core.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "backend/opengl/context.h"
#include "base/try.h"

namespace vorpipe::opengl {
namespace {

// Functions of extensions are fetched by name: libepoxy would end the process over a missing one.
template <class Function>
Function extensionFunction(const char* name) {
  return reinterpret_cast<Function>(eglGetProcAddress(name));
}

/// Whether a list in the format of EGL_EXTENSIONS, or null, contains the extension.
bool hasExtension(const char* list, std::string_view name) {
  return list != nullptr && fmt::format(" {} ", list).find(fmt::format(" {} ", name)) != std::string::npos;
}

bool hasClientExtension(std::string_view name) {
  return hasExtension(eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS), name);
}

/// Opens the display of a platform. It stays open until the process ends: EGL returns the same one to every
/// caller, and closing it would close it for all of them. Error (device): the reason, without place and
/// remedy.
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

/// The devices that EGL lists, in its order; none where it cannot list or open devices.
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

}  // namespace

struct Context::Native {
  EGLDisplay display;
  EGLContext context;

  Native(EGLDisplay on, EGLContext made) : display(on), context(made) {}
  Native(const Native&) = delete;
  Native& operator=(const Native&) = delete;
  ~Native() { eglDestroyContext(display, context); }
};

namespace {

constexpr std::string_view remedy =
    "install a driver with EGL (Debian and Ubuntu: libegl1 libopengl0 libgl1-mesa-dri), or use the cpu "
    "backend";

tl::unexpected<Error> noDevice(std::string_view place, std::string_view why) {
  return tl::unexpected(Error{ErrorCode::device, fmt::format("opengl: {}: {}; {}", place, why, remedy)});
}

bool canLoad(const char* library) {
  void* handle = dlopen(library, RTLD_LAZY | RTLD_LOCAL);
  if (handle != nullptr) dlclose(handle);
  return handle != nullptr;
}

// libepoxy ends the process when it needs a library that is not there, so look first.
Result<void> findLibraries() {
  if (!canLoad("libEGL.so.1") || !epoxy_has_egl()) return noDevice("EGL", "libEGL.so.1 cannot be loaded");
  if (!canLoad("libOpenGL.so.0") && !canLoad("libGL.so.1")) {
    return noDevice("OpenGL", "neither libOpenGL.so.0 nor libGL.so.1 can be loaded");
  }
  return {};
}

EGLConfig anyConfig(EGLDisplay display) {
  if (hasExtension(eglQueryString(display, EGL_EXTENSIONS), "EGL_KHR_no_config_context")) return nullptr;
  constexpr std::array<EGLint, 5> wanted = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0,
                                            EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  eglChooseConfig(display, wanted.data(), &config, 1, &count);
  return config;
}

Result<Context> openContext(Result<EGLDisplay> display, std::string_view place) {
  if (!display) return noDevice(place, display.error().message);
  if (!hasExtension(eglQueryString(*display, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context")) {
    return noDevice(place, "the driver cannot draw without a surface (EGL_KHR_surfaceless_context)");
  }
  const EGLenum previous_api = eglQueryAPI();
  if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) return noDevice(place, "the driver offers OpenGL ES only");
  // The numbers of EGL 1.5 are those of EGL_KHR_create_context.
  constexpr std::array<EGLint, 7> wanted = {EGL_CONTEXT_MAJOR_VERSION,
                                            4,
                                            EGL_CONTEXT_MINOR_VERSION,
                                            1,
                                            EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                            EGL_NONE};
  EGLContext context = eglCreateContext(*display, anyConfig(*display), EGL_NO_CONTEXT, wanted.data());
  const EGLint error = eglGetError();
  eglBindAPI(previous_api);
  if (context == EGL_NO_CONTEXT) {
    return noDevice(place,
                    fmt::format("the driver gives no OpenGL 4.1 core context (EGL error {:#x})", error));
  }
  return Context(std::make_unique<Context::Native>(*display, context));
}

// Leaves the thread as it was, bound API included: a context of the caller's may have been current.
std::function<void()> returnToCurrent(EGLDisplay own) {
  return [own, api = eglQueryAPI(), display = eglGetCurrentDisplay(), context = eglGetCurrentContext(),
          draw = eglGetCurrentSurface(EGL_DRAW), read = eglGetCurrentSurface(EGL_READ)] {
    const bool had_one = context != EGL_NO_CONTEXT;
    eglMakeCurrent(had_one ? display : own, draw, read, context);
    eglBindAPI(api);
  };
}

}  // namespace

Context::Context(std::unique_ptr<Native> native) : native_(std::move(native)) {}
Context::Context(Context&&) noexcept = default;
Context& Context::operator=(Context&&) noexcept = default;
Context::~Context() = default;

Result<Scope> Context::enter() const {
  auto leave = returnToCurrent(native_->display);
  eglBindAPI(EGL_OPENGL_API);
  if (eglMakeCurrent(native_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, native_->context) == EGL_FALSE) {
    const auto why = fmt::format("the context cannot be made current (EGL error {:#x})", eglGetError());
    leave();
    return noDevice("EGL", why);
  }
  return Scope(std::move(leave));
}

Result<std::vector<Result<Context>>> openContexts(Drivers drivers) {
  VORPIPE_TRY(findLibraries());
  std::vector<Result<Context>> contexts;
  bool any = false;
  auto devices = eglDevices();
  if (drivers == Drivers::hardware && std::erase_if(devices, isSoftware) > 0 && devices.empty()) {
    return tl::unexpected(Error{ErrorCode::device, "opengl: EGL lists software drivers alone"});
  }
  for (std::size_t i = 0; i < devices.size(); ++i) {
    contexts.push_back(
        openContext(openDisplay(EGL_PLATFORM_DEVICE_EXT, devices[i]), fmt::format("EGL device {}", i)));
    any = any || contexts.back().has_value();
  }
  if (!any && hasSurfacelessPlatform()) {
    contexts.push_back(
        openContext(openDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY), "EGL surfaceless"));
  }
  if (contexts.empty()) return noDevice("EGL", "no driver offers a device or the surfaceless platform");
  return contexts;
}

}  // namespace vorpipe::opengl

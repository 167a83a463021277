/// EGL displays that stand for a device instead of a screen.
#pragma once

#include <epoxy/egl.h>

#include <memory>
#include <string_view>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::opengl {

struct CloseDisplay {
  void operator()(EGLDisplay display) const;
};

/// An initialized display. EGL gives a process the same one whenever it asks, and terminating it
/// ends it for everybody, so the last holder does.
using Display = std::unique_ptr<void, CloseDisplay>;

/// Opens a display on a platform. Error (device): the reason, without place and remedy.
Result<Display> openDisplay(EGLenum platform, void* native);

/// The devices that EGL lists, in its order; none where it cannot list or open devices.
std::vector<EGLDeviceEXT> eglDevices();

bool hasSurfacelessPlatform();

/// Whether a list as EGL_EXTENSIONS gives it, or null, has the extension.
bool hasExtension(const char* list, std::string_view name);

}  // namespace vorpipe::opengl

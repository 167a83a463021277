/// EGL displays that stand for a device instead of a screen.
#pragma once

#include <epoxy/egl.h>

#include <string_view>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::opengl {

/// Opens the display of a platform. It stays open until the process ends: EGL hands the same one to
/// everybody who asks, and closing it would take it from all of them.
/// Error (device): the reason, without place and remedy.
Result<EGLDisplay> openDisplay(EGLenum platform, void* native);

/// The devices that EGL lists, in its order; none where it cannot list or open devices.
std::vector<EGLDeviceEXT> eglDevices();

/// Whether a device computes on the host's processors, as far as EGL says.
bool isSoftware(EGLDeviceEXT device);

bool hasSurfacelessPlatform();

/// Whether a list as EGL_EXTENSIONS gives it, or null, has the extension.
bool hasExtension(const char* list, std::string_view name);

}  // namespace vorpipe::opengl

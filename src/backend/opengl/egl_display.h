/// EGL displays that represent a device instead of a screen.
#pragma once

#include <epoxy/egl.h>

#include <string_view>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::opengl {

/// Opens the display of a platform. It stays open until the process ends: EGL returns the same one to every
/// caller, and closing it would close it for all of them. Error (device): the reason, without place and
/// remedy.
Result<EGLDisplay> openDisplay(EGLenum platform, void* native);

/// The devices that EGL lists, in its order; none where it cannot list or open devices.
std::vector<EGLDeviceEXT> eglDevices();

/// Whether a device computes on the host's processors, as far as EGL reports.
bool isSoftware(EGLDeviceEXT device);

bool hasSurfacelessPlatform();

/// Whether a list in the format of EGL_EXTENSIONS, or null, contains the extension.
bool hasExtension(const char* list, std::string_view name);

}  // namespace vorpipe::opengl

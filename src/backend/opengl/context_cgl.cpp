// Contexts through CGL, on a Mac: the one device that the system prefers. Written from Apple's
// documentation and never run: no Mac was at hand.
#define GL_SILENCE_DEPRECATION
#include <OpenGL/OpenGL.h>
#include <fmt/core.h>

#include <array>
#include <string_view>

#include "backend/opengl/context.h"

namespace vorpipe::opengl {

struct Context::Native {
  CGLContextObj context = nullptr;

  explicit Native(CGLContextObj made) : context(made) {}
  Native(const Native&) = delete;
  Native& operator=(const Native&) = delete;
  ~Native() { CGLReleaseContext(context); }
};

namespace {

tl::unexpected<Error> refused(std::string_view what, CGLError error) {
  return tl::unexpected(Error{
      ErrorCode::device, fmt::format("opengl: {}: {}; use the cpu backend", what, CGLErrorString(error))});
}

Result<Context> openContext() {
  // CGL names the versions by profile; the 4.1 of every Mac since 2013 is the GL4 core profile.
  constexpr std::array<CGLPixelFormatAttribute, 4> wanted = {
      kCGLPFAOpenGLProfile, static_cast<CGLPixelFormatAttribute>(kCGLOGLPVersion_GL4_Core),
      kCGLPFAAllowOfflineRenderers, static_cast<CGLPixelFormatAttribute>(0)};
  CGLPixelFormatObj format = nullptr;
  GLint count = 0;
  if (const auto error = CGLChoosePixelFormat(wanted.data(), &format, &count);
      error != kCGLNoError || format == nullptr) {
    return refused("CGL has no pixel format with OpenGL 4.1 core", error);
  }
  CGLContextObj context = nullptr;
  const auto error = CGLCreateContext(format, nullptr, &context);
  CGLReleasePixelFormat(format);
  if (error != kCGLNoError) return refused("CGL gives no OpenGL 4.1 core context", error);
  return Context(std::make_unique<Context::Native>(context));
}

}  // namespace

Context::Context(std::unique_ptr<Native> native) : native_(std::move(native)) {}
Context::Context(Context&&) noexcept = default;
Context& Context::operator=(Context&&) noexcept = default;
Context::~Context() = default;

Result<Scope> Context::enter() const {
  CGLContextObj previous = CGLGetCurrentContext();
  if (const auto error = CGLSetCurrentContext(native_->context); error != kCGLNoError) {
    return refused("the context cannot be made current", error);
  }
  return Scope([previous] { CGLSetCurrentContext(previous); });
}

Result<std::vector<Result<Context>>> openContexts(Drivers) {
  std::vector<Result<Context>> contexts;
  contexts.push_back(openContext());
  return contexts;
}

}  // namespace vorpipe::opengl

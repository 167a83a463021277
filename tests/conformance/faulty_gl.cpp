#include "faulty_gl.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <type_traits>
#include <utility>

namespace vorpipe::test {
namespace {

constexpr GLenum context_lost = 0x0507;

FaultyGl* between = nullptr;

// By the specification any command may find no memory or a lost context.
// clang-format off
#define VORPIPE_GL_CALLS(_)                                                                               \
  _(glActiveTexture) _(glAttachShader) _(glBeginQuery) _(glBeginTransformFeedback) _(glBindBuffer)        \
  _(glBindBufferBase) _(glBindFramebuffer) _(glBindRenderbuffer) _(glBindTexture) _(glBindVertexArray)    \
  _(glBlendFuncSeparate) _(glBlitFramebuffer) _(glBufferData) _(glBufferSubData)                          \
  _(glCheckFramebufferStatus) _(glClearBufferfv) _(glClearBufferuiv) _(glCompileShader)                   \
  _(glCreateProgram) _(glCreateShader) _(glDeleteProgram) _(glDeleteShader) _(glDisable)                  \
  _(glDrawArrays) _(glDrawBuffers) _(glDrawElements) _(glEnable) _(glEnableVertexAttribArray)             \
  _(glEndQuery) _(glEndTransformFeedback) _(glFinish) _(glFramebufferRenderbuffer)                        \
  _(glFramebufferTexture2D) _(glGenBuffers) _(glGenFramebuffers) _(glGenQueries) _(glGenRenderbuffers)    \
  _(glGenTextures) _(glGenVertexArrays) _(glGetBufferParameteri64v) _(glGetError) _(glGetIntegerv)        \
  _(glGetProgramInfoLog) _(glGetProgramiv) _(glGetQueryObjectuiv) _(glGetShaderInfoLog)                   \
  _(glGetShaderiv) _(glGetString) _(glGetUniformBlockIndex) _(glGetUniformLocation) _(glLinkProgram)      \
  _(glMapBufferRange) _(glPixelStorei) _(glReadBuffer) _(glReadPixels) _(glRenderbufferStorage)           \
  _(glScissor) _(glShaderSource) _(glTexBuffer) _(glTexImage2D) _(glTexParameteri) _(glTexParameteriv)    \
  _(glTexSubImage2D) _(glTransformFeedbackVaryings) _(glUniform1i) _(glUniformBlockBinding)               \
  _(glUnmapBuffer) _(glUseProgram) _(glVertexAttribIPointer) _(glVertexAttribPointer) _(glViewport)
#define VORPIPE_EGL_CALLS(_)                                                                              \
  _(eglBindAPI) _(eglChooseConfig) _(eglCreateContext) _(eglDestroyContext) _(eglInitialize)              \
  _(eglMakeCurrent) _(eglQueryString) _(eglGetProcAddress)
// Found by eglGetProcAddress.
#define VORPIPE_EGL_EXTENSIONS(_)                                                                         \
  _(eglGetPlatformDisplayEXT, PFNEGLGETPLATFORMDISPLAYEXTPROC)                                            \
  _(eglQueryDevicesEXT, PFNEGLQUERYDEVICESEXTPROC)                                                        \
  _(eglQueryDeviceStringEXT, PFNEGLQUERYDEVICESTRINGEXTPROC)
// clang-format on

/// What a function returns when it fails.
template <class Returned>
Returned failure(std::string_view name) {
  if constexpr (std::is_integral_v<Returned>) {
    if (name == "glGetUniformLocation" || name == "glGetUniformBlockIndex") return static_cast<Returned>(-1);
  }
  return Returned{};
}

using AnyFunction = __eglMustCastToProperFunctionPointerType;
AnyFunction extension(std::string_view name, AnyFunction real);

void noteContext(std::string_view name, bool done) {
  if (name == "eglCreateContext" && done) between->contexts_alive++;
  if (name == "eglDestroyContext" && done) between->contexts_alive--;
}

/// One function through the pointer that all calls of it take; `Name` tells equal types apart.
template <class Name, class Function>
struct Wrapped;

template <class Name, class Returned, class... Arguments>
struct Wrapped<Name, Returned (*)(Arguments...)> {
  using Function = Returned (*)(Arguments...);
  static inline Function real = nullptr;
  static inline Function* entry = nullptr;  ///< null for extensions

  static Returned call(Arguments... arguments) {
    if constexpr (Name::text == "glGetError") {
      if (between->noted != GL_NO_ERROR) return between->takeNoted();
    }
    if (between->failsNow(Name::text)) {
      if constexpr (Name::text == "glGetError") return between->takeNoted();
      return failure<Returned>(Name::text);
    }
    if constexpr (std::is_void_v<Returned>) {
      callReal(arguments...);
    } else {
      Returned result = callReal(arguments...);
      if constexpr (Name::text.starts_with("egl")) noteContext(Name::text, result != Returned{});
      if constexpr (Name::text == "eglGetProcAddress") result = extension((arguments, ...), result);
      return result;
    }
  }

  // libepoxy looks a function up at its first call, and puts it where this one stands.
  static Returned callReal(Arguments... arguments) {
    const Aside aside;
    return real(arguments...);
  }

  /// Out of the way while it lives.
  struct Aside {
    Aside() {
      if (entry != nullptr) *entry = real;
    }
    ~Aside() {
      if (entry != nullptr) real = std::exchange(*entry, call);
    }
  };
};

#define VORPIPE_NAME(function)                         \
  struct Name_##function {                             \
    static constexpr std::string_view text{#function}; \
  };
// Not by the one above: a name that is handed on would be libepoxy's macro.
#define VORPIPE_EXTENSION_NAME(function, type)         \
  struct Name_##function {                             \
    static constexpr std::string_view text{#function}; \
  };
VORPIPE_GL_CALLS(VORPIPE_NAME)
VORPIPE_EGL_CALLS(VORPIPE_NAME)
VORPIPE_EGL_EXTENSIONS(VORPIPE_EXTENSION_NAME)

AnyFunction extension(std::string_view name, AnyFunction found) {
#define VORPIPE_WRAP_EXTENSION(function, type)                                   \
  if (found != nullptr && name == #function) {                                   \
    Wrapped<Name_##function, type>::real = reinterpret_cast<type>(found);        \
    return reinterpret_cast<AnyFunction>(&Wrapped<Name_##function, type>::call); \
  }
  VORPIPE_EGL_EXTENSIONS(VORPIPE_WRAP_EXTENSION)
  return found;
}

template <class Name, class Function>
std::function<void()> wrap(Function& entry) {
  using Wrapper = Wrapped<Name, Function>;
  Wrapper::real = entry;
  Wrapper::entry = &entry;
  entry = Wrapper::call;
  return [&entry] { entry = Wrapper::real; };
}

}  // namespace

FaultyGl::FaultyGl(int failing_call, Failure failure)
    : failing_call_(failing_call),
      error_(failure == Failure::context_lost ? context_lost : GLenum{GL_OUT_OF_MEMORY}) {
  between = this;
#define VORPIPE_WRAP(function) restores_.push_back(wrap<Name_##function>(epoxy_##function));
  VORPIPE_GL_CALLS(VORPIPE_WRAP)
  VORPIPE_EGL_CALLS(VORPIPE_WRAP)
}

FaultyGl::~FaultyGl() {
  for (const auto& restore : restores_) restore();
  between = nullptr;
}

std::span<const std::string_view> FaultyGl::canFail() {
#define VORPIPE_TEXT(function) #function,
#define VORPIPE_EXTENSION_TEXT(function, type) #function,
  static constexpr std::string_view names[] = {VORPIPE_GL_CALLS(VORPIPE_TEXT) VORPIPE_EGL_CALLS(VORPIPE_TEXT)
                                                   VORPIPE_EGL_EXTENSIONS(VORPIPE_EXTENSION_TEXT)};
  return names;
}

// They say what is bound to the thread, or what went wrong; "none" is no failure of theirs.
std::span<const std::string_view> FaultyGl::cannotFail() {
  static constexpr std::string_view names[] = {"eglGetCurrentContext", "eglGetCurrentDisplay",
                                               "eglGetCurrentSurface", "eglGetError", "eglQueryAPI"};
  return names;
}

bool FaultyGl::failsNow(std::string_view name) {
  if (++calls != failing_call_) return false;
  failed = name;
  if (name.starts_with("gl")) noted = error_;
  return true;
}

unsigned FaultyGl::takeNoted() {
  const unsigned error = noted;
  if (error != context_lost) noted = GL_NO_ERROR;
  return error;
}

}  // namespace vorpipe::test

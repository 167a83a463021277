// OpenGL and EGL whose calls fail at their n-th use: a clean error each time, or the answers of a device that
// is well. Compiled with opengl_backend_test.cpp.
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <type_traits>
#include <vector>

#include "backend/opengl/opengl_backend.h"
#include "backend_scene.h"

namespace vorpipe::test {
namespace {

constexpr GLenum context_lost = 0x0507;

// Between the program and the driver.
struct FaultyGl {
  static inline int calls = 0, failing = 0;
  static inline GLenum failure = GL_OUT_OF_MEMORY, noted = GL_NO_ERROR;

  static bool failsNow() { return ++calls == failing; }
  static GLenum takeNoted() {
    const GLenum error = noted;
    // A context that is lost says so without end.
    if (error != context_lost) noted = GL_NO_ERROR;
    return error;
  }
};

/// One function through the pointer that all calls of it take.
template <auto* entry, class Returned, class... Arguments>
struct Wrapped {
  static inline Returned (*real)(Arguments...) = nullptr;

  static Returned call(Arguments... arguments) {
    constexpr bool is_get_error = std::is_same_v<Returned, GLenum> && sizeof...(Arguments) == 0;
    if constexpr (is_get_error) {
      if (entry == static_cast<void*>(&epoxy_glGetError) && FaultyGl::noted != GL_NO_ERROR) {
        return FaultyGl::takeNoted();
      }
    }
    if (!FaultyGl::failsNow()) return real(arguments...);
    FaultyGl::noted = FaultyGl::failure;
    if constexpr (is_get_error) {
      return FaultyGl::takeNoted();
    } else if constexpr (!std::is_void_v<Returned>) {
      return Returned{};
    }
  }
};

/// Puts itself between for as long as it lives.
class Between {
 public:
  Between() {
    FaultyGl::calls = 0;
    FaultyGl::noted = GL_NO_ERROR;
    wrap<&epoxy_glGetError>(epoxy_glGetError);
    wrap<&epoxy_glBufferData>(epoxy_glBufferData);
    wrap<&epoxy_glBufferSubData>(epoxy_glBufferSubData);
    wrap<&epoxy_glMapBufferRange>(epoxy_glMapBufferRange);
    wrap<&epoxy_glUnmapBuffer>(epoxy_glUnmapBuffer);
    wrap<&epoxy_glTexBuffer>(epoxy_glTexBuffer);
    wrap<&epoxy_glRenderbufferStorage>(epoxy_glRenderbufferStorage);
    wrap<&epoxy_glCheckFramebufferStatus>(epoxy_glCheckFramebufferStatus);
    wrap<&epoxy_glCreateShader>(epoxy_glCreateShader);
    wrap<&epoxy_glCreateProgram>(epoxy_glCreateProgram);
    wrap<&epoxy_glLinkProgram>(epoxy_glLinkProgram);
    wrap<&epoxy_glDrawArrays>(epoxy_glDrawArrays);
    wrap<&epoxy_glReadPixels>(epoxy_glReadPixels);
    wrap<&epoxy_glFinish>(epoxy_glFinish);
    wrap<&epoxy_eglMakeCurrent>(epoxy_eglMakeCurrent);
    wrap<&epoxy_eglCreateContext>(epoxy_eglCreateContext);
    wrap<&epoxy_eglInitialize>(epoxy_eglInitialize);
  }
  Between(const Between&) = delete;
  Between& operator=(const Between&) = delete;
  ~Between() {
    for (const auto& restore : restores_) restore();
  }

 private:
  template <auto* entry, class Returned, class... Arguments>
  void wrap(Returned (*function)(Arguments...)) {
    Wrapped<entry, Returned, Arguments...>::real = function;
    *entry = Wrapped<entry, Returned, Arguments...>::call;
    restores_.emplace_back([function] { *entry = function; });
  }

  std::vector<std::function<void()>> restores_;
};

struct Answers {
  std::vector<std::uint32_t> ids = std::vector<std::uint32_t>(32 * 32);
  CellNeighbors of_lists, of_sites;

  bool operator==(const Answers& other) const {
    return ids == other.ids && of_lists.neighbor == other.of_lists.neighbor &&
           of_sites.neighbor == other.of_sites.neighbor && of_lists.status == other.of_lists.status &&
           of_sites.status == other.of_sites.status;
  }
};

Result<Answers> work(const Scene& scene) {
  auto opened = makeOpenGlBackend({});
  if (!opened) return tl::unexpected(opened.error());
  Backend& backend = **opened;
  Answers answers;
  std::vector<CellStatus> status(scene.marks.size());
  std::vector<std::uint32_t> rgba(32 * 32);
  const auto all = range(0, scene.set.size());
  const auto done =
      backend.upload(scene.set, scene.palette_index)
          .and_then([&] { return backend.begin(makeView(32, 32)); })
          .and_then([&] { return backend.draw(all, Effort::fast, status); })
          .and_then([&] { return backend.draw(toFloat(scene.batch), scene.marks, Effort::fast, status); })
          .and_then([&] { return backend.read(rgba, answers.ids); })
          .and_then([&] { return backend.cells(scene.batch, answers.of_lists); })
          .and_then([&] { return backend.cells(all, Effort::fast, answers.of_sites); });
  if (!done) return tl::unexpected(done.error());
  return answers;
}

// Lets the first call fail, then the second, and so on until the work is done before its turn.
TEST(OpenGlFaults, AreErrorsOrDoNoHarm) {
  const Scene scene = makeScene(10);
  const auto right = work(scene);
  ASSERT_TRUE(right.has_value()) << right.error().message;
  constexpr int most_calls = 2000;
  int refused = 0;
  for (int nth = 1; nth < most_calls; nth++) {
    FaultyGl::failing = nth;
    FaultyGl::failure = nth % 2 == 0 ? GLenum{GL_OUT_OF_MEMORY} : context_lost;
    const Between faulty;
    const auto done = work(scene);
    if (FaultyGl::calls < nth) {
      EXPECT_TRUE(done.has_value()) << done.error().message;
      EXPECT_GT(refused, 40);
      return;
    }
    if (done) {
      EXPECT_EQ(*done, *right) << "wrong answers after call " << nth;
      continue;
    }
    refused++;
    EXPECT_EQ(done.error().code, ErrorCode::device) << nth;
    EXPECT_TRUE(done.error().message.starts_with("opengl: ")) << done.error().message;
    EXPECT_EQ(done.error().message.find('\n'), std::string::npos) << done.error().message;
  }
  ADD_FAILURE() << "no end of calls";
}

}  // namespace
}  // namespace vorpipe::test

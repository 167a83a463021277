// OpenGL and EGL whose calls fail at their n-th use: a clean error each time, or the answers of a device that
// is well. Compiled with opengl_backend_test.cpp.
#include <epoxy/egl.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "backend/opengl/opengl_backend.h"
#include "backend_scene.h"
#include "called_functions.h"
#include "faulty_gl.h"

namespace vorpipe::test {
namespace {

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
          .and_then([&] { return backend.draw(all, Capacity::small, status); })
          .and_then([&] { return backend.draw(toFloat(scene.batch), scene.marks, Capacity::small, status); })
          .and_then([&] { return backend.read(rgba, answers.ids); })
          .and_then([&] { return backend.cells(scene.batch, answers.of_lists); })
          .and_then([&] { return backend.cells(all, Capacity::small, answers.of_sites); });
  if (!done) return tl::unexpected(done.error());
  return answers;
}

TEST(OpenGlFaults, LeaveNoFunctionOut) {
  auto called =
      functionsNamed(std::regex("\\b(gl|egl)[A-Z][A-Za-z0-9]*\\b"), {"backend/opengl", "view/window"});
  called.erase("eglDevices");  // our own
  expectListed(called, {FaultyGl::canFail(), FaultyGl::cannotFail()});
}

// Software drivers are left out also where EGL does not say what they are.
TEST(OpenGlFaults, LeaveSoftwareDriversOut) {
  constexpr int most_calls = 3000;
  for (int nth = 1; nth < most_calls; nth++) {
    FaultyGl faulty(nth, FaultyGl::Failure::context_lost);
    const auto opened = makeOpenGlBackend({}, Drivers::hardware);
    ASSERT_FALSE(opened.has_value()) << faulty.failed;
    EXPECT_EQ(opened.error().code, ErrorCode::device);
    if (faulty.calls < nth) {
      EXPECT_GT(nth, 5);
      return;
    }
    EXPECT_EQ(faulty.contexts_alive, faulty.failed == "eglDestroyContext" ? 1 : 0);
  }
  FAIL() << "there is always another call";
}

// Lets the first call fail, then the second, and so on until the work is done before its turn.
TEST(OpenGlFaults, AreErrorsOrDoNoHarm) {
  const Scene scene = makeScene(10);
  const auto right = work(scene);
  ASSERT_TRUE(right.has_value()) << right.error().message;
  constexpr int most_calls = 3000;
  int refused = 0;
  for (int nth = 1; nth < most_calls; nth++) {
    FaultyGl faulty(nth, nth % 2 == 0 ? FaultyGl::Failure::out_of_memory : FaultyGl::Failure::context_lost);
    const auto done = work(scene);
    if (faulty.calls < nth) {
      EXPECT_TRUE(done.has_value()) << done.error().message;
      EXPECT_GT(refused, 40);
      return;
    }
    SCOPED_TRACE(faulty.failed + ", call " + std::to_string(nth));
    // What gives something back may fail as well, and then it is not given back.
    EXPECT_EQ(faulty.contexts_alive, faulty.failed == "eglDestroyContext" ? 1 : 0);
    EXPECT_TRUE(eglGetCurrentContext() == EGL_NO_CONTEXT || faulty.failed == "eglMakeCurrent");
    eglReleaseThread();
    if (done) {
      EXPECT_EQ(*done, *right) << "wrong answers";
      continue;
    }
    refused++;
    EXPECT_EQ(done.error().code, ErrorCode::device);
    EXPECT_TRUE(done.error().message.starts_with("opengl: ")) << done.error().message;
    EXPECT_EQ(done.error().message.find('\n'), std::string::npos) << done.error().message;
  }
  ADD_FAILURE() << "no end of calls";
}

}  // namespace
}  // namespace vorpipe::test

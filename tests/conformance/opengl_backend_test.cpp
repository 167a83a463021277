// What is the backend's "opengl" alone; device_*_test.cpp is compiled with it.
#include "backend/opengl/opengl_backend.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <utility>

#include "backend_scene.h"

namespace vorpipe::test {
std::unique_ptr<Backend> openBackend(const Mask& mask, int threads) {
  BackendOptions options;
  options.mask = mask;
  options.threads = threads;
  Result<std::unique_ptr<Backend>> backend = makeOpenGlBackend(options);
  if (!backend) {
    ADD_FAILURE() << backend.error().message;
    return nullptr;
  }
  return std::move(*backend);
}

namespace {

TEST(OpenGlBackend, RunsOnLlvmpipeWhereSoftwareIsForced) {
  if (std::getenv("LIBGL_ALWAYS_SOFTWARE") == nullptr) GTEST_SKIP() << "LIBGL_ALWAYS_SOFTWARE is not set";
  const auto backend = openBackend();
  ASSERT_TRUE(backend);
  EXPECT_TRUE(backend->info().device.name.starts_with("llvmpipe")) << backend->info().device.name;
  EXPECT_EQ(backend->info().device.type, "cpu");
}

// More entries than transform feedback has room for at once.
TEST(OpenGlBackend, AnswersEveryEntryOfALargeBatch) {
  const auto backend = openBackend();
  ASSERT_TRUE(backend);
  constexpr std::size_t count = 300001;
  ASSERT_LE(count, backend->info().max_entries);
  const View view = makeView(1, 1);
  ASSERT_TRUE(backend->begin(view).has_value());
  CellBatch<float> batch;
  std::vector<DrawMark> marks;
  for (std::uint32_t k = 0; k < count; k++) {
    // Every third is without a proof.
    const float reach = k % 3 == 0 ? 0.5F : std::numeric_limits<float>::infinity();
    batch.entries.push_back({0, 0, -1, -1, 1, 1, reach, 0});
    marks.push_back({0, 0, k, 0});
  }
  std::vector<CellStatus> status(count);
  const Result<void> done = backend->draw(batch, marks, Capacity::large, status);
  ASSERT_TRUE(done.has_value()) << done.error().message;
  for (std::size_t k = 0; k < count; k++) {
    ASSERT_EQ(status[k], k % 3 == 0 ? CellStatus::unsecured : CellStatus::certified) << "entry " << k;
  }
  // The last one is without a proof, and the one before is drawn over all others.
  EXPECT_EQ(read(*backend, view).ids[0], count - 2);
}

TEST(OpenGlBackend, LeavesTheThreadWithTheContextThatWasCurrent) {
  const auto first = openBackend();
  const auto second = openBackend();
  ASSERT_TRUE(first && second);
  const Scene scene = makeScene(20);
  const View view = makeView(64, 64);
  for (Backend* backend : {first.get(), second.get()}) ASSERT_TRUE(backend->begin(view).has_value());
  drawLists(*first, scene, range(0, 20), Capacity::large);
  EXPECT_EQ(eglGetCurrentContext(), EGL_NO_CONTEXT);
  for (const std::uint32_t id : read(*second, view).ids) ASSERT_EQ(id, no_site);
  drawLists(*second, scene, range(0, 20), Capacity::large);
  EXPECT_EQ(read(*first, view).ids, read(*second, view).ids);
}

TEST(OpenGlBackend, TakesAMaskForTheDevice) {
  const auto lowered = openBackend({{}, {{"maxTexelBufferElements", 65536}}});
  ASSERT_TRUE(lowered);
  EXPECT_EQ(lowered->info().max_lines, 65536U);
  const auto coarse = openBackend({{}, {{"subPixelPrecisionBits", 4}}});
  ASSERT_TRUE(coarse);
  EXPECT_EQ(coarse->info().subpixel_bits, 4);
  BackendOptions options;
  options.mask.disabled = {"geometryShader"};
  const auto without = makeOpenGlBackend(options);
  ASSERT_FALSE(without.has_value());
  EXPECT_EQ(without.error().code, ErrorCode::device);
  EXPECT_NE(without.error().message.find("geometryShader"), std::string::npos) << without.error().message;
  EXPECT_FALSE(listOpenGlDevices(options.mask).at(0).usable);
  options.mask.disabled = {"flux"};
  EXPECT_EQ(makeOpenGlBackend(options).error().code, ErrorCode::input);
}

// Between the program and the driver: refuses lists of more bytes.
struct BufferLimit {
  static inline GLsizeiptr most = 0;
  static inline int refused = 0;
  static inline bool is_error = false;
  static inline decltype(epoxy_glBufferData) buffer_data = nullptr;
  static inline decltype(epoxy_glGetError) get_error = nullptr;

  explicit BufferLimit(GLsizeiptr most_bytes) {
    most = most_bytes;
    buffer_data = epoxy_glBufferData;
    get_error = epoxy_glGetError;
    epoxy_glBufferData = [](GLenum target, GLsizeiptr size, const void* data, GLenum usage) {
      if (target != GL_TEXTURE_BUFFER || size <= most) return buffer_data(target, size, data, usage);
      refused++;
      is_error = true;
    };
    epoxy_glGetError = [] { return std::exchange(is_error, false) ? GLenum{GL_OUT_OF_MEMORY} : get_error(); };
  }
  BufferLimit(const BufferLimit&) = delete;
  BufferLimit& operator=(const BufferLimit&) = delete;
  ~BufferLimit() {
    epoxy_glBufferData = buffer_data;
    epoxy_glGetError = get_error;
  }
};

TEST(OpenGlBackend, IsGivenLessAtATimeWhereItRefusesMemory) {
  const Sites sites = generate(Pattern::random, 40000, 3);
  CellsOptions wanted{};
  wanted.domain = unit;
  wanted.detail = Detail::everything;
  BackendOptions options;
  options.name = "opengl";
  auto session = Session::open(options);
  ASSERT_TRUE(session.has_value()) << session.error().message;
  const auto whole = session->cells(sites, wanted);
  ASSERT_TRUE(whole.has_value()) << whole.error().message;
  EXPECT_EQ(whole->report.notes, std::vector<std::string>());
  session = Session::open(options);
  ASSERT_TRUE(session.has_value()) << session.error().message;
  {
    const BufferLimit refusing(1 << 18);
    const auto in_parts = session->cells(sites, wanted);
    EXPECT_GT(BufferLimit::refused, 0);
    ASSERT_TRUE(in_parts.has_value()) << in_parts.error().message;
    EXPECT_EQ(in_parts->report.notes.size(), 1U);
    EXPECT_EQ(in_parts->neighbors, whole->neighbors);
    EXPECT_EQ(in_parts->area, whole->area);
  }
  auto other = Session::open(options);
  ASSERT_TRUE(other.has_value()) << other.error().message;
  const BufferLimit refusing(0);
  const auto none = other->cells(sites, wanted);
  ASSERT_FALSE(none.has_value());
  EXPECT_EQ(none.error().code, ErrorCode::device);
  EXPECT_TRUE(none.error().out_of_memory);
}

TEST(OpenGlBackend, TakesTheDeviceThatIsNamed) {
  const auto devices = listOpenGlDevices({});
  ASSERT_FALSE(devices.empty());
  BackendOptions options;
  for (const auto& wanted : {std::string("0"), devices[0].name.substr(0, 4)}) {
    options.device = wanted;
    EXPECT_TRUE(makeOpenGlBackend(options).has_value()) << wanted;
  }
  for (const char* wanted : {"99", "no such name"}) {
    options.device = wanted;
    const auto none = makeOpenGlBackend(options);
    ASSERT_FALSE(none.has_value());
    EXPECT_EQ(none.error().code, ErrorCode::device);
  }
}

// In a process of its own, because EGL reads its list of drivers once.
TEST(OpenGlBackendDeathTest, SaysWhyWithoutAnEglDriver) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto open_without_drivers = [] {
    setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent", 1);
    const auto backend = makeOpenGlBackend({});
    const auto listed = listOpenGlDevices({});
    const bool refused = !backend && backend.error().code == ErrorCode::device &&
                         backend.error().message.find("install") != std::string::npos;
    std::_Exit(refused && listed.size() == 1 && !listed[0].usable && !listed[0].reason.empty() ? 0 : 1);
  };
  EXPECT_EXIT(open_without_drivers(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace vorpipe::test

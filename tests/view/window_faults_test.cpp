// Windows whose driver fails at its n-th call: a clean error each time, or the picture of a driver that is
// well.
#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <string>

#include "backend/vulkan/error.h"
#include "conformance/faulty_device.h"
#include "conformance/faulty_gl.h"
#include "view/window/window.h"

namespace vorpipe::view {
namespace {

using vorpipe::test::FaultyDriver;
using vorpipe::test::FaultyGl;

constexpr int most_calls = 2000;

Image picture() {
  Image made{40, 30, {}, {}};
  for (std::uint32_t pixel = 0; pixel < 40 * 30; ++pixel)
    made.rgba.push_back(0xFF000000U | (pixel * 2654435U));
  return made;
}

// Opens a window, shows a picture with a panel over it, then in another size, and reads what is shown.
Result<Image> show(WindowApi api) {
  WindowOptions options;
  options.width = 40;
  options.height = 30;
  options.api = api;
  auto window = Window::open(options);
  if (!window) return tl::unexpected(window.error());
  Presenter& presenter = window->presenter();
  if (auto set = presenter.setTexture({4, 1, {255, 255, 0, 0}}); !set) return tl::unexpected(set.error());
  PanelTriangles panel;
  for (const auto& [x, y] : {std::pair(5.0F, 5.0F), std::pair(20.0F, 5.0F), std::pair(5.0F, 20.0F)}) {
    panel.vertices.push_back({x, y, 0.25F, 0.5F, 0xFF0000FFU});
  }
  panel.indices = {0, 1, 2};
  panel.parts = {{0, 3, 0, 0, 40, 30}};
  const Image sharp = picture();
  Shown frame;
  frame.picture = &sharp;
  frame.version = 1;
  frame.placement = {0, 0, 40, 30};
  frame.panel = &panel;
  if (auto shown = presenter.show(frame, 40, 30); !shown) return tl::unexpected(shown.error());
  frame.placement = {-5, 3, 60, 20};
  frame.version = 2;
  if (auto shown = presenter.show(frame, 44, 33); !shown) return tl::unexpected(shown.error());
  return presenter.read();
}

void expectCleanError(const Error& error) {
  EXPECT_EQ(error.code, ErrorCode::device);
  EXPECT_FALSE(error.message.empty());
  EXPECT_EQ(error.message.find('\n'), std::string::npos) << error.message;
}

TEST(WindowFaults, OfVulkanAreErrorsOrDoNoHarm) {
  const auto right = show(WindowApi::vulkan);
  ASSERT_TRUE(right.has_value()) << right.error().message;
  constexpr std::array failures = {VK_ERROR_DEVICE_LOST, VK_ERROR_OUT_OF_HOST_MEMORY,
                                   VK_ERROR_SURFACE_LOST_KHR, VK_ERROR_OUT_OF_DATE_KHR};
  for (int nth = 1; nth < most_calls; ++nth) {
    FaultyDriver driver;
    driver.failing_call = nth;
    driver.failure = failures[static_cast<std::size_t>(nth) % failures.size()];
    const auto shown = show(WindowApi::vulkan);
    SCOPED_TRACE("call " + std::to_string(nth) + " of " + std::to_string(driver.calls));
    EXPECT_EQ(driver.alive, 0);
    if (driver.calls < nth) {
      EXPECT_GT(nth, 60);
      EXPECT_TRUE(shown.has_value());
      return;
    }
    if (shown) {
      EXPECT_EQ(shown->rgba, right->rgba);
      continue;
    }
    expectCleanError(shown.error());
    EXPECT_NE(shown.error().message.find(vulkan::resultName(driver.failure)), std::string::npos)
        << shown.error().message;
  }
  ADD_FAILURE() << "no end of calls";
}

TEST(WindowFaults, OfOpenGlAreErrorsOrDoNoHarm) {
  const auto right = show(WindowApi::opengl);
  ASSERT_TRUE(right.has_value()) << right.error().message;
  using Failure = FaultyGl::Failure;
  for (int nth = 1; nth < most_calls; ++nth) {
    FaultyGl faulty(nth, nth % 2 == 0 ? Failure::out_of_memory : Failure::context_lost);
    const auto shown = show(WindowApi::opengl);
    if (faulty.calls < nth) {
      EXPECT_GT(nth, 60);
      EXPECT_TRUE(shown.has_value());
      return;
    }
    SCOPED_TRACE(faulty.failed + ", call " + std::to_string(nth));
    if (shown) {
      EXPECT_EQ(shown->rgba, right->rgba);
      continue;
    }
    expectCleanError(shown.error());
  }
  ADD_FAILURE() << "no end of calls";
}

}  // namespace
}  // namespace vorpipe::view

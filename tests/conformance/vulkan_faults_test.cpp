// A device that runs out of memory, or is lost, at any call: a clean error each time, and nothing left
// behind. vulkan_test and compute_test are compiled with it.
#include <gtest/gtest.h>

#include <functional>
#include <string_view>

#include "backend/vulkan/error.h"
#include "backend/vulkan/vulkan_backend.h"
#include "backend_scene.h"
#include "called_functions.h"
#include "faulty_device.h"

namespace vorpipe::test {
namespace {

using Work = std::function<Result<void>(Backend&, const Scene&)>;

Result<void> picture(Backend& backend, const Scene& scene) {
  std::vector<CellStatus> status(scene.marks.size());
  std::vector<std::uint32_t> rgba(32 * 32);
  std::vector<std::uint32_t> ids(32 * 32);
  return backend.begin(makeView(32, 32))
      .and_then([&] { return backend.draw(toFloat(scene.batch), scene.marks, Capacity::small, status); })
      .and_then([&] { return backend.read(rgba, ids); });
}

Result<void> pictureOfSites(Backend& backend, const Scene& scene) {
  std::vector<CellStatus> status(scene.set.size());
  const auto all = range(0, scene.set.size());
  return backend.upload(scene.set, scene.palette_index)
      .and_then([&] { return backend.begin(makeView(32, 32)); })
      .and_then([&] { return backend.draw(all, Capacity::small, status); });
}

Result<void> cells(Backend& backend, const Scene& scene) {
  CellNeighbors found;
  return backend.cells(scene.batch, found);
}

Result<void> cellsOfSites(Backend& backend, const Scene& scene) {
  CellNeighbors found;
  const auto all = range(0, scene.set.size());
  return backend.upload(scene.set, {}).and_then([&] { return backend.cells(all, Capacity::small, found); });
}

// Does some work on a device, if it opens; the validation layers have nothing to say.
Result<void> doOnDevice(const Work& work, const Scene& scene) {
  auto backend = tryBackend();
  if (!backend) return tl::unexpected(backend.error());
  auto done = work(**backend, scene);
  EXPECT_EQ((*backend)->validationMessages(), std::vector<std::string>());
  return done;
}

void expectCleanError(const Error& error, VkResult failure) {
  EXPECT_EQ(error.code, ErrorCode::device);
  EXPECT_EQ(error.out_of_memory, failure == VK_ERROR_OUT_OF_DEVICE_MEMORY) << error.message;
  EXPECT_NE(error.message.find(vulkan::resultName(failure)), std::string::npos) << error.message;
  EXPECT_EQ(error.message.find('\n'), std::string::npos);
}

// How many calls can fail before a device is open.
int callsOfOpening() {
  const FaultyDriver driver;
  EXPECT_TRUE(tryBackend().has_value());
  return driver.calls;
}

// Lets the call after the first `already` fail, then the one after that, and so on until the work is done
// before its turn. Returns how many could fail.
int failEveryCall(const Work& work, int already) {
  const Scene scene = makeScene(10);
  constexpr int most_calls = 2000;
  for (int nth = already + 1; nth < most_calls; nth++) {
    FaultyDriver driver;
    driver.failing_call = nth;
    driver.failure = nth % 2 == 0 ? VK_ERROR_OUT_OF_DEVICE_MEMORY : VK_ERROR_DEVICE_LOST;
    const Result<void> done = doOnDevice(work, scene);
    EXPECT_EQ(driver.alive, 0) << "after call " << nth << " of " << driver.calls << " failed";
    if (driver.calls < nth) {
      EXPECT_TRUE(done.has_value()) << done.error().message;
      return nth - 1 - already;
    }
    // Memory of another kind may do where the first choice is exhausted.
    if (!done) expectCleanError(done.error(), driver.failure);
  }
  ADD_FAILURE() << "no end of calls";
  return 0;
}

TEST(VulkanFaults, AreErrorsWhileADeviceIsOpened) {
  const auto nothing = [](Backend&, const Scene&) { return Result<void>(); };
  const int calls = callsOfOpening();
  EXPECT_GT(calls, 20);
  EXPECT_GE(failEveryCall(nothing, 0), calls);
}

// From here on calls fail once the device is open.
TEST(VulkanFaults, AreErrorsWhileListsAreDrawn) { EXPECT_GT(failEveryCall(picture, callsOfOpening()), 50); }

TEST(VulkanFaults, AreErrorsWhileSitesAreDrawn) {
  EXPECT_GT(failEveryCall(pictureOfSites, callsOfOpening()), 50);
}

TEST(VulkanFaults, AreErrorsWhileListsAreClipped) { EXPECT_GT(failEveryCall(cells, callsOfOpening()), 15); }

TEST(VulkanFaults, AreErrorsWhileSitesAreClipped) {
  EXPECT_GT(failEveryCall(cellsOfSites, callsOfOpening()), 30);
}

TEST(VulkanFaults, LeaveNoFunctionOut) {
  auto called = functionsNamed(std::regex("\\bvk[A-Z][A-Za-z0-9]*\\b"), {"backend/vulkan", "view/window"});
  called.erase("vkCreate");  // the beginning of some
  const auto failing = FaultyDriver::canFail();
  for (const std::string& name : called) {
    EXPECT_TRUE(failing.contains(name) || FaultyDriver::cannotFail(name))
        << name << " is called and never fails";
  }
  for (const std::string& name : failing) EXPECT_TRUE(called.contains(name)) << name << " is not called";
}

TEST(VulkanFaults, AreReasonsWhereDevicesAreListed) {
  for (int nth = 1; nth < 100; nth++) {
    FaultyDriver driver;
    driver.failing_call = nth;
    driver.failure = nth % 2 == 0 ? VK_ERROR_OUT_OF_HOST_MEMORY : VK_ERROR_INITIALIZATION_FAILED;
    const std::vector<DeviceInfo> list = listVulkanDevices({});
    EXPECT_EQ(driver.alive, 0);
    ASSERT_GE(list.size(), 2U);
    if (driver.calls < nth) return;
    for (const DeviceInfo& device : list) {
      EXPECT_NE(device.usable, device.reason.find(vulkan::resultName(driver.failure)) != std::string::npos)
          << nth << ": " << device.reason;
      EXPECT_EQ(device.reason.find('\n'), std::string::npos);
    }
  }
  ADD_FAILURE() << "no end of calls";
}

}  // namespace
}  // namespace vorpipe::test

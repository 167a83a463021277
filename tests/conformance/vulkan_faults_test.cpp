// A device that runs out of memory, or is lost, at any call: a clean error each time.
#include <gtest/gtest.h>
#include <volk.h>

#include <functional>
#include <string_view>

#include "backend/vulkan/geometry.h"
#include "backend_scene.h"

namespace vorpipe::vulkan {
namespace {

// Counts calls down; the one that meets 1 fails.
int calls_left = 0;
VkResult failure = VK_ERROR_OUT_OF_DEVICE_MEMORY;
PFN_vkGetDeviceProcAddr real_proc_addr = nullptr;

bool failsNow() { return calls_left > 0 && --calls_left == 0; }

// Stands in for one function of the device.
template <std::size_t Which, class Function>
struct Failing;

template <std::size_t Which, class... Args>
struct Failing<Which, VkResult(VKAPI_PTR*)(Args...)> {
  static inline VkResult(VKAPI_PTR* real)(Args...) = nullptr;
  static VKAPI_ATTR VkResult VKAPI_CALL call(Args... args) { return failsNow() ? failure : real(args...); }
};

// A wait that fails must not leave the real device at work on what is about to be destroyed.
VKAPI_ATTR VkResult VKAPI_CALL waitAndFail(VkDevice device, std::uint32_t count, const VkFence* fences,
                                           VkBool32 all, std::uint64_t timeout) {
  const VkResult result = Failing<0, PFN_vkWaitForFences>::real(device, count, fences, all, timeout);
  return failsNow() ? failure : result;
}

template <std::size_t Which, class Function>
PFN_vkVoidFunction instead(PFN_vkVoidFunction real) {
  Failing<Which, Function>::real = reinterpret_cast<Function>(real);
  return reinterpret_cast<PFN_vkVoidFunction>(&Failing<Which, Function>::call);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL failingProcAddr(VkDevice device, const char* raw_name) {
  const PFN_vkVoidFunction real = real_proc_addr(device, raw_name);
  const std::string_view name = raw_name;
  if (name == "vkWaitForFences") {
    Failing<0, PFN_vkWaitForFences>::real = reinterpret_cast<PFN_vkWaitForFences>(real);
    return reinterpret_cast<PFN_vkVoidFunction>(&waitAndFail);
  }
  if (name == "vkAllocateMemory") return instead<1, PFN_vkAllocateMemory>(real);
  if (name == "vkMapMemory") return instead<2, PFN_vkMapMemory>(real);
  if (name == "vkCreateBuffer") return instead<3, PFN_vkCreateBuffer>(real);
  if (name == "vkCreateBufferView") return instead<4, PFN_vkCreateBufferView>(real);
  if (name == "vkCreateImage") return instead<5, PFN_vkCreateImage>(real);
  if (name == "vkCreateImageView") return instead<6, PFN_vkCreateImageView>(real);
  if (name == "vkCreateFramebuffer") return instead<7, PFN_vkCreateFramebuffer>(real);
  if (name == "vkQueueSubmit") return instead<8, PFN_vkQueueSubmit>(real);
  if (name == "vkBeginCommandBuffer") return instead<9, PFN_vkBeginCommandBuffer>(real);
  if (name == "vkEndCommandBuffer") return instead<10, PFN_vkEndCommandBuffer>(real);
  if (name == "vkCreateGraphicsPipelines") return instead<11, PFN_vkCreateGraphicsPipelines>(real);
  if (name == "vkCreateShaderModule") return instead<12, PFN_vkCreateShaderModule>(real);
  if (name == "vkCreateRenderPass") return instead<13, PFN_vkCreateRenderPass>(real);
  if (name == "vkCreateDescriptorPool") return instead<14, PFN_vkCreateDescriptorPool>(real);
  if (name == "vkAllocateDescriptorSets") return instead<15, PFN_vkAllocateDescriptorSets>(real);
  if (name == "vkCreateFence") return instead<16, PFN_vkCreateFence>(real);
  return real;
}

using Work = std::function<Result<void>(Backend&, const test::Scene&)>;

Result<void> picture(Backend& backend, const test::Scene& scene) {
  std::vector<CellStatus> status(scene.marks.size());
  std::vector<std::uint32_t> rgba(32 * 32);
  std::vector<std::uint32_t> ids(32 * 32);
  return backend.begin(test::makeView(32, 32))
      .and_then([&] { return backend.draw(toFloat(scene.batch), scene.marks, Effort::fast, status); })
      .and_then([&] { return backend.read(rgba, ids); });
}

Result<void> pictureOfSites(Backend& backend, const test::Scene& scene) {
  std::vector<CellStatus> status(scene.set.size());
  const auto all = test::range(0, scene.set.size());
  return backend.upload(scene.set, scene.shade)
      .and_then([&] { return backend.begin(test::makeView(32, 32)); })
      .and_then([&] { return backend.draw(all, Effort::fast, status); });
}

Result<void> cells(Backend& backend, const test::Scene& scene) {
  Neighborhoods found;
  return backend.cells(scene.batch, found);
}

Result<void> cellsOfSites(Backend& backend, const test::Scene& scene) {
  Neighborhoods found;
  const auto all = test::range(0, scene.set.size());
  return backend.upload(scene.set, {}).and_then([&] { return backend.cells(all, Effort::fast, found); });
}

// Does some work on a device whose call number `nth` fails.
Result<void> doWithFault(int nth, const Work& work, const test::Scene& scene) {
  Result<Instance> instance = Instance::open(false);
  if (!instance) return tl::unexpected(instance.error());
  const Result<std::vector<Physical>> devices = enumerate(*instance, {});
  if (!devices) return tl::unexpected(devices.error());
  const Result<Physical> physical = choose(*devices, "");
  if (!physical) return tl::unexpected(physical.error());
  // Until the next instance, devices get their functions from here.
  real_proc_addr = vkGetDeviceProcAddr;
  vkGetDeviceProcAddr = failingProcAddr;
  calls_left = nth;
  const Result<std::unique_ptr<Backend>> backend = GeometryBackend::open(std::move(*instance), *physical);
  if (!backend) return tl::unexpected(backend.error());
  return work(**backend, scene);
}

// Lets the first call fail, then the second, and so on until the work is done before its turn.
// Returns how many could fail.
int failEveryCall(const Work& work) {
  const test::Scene scene = test::makeScene(10);
  for (int nth = 1; nth < 1000; nth++) {
    failure = nth % 2 == 0 ? VK_ERROR_OUT_OF_DEVICE_MEMORY : VK_ERROR_DEVICE_LOST;
    const Result<void> done = doWithFault(nth, work, scene);
    if (calls_left > 0) {
      calls_left = 0;
      EXPECT_TRUE(done.has_value()) << done.error().message;
      return nth - 1;
    }
    // Memory of another kind may do where the first choice is exhausted.
    if (done) continue;
    EXPECT_EQ(done.error().code, ErrorCode::device);
    EXPECT_NE(done.error().message.find(resultName(failure)), std::string::npos) << done.error().message;
    EXPECT_EQ(done.error().message.find('\n'), std::string::npos);
  }
  ADD_FAILURE() << "no end of calls";
  return 0;
}

TEST(VulkanFaults, AreErrorsWhileListsAreDrawn) { EXPECT_GT(failEveryCall(picture), 40); }

TEST(VulkanFaults, AreErrorsWhileSitesAreDrawn) { EXPECT_GT(failEveryCall(pictureOfSites), 40); }

TEST(VulkanFaults, AreErrorsWhileListsAreClipped) { EXPECT_GT(failEveryCall(cells), 30); }

TEST(VulkanFaults, AreErrorsWhileSitesAreClipped) { EXPECT_GT(failEveryCall(cellsOfSites), 30); }

}  // namespace
}  // namespace vorpipe::vulkan

// Proof that the validation layers would speak: calls that are wrong on purpose.
#include <gtest/gtest.h>
#include <volk.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <span>
#include <string>

#include "backend/backend.h"
#include "backend/vulkan/bindings.h"
#include "backend/vulkan/buffer.h"
#include "backend/vulkan/compute_kernels.h"
#include "backend/vulkan/device.h"
#include "backend/vulkan/handle.h"
#include "backend/vulkan/instance.h"
#include "backend/vulkan/physical.h"
#include "shaders.h"

namespace vorpipe::vulkan {
namespace {

class VulkanValidation : public testing::Test {
 protected:
  void SetUp() override {
    Result<Instance> instance = Instance::open(true);
    ASSERT_TRUE(instance.has_value()) << instance.error().message;
    instance_ = std::make_unique<Instance>(std::move(*instance));
    const Result<std::vector<Physical>> devices = enumerate(*instance_, {});
    ASSERT_TRUE(devices.has_value()) << devices.error().message;
    const Result<Physical> physical = choose(*devices, "");
    ASSERT_TRUE(physical.has_value()) << physical.error().message;
    Result<Device> device = Device::open(*physical);
    ASSERT_TRUE(device.has_value()) << device.error().message;
    device_ = std::make_unique<Device>(std::move(*device));
  }

  // Whether one of the messages since the last call has this word in it.
  bool said(std::string_view word) {
    const std::vector<std::string> messages = instance_->messages().take();
    return std::ranges::any_of(
        messages, [&](const std::string& message) { return message.find(word) != std::string::npos; });
  }

  std::unique_ptr<Instance> instance_;
  std::unique_ptr<Device> device_;
};

TEST_F(VulkanValidation, IsSilentWhenNothingIsWrong) {
  Buffer buffer({"a buffer", VK_BUFFER_USAGE_TRANSFER_DST_BIT, Placement::download});
  ASSERT_TRUE(buffer.reserve(*device_, 4096, 4096).has_value());
  ASSERT_TRUE(device_
                  ->run([&](VkCommandBuffer commands) {
                    device_->api().vkCmdFillBuffer(commands, buffer.get(), 0, 4096, 1);
                  })
                  .has_value());
  EXPECT_EQ(instance_->messages().take(), std::vector<std::string>());
}

TEST_F(VulkanValidation, ReportsAnInvalidCall) {
  auto info = structure<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
  info.usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT;  // and no size
  VkBuffer buffer = VK_NULL_HANDLE;
  if (device_->api().vkCreateBuffer(device_->handle(), &info, nullptr, &buffer) == VK_SUCCESS) {
    device_->api().vkDestroyBuffer(device_->handle(), buffer, nullptr);
  }
  EXPECT_TRUE(said("VUID-VkBufferCreateInfo-size-00912"));
}

TEST_F(VulkanValidation, ReportsAMissingBarrier) {
  Buffer buffer({"a buffer", VK_BUFFER_USAGE_TRANSFER_DST_BIT, Placement::download});
  ASSERT_TRUE(buffer.reserve(*device_, 4096, 4096).has_value());
  ASSERT_TRUE(device_
                  ->run([&](VkCommandBuffer commands) {
                    device_->api().vkCmdFillBuffer(commands, buffer.get(), 0, 4096, 1);
                    device_->api().vkCmdFillBuffer(commands, buffer.get(), 0, 4096, 2);
                  })
                  .has_value());
  EXPECT_TRUE(said("SYNC-HAZARD"));
}

TEST_F(VulkanValidation, ReportsAFeatureThatTheMaskTookAway) {
  const Result<std::vector<Physical>> devices = enumerate(*instance_, {{"geometryShader"}, {}});
  ASSERT_TRUE(devices.has_value());
  Result<Device> masked = Device::open(devices->front());
  ASSERT_TRUE(masked.has_value()) << masked.error().message;
  // A barrier that names the stage is enough to need the feature.
  ASSERT_TRUE(masked
                  ->run([&](VkCommandBuffer commands) {
                    masked->api().vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_GEOMETRY_SHADER_BIT,
                                                       VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 0,
                                                       nullptr, 0, nullptr);
                  })
                  .has_value());
  EXPECT_TRUE(said("geometryShader"));
}

// What is asked for by the environment is the same for every program; see docs/testing.md, under drivers.
class VulkanWatchedShaders : public VulkanValidation {
 protected:
  void SetUp() override {
    if (const char* before = std::getenv(variable)) before_ = before;
    setenv(variable, "VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_EXT", 1);
    VulkanValidation::SetUp();
    // Which features the layer takes for itself.
    if (instance_) instance_->messages().take();
  }
  void TearDown() override {
    if (before_) setenv(variable, before_->c_str(), 1);
    if (!before_) unsetenv(variable);
  }

  // Lets arithmetic.comp compute `count` rows where its buffers have room for `bound`. What is beyond, the
  // layer reports and keeps from the memory.
  Result<void> compute(std::uint32_t count, std::uint32_t bound) {
    constexpr std::array<VkDescriptorSetLayoutBinding, 2> used = {{
        {BINDING_ENTRIES, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr},
        {BINDING_STATUS, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr},
    }};
    Buffer sent({"operands", VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, Placement::upload});
    Buffer answered({"results", VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, Placement::download});
    VORPIPE_TRY(sent.reserve(*device_, bound * sizeof(Operands), bound * sizeof(Operands)));
    VORPIPE_TRY(answered.reserve(*device_, bound * sizeof(Computed), bound * sizeof(Computed)));
    std::ranges::fill(std::span(sent.data(), bound * sizeof(Operands)), std::byte{0});
    auto bindings = Bindings::create(*device_, used, sizeof(Slice));
    if (!bindings) return tl::unexpected(std::move(bindings).error());
    bindings->setStorage(*device_, BINDING_ENTRIES, sent.get(), bound * sizeof(Operands));
    bindings->setStorage(*device_, BINDING_STATUS, answered.get(), bound * sizeof(Computed));
    auto kernels = ComputeKernels::create(*device_);
    if (!kernels) return tl::unexpected(std::move(kernels).error());
    const auto kernel = kernels->kernel(*device_, bindings->layout(), shaders::arithmetic());
    if (!kernel) return tl::unexpected(kernel.error());
    return device_->run([&](VkCommandBuffer commands) {
      dispatch(*device_, commands, *kernel, *bindings, {0, count}, count);
    });
  }

 private:
  static constexpr const char* variable = "VK_LAYER_ENABLES";
  std::optional<std::string> before_;
};

TEST_F(VulkanWatchedShaders, AreSilentWhenNothingIsWrong) {
  ASSERT_TRUE(compute(8, 8).has_value());
  EXPECT_EQ(instance_->messages().take(), std::vector<std::string>());
}

TEST_F(VulkanWatchedShaders, ReportAnAccessBeyondABuffer) {
  ASSERT_TRUE(compute(8, 4).has_value());
  EXPECT_TRUE(said("access out of bounds"));
}

// Else that reading before writing would show were an empty promise.
TEST(VulkanMemory, HasAPatternWhereItWasNotWritten) {
  const char* const asked = std::getenv("LVP_POISON_MEMORY");
  if (asked == nullptr || std::string_view(asked) != "1") GTEST_SKIP() << "LVP_POISON_MEMORY is not 1";
  const Result<Instance> instance = Instance::open(false);
  ASSERT_TRUE(instance.has_value());
  const auto devices = enumerate(*instance, {});
  ASSERT_TRUE(devices.has_value());
  if (devices->front().info.name.find("llvmpipe") == std::string::npos) GTEST_SKIP() << "not lavapipe";
  const Result<Device> device = Device::open(devices->front());
  ASSERT_TRUE(device.has_value());
  constexpr std::size_t bytes = std::size_t{1} << 20;
  Buffer buffer({"a buffer", VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, Placement::download});
  ASSERT_TRUE(buffer.reserve(*device, bytes, bytes).has_value());
  EXPECT_EQ(std::ranges::count(std::span(buffer.data(), bytes), std::byte{0x80}), bytes);
}

}  // namespace
}  // namespace vorpipe::vulkan

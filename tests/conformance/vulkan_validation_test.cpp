// Proof that the validation layers would speak: calls that are wrong on purpose.
#include <gtest/gtest.h>
#include <volk.h>

#include <algorithm>

#include "backend/vulkan/device/device.h"
#include "backend/vulkan/device/instance.h"
#include "backend/vulkan/device/physical.h"
#include "backend/vulkan/device/structure.h"
#include "backend/vulkan/memory/buffer.h"

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
  info.size = 16;  // and no usage
  VkBuffer buffer = VK_NULL_HANDLE;
  if (device_->api().vkCreateBuffer(device_->handle(), &info, nullptr, &buffer) == VK_SUCCESS) {
    device_->api().vkDestroyBuffer(device_->handle(), buffer, nullptr);
  }
  EXPECT_TRUE(said("VUID-VkBufferCreateInfo-usage"));
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

}  // namespace
}  // namespace vorpipe::vulkan

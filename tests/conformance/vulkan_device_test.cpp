// Which device is taken, what a mask does to it, and what is said when none fits.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "backend/capabilities.h"
#include "backend/vulkan/physical.h"
#include "backend/vulkan/vulkan_backend.h"

namespace vorpipe::vulkan {
namespace {

Physical made(std::string name, std::string type, bool usable = true) {
  Physical device;
  device.info.name = std::move(name);
  device.info.type = std::move(type);
  device.info.usable = usable;
  if (!usable) device.info.reason = "it is broken";
  return device;
}

const std::vector<Physical> machine = {made("llvmpipe", "cpu"), made("Iris Plus", "integrated"),
                                       made("Radeon One", "discrete", false), made("Radeon Two", "discrete"),
                                       made("GTX 1080", "other")};

std::string chosen(std::string_view wanted) {
  const Result<Physical> device = choose(machine, wanted);
  return device ? device->info.name : device.error().message;
}

TEST(VulkanChoice, TakesTheBestUsableDevice) {
  EXPECT_EQ(chosen(""), "Radeon Two");
  const std::vector<Physical> others = {made("a", "other"), made("b", "cpu"), made("c", "virtual"),
                                        made("d", "integrated")};
  EXPECT_EQ(choose(others, "")->info.name, "d");
  EXPECT_EQ(choose(std::span(others).first(3), "")->info.name, "c");
  EXPECT_EQ(choose(std::span(others).first(2), "")->info.name, "b");
}

TEST(VulkanChoice, FindsADeviceByIndexOrPartOfItsName) {
  EXPECT_EQ(chosen("0"), "llvmpipe");
  EXPECT_EQ(chosen("1"), "Iris Plus");
  EXPECT_EQ(chosen("IRIS"), "Iris Plus");
  EXPECT_EQ(chosen("radeon"), "Radeon Two");
  EXPECT_EQ(chosen("gtx 1080"), "GTX 1080");
}

TEST(VulkanChoice, SaysWhyThereIsNone) {
  EXPECT_EQ(chosen("2"), "the Vulkan device 'Radeon One' cannot be used: it is broken");
  EXPECT_EQ(
      chosen("Voodoo"),
      "no Vulkan device 'Voodoo'; choose one of 0 'llvmpipe', 1 'Iris Plus', 2 'Radeon One', 3 'Radeon Two', "
      "4 'GTX 1080'");
  // Numbers that are parts of a name are no index.
  for (const std::string wanted : {"5", "1080", "10", "18446744073709551616"}) {
    EXPECT_THAT(chosen(wanted),
                testing::StartsWith("no Vulkan device '" + wanted + "'; choose one of 0 'llvmpipe'"));
  }
}

Error openError(const Mask& mask, std::string device = {}) {
  BackendOptions options;
  options.mask = mask;
  options.device = std::move(device);
  const Result<std::unique_ptr<Backend>> backend = makeVulkanGeometryBackend(options);
  EXPECT_FALSE(backend.has_value());
  return backend ? Error{} : backend.error();
}

TEST(VulkanMask, RefusesADeviceWithoutAFeatureThatIsNeeded) {
  for (const std::string feature : {"geometryShader", "vertexPipelineStoresAndAtomics"}) {
    const Error error = openError({{feature}, {}});
    EXPECT_EQ(error.code, ErrorCode::device);
    EXPECT_NE(error.message.find(feature), std::string::npos) << error.message;
    EXPECT_NE(error.message.find("--backend"), std::string::npos) << error.message;
  }
  const Error error = openError({{}, {{"maxGeometryOutputVertices", 3}}});
  EXPECT_EQ(error.code, ErrorCode::device);
  EXPECT_NE(error.message.find("maxGeometryOutputVertices is 3, needed is"), std::string::npos)
      << error.message;
}

TEST(VulkanMask, RefusesNamesThatItDoesNotKnow) {
  const Error feature = openError({{"geometryshader"}, {}});
  EXPECT_EQ(feature.code, ErrorCode::input);
  EXPECT_NE(feature.message.find("'geometryshader': known are geometryShader"), std::string::npos);
  const Error limit = openError({{}, {{"maxTexels", 1}}});
  EXPECT_EQ(limit.code, ErrorCode::input);
  EXPECT_NE(limit.message.find("'maxTexels': known are maxTexelBufferElements"), std::string::npos);
}

TEST(VulkanMask, OnlyLowersLimits) {
  Capabilities capabilities;
  capabilities.max_texel_buffer_elements = 65536;
  capabilities.max_storage_buffer_range = 65536;
  const Mask mask{{}, {{"maxTexelBufferElements", 1000}, {"maxStorageBufferRange", 1000000}}};
  ASSERT_TRUE(applyMask(capabilities, mask).has_value());
  EXPECT_EQ(capabilities.max_texel_buffer_elements, 1000U);
  EXPECT_EQ(capabilities.max_storage_buffer_range, 65536U);
}

TEST(VulkanMask, LowersTheBitsThatCellsAreWidenedBy) {
  using Make = Result<std::unique_ptr<Backend>> (*)(const BackendOptions&);
  for (const Make make : {Make{makeVulkanGeometryBackend}, Make{makeVulkanComputeBackend}}) {
    BackendOptions options;
    options.mask.limits = {{"subPixelPrecisionBits", 4}};
    const Result<std::unique_ptr<Backend>> backend = make(options);
    ASSERT_TRUE(backend.has_value()) << backend.error().message;
    EXPECT_EQ((*backend)->info().subpixel_bits, 4);
    const auto& limits = (*backend)->info().device.limits;
    EXPECT_NE(std::ranges::find(limits, std::pair<std::string, std::uint64_t>("subPixelPrecisionBits", 4)),
              limits.end());
    options.mask.limits = {{"subPixelPrecisionBits", 3}};
    const Result<std::unique_ptr<Backend>> refused = make(options);
    ASSERT_FALSE(refused.has_value());
    EXPECT_NE(refused.error().message.find("subPixelPrecisionBits is 3, needed is 4"), std::string::npos)
        << refused.error().message;
  }
}

TEST(VulkanList, NamesEveryDeviceWithItsLimitsForEachBackend) {
  const std::vector<DeviceInfo> devices = listVulkanDevices({{"geometryShader"}, {}});
  std::size_t by_geometry = 0;
  std::size_t by_compute = 0;
  for (const DeviceInfo& device : devices) {
    EXPECT_FALSE(device.name.empty());
    EXPECT_FALSE(device.driver.empty());
    EXPECT_EQ(device.features.front(), (std::pair<std::string, bool>("geometryShader", false)));
    EXPECT_FALSE(device.limits.empty());
    const bool needs_it = device.backend == "vulkan-geometry";
    EXPECT_EQ(device.usable, !needs_it);
    EXPECT_EQ(device.reason.find("geometryShader") != std::string::npos, needs_it) << device.reason;
    by_geometry += needs_it ? 1U : 0U;
    by_compute += device.backend == "vulkan-compute" ? 1U : 0U;
  }
  EXPECT_GT(by_geometry, 0U);
  EXPECT_EQ(by_geometry, by_compute);
  EXPECT_EQ(by_geometry + by_compute, devices.size());
}

}  // namespace
}  // namespace vorpipe::vulkan

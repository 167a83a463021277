#include "backend/vulkan/vulkan_backend.h"

#include <algorithm>
#include <utility>

#include "backend/vulkan/geometry.h"
#include "backend/vulkan/instance.h"
#include "backend/vulkan/lanes.h"
#include "backend/vulkan/physical.h"
#include "parallel.h"

namespace vorpipe {
namespace {

constexpr int most_lanes = 8;

Result<std::unique_ptr<Backend>> openDevice(const BackendOptions& options) {
  Result<vulkan::Instance> instance = vulkan::Instance::open(options.validation);
  if (!instance) return tl::unexpected(std::move(instance).error());
  const Result<std::vector<vulkan::Physical>> devices = vulkan::enumerate(*instance, options.mask);
  if (!devices) return tl::unexpected(devices.error());
  const Result<vulkan::Physical> device = vulkan::choose(*devices, options.device);
  if (!device) return tl::unexpected(device.error());
  return vulkan::GeometryBackend::open(std::move(*instance), *device);
}

DeviceInfo absent(const Error& error) {
  DeviceInfo info;
  info.backend = "vulkan-geometry";
  info.reason = error.message;
  return info;
}

}  // namespace

Result<std::unique_ptr<Backend>> makeVulkanGeometryBackend(const BackendOptions& options) {
  auto first = openDevice(options);
  if (!first || (*first)->info().device.type != "cpu") return first;
  const int lanes = std::min(threadCount(options.threads), most_lanes);
  return vulkan::makeLanes(
      std::move(*first), [options] { return openDevice(options); }, lanes);
}

std::vector<DeviceInfo> listVulkanDevices(const Mask& mask) {
  const Result<vulkan::Instance> instance = vulkan::Instance::open(false);
  if (!instance) return {absent(instance.error())};
  const Result<std::vector<vulkan::Physical>> devices = vulkan::enumerate(*instance, mask);
  if (!devices) return {absent(devices.error())};
  std::vector<DeviceInfo> list;
  for (const vulkan::Physical& device : *devices) list.push_back(device.info);
  return list;
}

}  // namespace vorpipe

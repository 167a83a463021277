#include "backend/vulkan/vulkan_backend.h"

#include <algorithm>
#include <utility>

#include "backend/vulkan/compute/compute.h"
#include "backend/vulkan/device/device_pool.h"
#include "backend/vulkan/device/error.h"
#include "backend/vulkan/device/instance.h"
#include "backend/vulkan/device/physical.h"
#include "backend/vulkan/geometry/geometry.h"
#include "base/parallel.h"

namespace vorpipe {
namespace {

using vulkan::Pipeline;

constexpr int most_devices = 8;

Result<std::unique_ptr<Backend>> openDevice(const BackendOptions& options, Pipeline pipeline,
                                            Drivers drivers) {
  Result<vulkan::Instance> instance = vulkan::Instance::open(options.validation);
  if (!instance) return tl::unexpected(std::move(instance).error());
  const Result<std::vector<vulkan::Physical>> devices = vulkan::enumerate(*instance, options.mask, pipeline);
  if (!devices) return tl::unexpected(devices.error());
  const Result<vulkan::Physical> device = vulkan::choose(*devices, options.device);
  if (!device) return tl::unexpected(device.error());
  if (drivers == Drivers::hardware && device->info.type == "cpu") {
    return vulkan::deviceError(device->info.name + " is a software driver");
  }
  if (pipeline == Pipeline::compute) {
    // Without a GPU the device is the host, which has the sites in their bins already.
    const bool is_host = device->info.type == "cpu";
    return vulkan::ComputeBackend::open(std::move(*instance), *device,
                                        is_host ? vulkan::SiteSorter::host : vulkan::SiteSorter::device);
  }
  return vulkan::GeometryBackend::open(std::move(*instance), *device);
}

void listDevices(const Mask& mask, Pipeline pipeline, std::vector<DeviceInfo>& list) {
  const auto absent = [&](const Error& error) {
    DeviceInfo info;
    info.backend = vulkan::nameOf(pipeline);
    info.reason = error.message;
    list.push_back(std::move(info));
  };
  const Result<vulkan::Instance> instance = vulkan::Instance::open(false);
  if (!instance) return absent(instance.error());
  const Result<std::vector<vulkan::Physical>> devices = vulkan::enumerate(*instance, mask, pipeline);
  if (!devices) return absent(devices.error());
  for (const vulkan::Physical& device : *devices) list.push_back(device.info);
}

}  // namespace

Result<std::unique_ptr<Backend>> makeVulkanGeometryBackend(const BackendOptions& options, Drivers drivers) {
  auto first = openDevice(options, Pipeline::geometry, drivers);
  if (!first || (*first)->info().device.type != "cpu") return first;
  const int devices = std::min(threadCount(options.threads), most_devices);
  return vulkan::makeDevicePool(
      std::move(*first), [options] { return openDevice(options, Pipeline::geometry, Drivers::any); },
      devices);
}

Result<std::unique_ptr<Backend>> makeVulkanComputeBackend(const BackendOptions& options, Drivers drivers) {
  return openDevice(options, Pipeline::compute, drivers);
}

std::vector<DeviceInfo> listVulkanDevices(const Mask& mask) {
  std::vector<DeviceInfo> list;
  listDevices(mask, Pipeline::geometry, list);
  listDevices(mask, Pipeline::compute, list);
  return list;
}

}  // namespace vorpipe

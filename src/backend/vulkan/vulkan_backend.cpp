#include "backend/vulkan/vulkan_backend.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "backend/vulkan/compute.h"
#include "backend/vulkan/device_pool.h"
#include "backend/vulkan/error.h"
#include "backend/vulkan/geometry.h"
#include "backend/vulkan/instance.h"
#include "backend/vulkan/physical.h"
#include "base/parallel.h"
#include "base/try.h"

namespace vorpipe {
namespace {

using vulkan::Pipeline;

constexpr int most_devices = 8;

Result<vulkan::Physical> chooseDevice(const vulkan::Instance& instance, const BackendOptions& options,
                                      Pipeline pipeline, Drivers drivers) {
  VORPIPE_LET(devices, vulkan::enumerate(instance, options.mask, pipeline));
  Result<vulkan::Physical> device = vulkan::choose(devices, options.device);
  if (device && drivers == Drivers::hardware && device->info.type == "cpu") {
    return vulkan::deviceError(device->info.name + " is a software driver");
  }
  if (device) device->waiting = options.waiting;
  return device;
}

Result<std::unique_ptr<Backend>> openDevice(vulkan::Instance instance, const vulkan::Physical& device,
                                            Pipeline pipeline) {
  if (pipeline == Pipeline::geometry) return vulkan::GeometryBackend::open(std::move(instance), device);
  // Without a GPU the device is the host, which has the sites in their bins already.
  const bool is_host = device.info.type == "cpu";
  return vulkan::ComputeBackend::open(std::move(instance), device,
                                      is_host ? vulkan::SiteSorter::host : vulkan::SiteSorter::device);
}

Result<std::unique_ptr<Backend>> openPipeline(const BackendOptions& options, Pipeline pipeline,
                                              Drivers drivers = Drivers::any) {
  VORPIPE_VAR(instance, vulkan::Instance::open(options.validation));
  VORPIPE_LET(device, chooseDevice(instance, options, pipeline, drivers));
  return openDevice(std::move(instance), device, pipeline);
}

/// A software driver runs geometry shaders on one thread: several devices then share the cells.
std::unique_ptr<Backend> onAllThreads(std::unique_ptr<Backend> first, const BackendOptions& options) {
  if (first->info().device.type != "cpu") return first;
  const int devices = std::min(threadCount(options.threads), most_devices);
  return vulkan::makeDevicePool(
      std::move(first), [options] { return openPipeline(options, Pipeline::geometry); }, devices);
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

Result<std::unique_ptr<Backend>> makeVulkanGeometryBackend(const BackendOptions& options) {
  auto first = openPipeline(options, Pipeline::geometry);
  if (!first) return first;
  return onAllThreads(std::move(*first), options);
}

Result<std::unique_ptr<Backend>> makeVulkanComputeBackend(const BackendOptions& options) {
  return openPipeline(options, Pipeline::compute);
}

Result<OpenedPipeline> makeVulkanBackend(const BackendOptions& options, Drivers drivers) {
  VORPIPE_VAR(instance, vulkan::Instance::open(options.validation));
  std::optional<Error> without_compute;
  Result<std::unique_ptr<Backend>> geometry = nullptr;
  if (const auto device = chooseDevice(instance, options, Pipeline::compute, drivers)) {
    auto compute = openDevice(std::move(instance), *device, Pipeline::compute);
    if (compute) return OpenedPipeline{std::move(*compute), {}};
    without_compute = compute.error();
    geometry = openPipeline(options, Pipeline::geometry, drivers);
  } else {
    without_compute = device.error();
    // The same instance: a new one would have the loader look through all drivers again.
    const auto other = chooseDevice(instance, options, Pipeline::geometry, drivers);
    if (!other) return tl::unexpected(*without_compute);
    geometry = openDevice(std::move(instance), *other, Pipeline::geometry);
  }
  if (!geometry) return tl::unexpected(*without_compute);
  return OpenedPipeline{onAllThreads(std::move(*geometry), options), without_compute};
}

std::vector<DeviceInfo> listVulkanDevices(const Mask& mask) {
  std::vector<DeviceInfo> list;
  listDevices(mask, Pipeline::geometry, list);
  listDevices(mask, Pipeline::compute, list);
  return list;
}

}  // namespace vorpipe

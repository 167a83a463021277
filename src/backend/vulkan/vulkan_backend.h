/// Vulkan behind the interface of backend.h: cells are clipped by a geometry shader or by a compute shader.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "backend/backend.h"

namespace vorpipe {

/// Opens the device that options name, or the best usable one: discrete before integrated, virtual,
/// cpu and other. Errors: no loader, driver or device, none that fits options.device, one that
/// lacks a feature (device; the message names the remedy); an unknown name in the mask (input).
Result<std::unique_ptr<Backend>> makeVulkanGeometryBackend(const BackendOptions& options);

/// The same for the pipeline without a geometry shader.
Result<std::unique_ptr<Backend>> makeVulkanComputeBackend(const BackendOptions& options);

struct OpenedPipeline {
  std::unique_ptr<Backend> backend;
  std::optional<Error> without_compute;  ///< why it is not the compute pipeline, if it is not
};

/// The same for any pipeline, on a device that fits `drivers`. Compute comes first: it is the faster of the
/// two on lavapipe, where geometry shaders run on one thread. Errors: as above, those of compute.
Result<OpenedPipeline> makeVulkanBackend(const BackendOptions& options, Drivers drivers);

/// Every Vulkan device in the order of its index, as it would be with mask, once for each pipeline;
/// without any, one entry for each pipeline that says why.
std::vector<DeviceInfo> listVulkanDevices(const Mask& mask);

}  // namespace vorpipe

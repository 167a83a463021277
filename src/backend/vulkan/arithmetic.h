/// Computing with numbers of the caller's.
#pragma once

#include <cstdint>
#include <span>

#include "backend/backend.h"
#include "backend/vulkan/device.h"

namespace vorpipe::vulkan {

/// What Backend::compute does, by a compute shader, in parts of at most storage_range bytes. All that it
/// makes on the device is gone when it returns.
Result<void> compute(Device& device, std::uint64_t storage_range, std::span<const Operands> operands,
                     std::span<Computed> out);

}  // namespace vorpipe::vulkan

/// Computes with the caller's numbers.
#pragma once

#include <cstdint>
#include <span>

#include "backend/backend.h"
#include "backend/vulkan/device.h"

namespace vorpipe::vulkan {

/// Implements Backend::compute with a compute shader, in parts of at most storage_range bytes. Frees all that
/// it makes on the device before it returns.
Result<void> compute(Device& device, std::uint64_t storage_range, std::span<const Operands> operands,
                     std::span<Computed> out);

}  // namespace vorpipe::vulkan

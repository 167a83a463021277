/// Converts VkResult to Error.
#pragma once

#include <volk.h>

#include <cstddef>
#include <string>
#include <string_view>

#include "base/try.h"
#include "vorpipe.h"

namespace vorpipe::vulkan {

/// The name of a result as the Vulkan specification writes it.
std::string resultName(VkResult result);

/// An ErrorCode::device, ready to return.
tl::unexpected<Error> deviceError(std::string message);

/// The error when the host cannot allocate memory for the answers about `cells` cells.
tl::unexpected<Error> outOfMemory(std::size_t cells);

/// Returns success for VK_SUCCESS, else an error that names the call, the result and what may help.
Result<void> check(VkResult result, std::string_view call);

}  // namespace vorpipe::vulkan

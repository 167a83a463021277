#include "backend/vulkan/error.h"

#include <utility>

namespace vorpipe::vulkan {
namespace {

bool saysMemoryIsShort(VkResult result) {
  return result == VK_ERROR_OUT_OF_HOST_MEMORY || result == VK_ERROR_OUT_OF_DEVICE_MEMORY ||
         result == VK_ERROR_MEMORY_MAP_FAILED || result == VK_ERROR_TOO_MANY_OBJECTS;
}

std::string_view remedy(VkResult result) {
  if (saysMemoryIsShort(result)) return "lower --limit maxTexelBufferElements or use --backend cpu";
  switch (result) {
    case VK_ERROR_DEVICE_LOST:
      return "the driver was reset; run again, with smaller batches (--limit maxTexelBufferElements=1000000) "
             "if it recurs";
    default:
      return "update the driver or use --backend cpu";
  }
}

}  // namespace

std::string resultName(VkResult result) {
  switch (result) {
    case VK_SUCCESS:
      return "VK_SUCCESS";
    case VK_NOT_READY:
      return "VK_NOT_READY";
    case VK_TIMEOUT:
      return "VK_TIMEOUT";
    case VK_INCOMPLETE:
      return "VK_INCOMPLETE";
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return "VK_ERROR_OUT_OF_HOST_MEMORY";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return "VK_ERROR_OUT_OF_DEVICE_MEMORY";
    case VK_ERROR_INITIALIZATION_FAILED:
      return "VK_ERROR_INITIALIZATION_FAILED";
    case VK_ERROR_DEVICE_LOST:
      return "VK_ERROR_DEVICE_LOST";
    case VK_ERROR_MEMORY_MAP_FAILED:
      return "VK_ERROR_MEMORY_MAP_FAILED";
    case VK_ERROR_LAYER_NOT_PRESENT:
      return "VK_ERROR_LAYER_NOT_PRESENT";
    case VK_ERROR_EXTENSION_NOT_PRESENT:
      return "VK_ERROR_EXTENSION_NOT_PRESENT";
    case VK_ERROR_FEATURE_NOT_PRESENT:
      return "VK_ERROR_FEATURE_NOT_PRESENT";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
      return "VK_ERROR_INCOMPATIBLE_DRIVER";
    case VK_ERROR_TOO_MANY_OBJECTS:
      return "VK_ERROR_TOO_MANY_OBJECTS";
    case VK_ERROR_FRAGMENTED_POOL:
      return "VK_ERROR_FRAGMENTED_POOL";
    case VK_ERROR_OUT_OF_POOL_MEMORY:
      return "VK_ERROR_OUT_OF_POOL_MEMORY";
    case VK_ERROR_SURFACE_LOST_KHR:
      return "VK_ERROR_SURFACE_LOST_KHR";
    case VK_ERROR_NATIVE_WINDOW_IN_USE_KHR:
      return "VK_ERROR_NATIVE_WINDOW_IN_USE_KHR";
    case VK_ERROR_OUT_OF_DATE_KHR:
      return "VK_ERROR_OUT_OF_DATE_KHR";
    default:
      return "VkResult " + std::to_string(static_cast<int>(result));
  }
}

tl::unexpected<Error> outOfMemory(std::size_t cells) {
  return tl::unexpected(Error{ErrorCode::device,
                              "not enough memory for " + std::to_string(cells) +
                                  " cells: free some, or ask for fewer cells at a time",
                              true});
}

tl::unexpected<Error> deviceError(std::string message) {
  return tl::unexpected(Error{ErrorCode::device, std::move(message)});
}

Result<void> check(VkResult result, std::string_view call) {
  if (result == VK_SUCCESS) return {};
  std::string message(call);
  message.append(" failed with ").append(resultName(result)).append(": ").append(remedy(result));
  return tl::unexpected(Error{ErrorCode::device, std::move(message), saysMemoryIsShort(result)});
}

}  // namespace vorpipe::vulkan

/// How Vulkan's structures begin.
#pragma once

#include <volk.h>

namespace vorpipe::vulkan {

/// A structure of a given type, zero otherwise.
template <class T>
constexpr T structure(VkStructureType type) {
  T zero{};
  zero.sType = type;
  return zero;
}

}  // namespace vorpipe::vulkan

#include "backend/vulkan/arithmetic.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>

#include "backend/vulkan/bindings.h"
#include "backend/vulkan/buffer.h"
#include "backend/vulkan/compute_kernels.h"
#include "backend/vulkan/error.h"
#include "base/try.h"
#include "shaders.h"

namespace vorpipe::vulkan {
namespace {

static_assert(sizeof(Operands) == 4 * sizeof(float) && sizeof(Computed) == 8 * sizeof(float));

constexpr VkDescriptorType storage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
constexpr std::array<VkDescriptorSetLayoutBinding, 2> bindings_used = {{
    {BINDING_ENTRIES, storage, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr},
    {BINDING_STATUS, storage, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr},
}};

}  // namespace

Result<void> compute(Device& device, std::uint64_t storage_range, std::span<const Operands> operands,
                     std::span<Computed> out) {
  assert(operands.size() == out.size() && storage_range >= sizeof(Computed));
  if (operands.empty()) return {};
  const std::size_t at_once =
      std::min({operands.size(), static_cast<std::size_t>(storage_range / sizeof(Computed)),
                most_groups * GROUP_SIZE});
  Buffer sent({"operands", VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, Placement::upload});
  Buffer answered({"what was computed", VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, Placement::download});
  VORPIPE_TRY(sent.reserve(device, at_once * sizeof(Operands), at_once * sizeof(Operands)));
  VORPIPE_TRY(answered.reserve(device, at_once * sizeof(Computed), at_once * sizeof(Computed)));
  VORPIPE_VAR(bindings, Bindings::create(device, bindings_used, sizeof(Slice)));
  bindings.setStorage(device, BINDING_ENTRIES, sent.get(), at_once * sizeof(Operands));
  bindings.setStorage(device, BINDING_STATUS, answered.get(), at_once * sizeof(Computed));
  VORPIPE_VAR(kernels, ComputeKernels::create(device));
  VORPIPE_LET(kernel, kernels.kernel(device, bindings.layout(), shaders::arithmetic()));
  for (std::size_t first = 0; first < operands.size(); first += at_once) {
    const std::size_t count = std::min(at_once, operands.size() - first);
    std::memcpy(sent.data(), &operands[first], count * sizeof(Operands));
    VORPIPE_TRY(device.run([&](VkCommandBuffer commands) {
      dispatch(device, commands, kernel, bindings, {0, static_cast<std::uint32_t>(count)}, count);
    }));
    std::memcpy(&out[first], answered.data(), count * sizeof(Computed));
  }
  return {};
}

}  // namespace vorpipe::vulkan

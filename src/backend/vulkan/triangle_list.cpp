#include "backend/vulkan/triangle_list.h"

#include <array>
#include <cassert>
#include <utility>

#include "backend/vulkan/error.h"
#include "base/try.h"
#include "shaders.h"

namespace vorpipe::vulkan {
namespace {

constexpr VkShaderStageFlags compute = VK_SHADER_STAGE_COMPUTE_BIT;
constexpr std::array<VkDescriptorSetLayoutBinding, 3> list_bindings = {{
    {BINDING_COUNTS, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, compute, nullptr},
    {BINDING_SUMS, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, compute, nullptr},
    {BINDING_INDICES, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, compute, nullptr},
}};

constexpr std::size_t word = sizeof(std::uint32_t);

std::size_t blocksOf(std::size_t counts) { return (counts + COUNTS_AT_ONCE - 1) / COUNTS_AT_ONCE; }

}  // namespace

Result<TriangleList> TriangleList::create(const Device& device) {
  VORPIPE_VAR(bindings, Bindings::create(device, list_bindings, sizeof(Slice)));
  return TriangleList(std::move(bindings));
}

Result<void> TriangleList::reserve(const Device& device, std::size_t polygons, std::size_t room) {
  const std::size_t sums_bytes = sizeof(VkDrawIndexedIndirectCommand) + blocksOf(polygons) * word;
  const std::size_t indices_bytes = polygons * 3 * (room - 2) * word;
  room_ = room;
  VORPIPE_TRY(counts_.reserve(device, polygons * word, polygons * word));
  VORPIPE_TRY(sums_.reserve(device, sums_bytes, sums_bytes));
  VORPIPE_TRY(indices_.reserve(device, indices_bytes, indices_bytes));
  bindings_.setStorage(device, BINDING_COUNTS, counts_.get(), polygons * word);
  bindings_.setStorage(device, BINDING_SUMS, sums_.get(), sums_bytes);
  bindings_.setStorage(device, BINDING_INDICES, indices_.get(), indices_bytes);
  return {};
}

Result<void> TriangleList::prepare(const Device& device, ComputeKernels& kernels) {
  assert(room_ == EDGES_FAST || room_ == EDGES_MOST);
  const ComputeKernels::Code list =
      room_ == EDGES_FAST ? shaders::list_triangles_fast() : shaders::list_triangles_roomy();
  for (const auto& [pipeline, code] : {std::pair(&sum_, shaders::sum_counts()),
                                       std::pair(&scan_, shaders::scan_sums()), std::pair(&list_, list)}) {
    VORPIPE_LET(kernel, kernels.kernel(device, bindings_.layout(), code));
    *pipeline = kernel;
  }
  return {};
}

void TriangleList::record(const Device& device, VkCommandBuffer commands, std::size_t polygons) const {
  const std::size_t blocks = blocksOf(polygons);
  const Slice all{0, static_cast<std::uint32_t>(polygons)};
  dispatch(device, commands, sum_, bindings_, all, blocks);
  orderShaders(device, commands);
  dispatch(device, commands, scan_, bindings_, {0, static_cast<std::uint32_t>(blocks)}, GROUP_SIZE);
  orderShaders(device, commands);
  dispatch(device, commands, list_, bindings_, all, blocks);
}

}  // namespace vorpipe::vulkan

#include "backend/vulkan/sorted_sites.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <utility>
#include <vector>

#include "backend/site_texels.h"
#include "backend/vulkan/error.h"
#include "backend/vulkan/handle.h"
#include "base/try.h"
#include "shaders.h"

namespace vorpipe::vulkan {
namespace {

constexpr std::size_t word = sizeof(std::uint32_t);

constexpr VkDescriptorType uniform = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
constexpr VkDescriptorType texels = VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
constexpr VkDescriptorType storage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
constexpr VkShaderStageFlags compute = VK_SHADER_STAGE_COMPUTE_BIT;

// No more than four storage buffers each, which every device has.
constexpr std::array<VkDescriptorSetLayoutBinding, 5> counting_bindings = {{
    {BINDING_GRID, uniform, 1, compute, nullptr},
    {BINDING_SITES, texels, 1, compute, nullptr},
    {BINDING_COUNTS, storage, 1, compute, nullptr},
    {BINDING_BIN_OF_SITE, storage, 1, compute, nullptr},
    {BINDING_RANK_OF_SITE, storage, 1, compute, nullptr},
}};
constexpr std::array<VkDescriptorSetLayoutBinding, 4> scanning_bindings = {{
    {BINDING_COUNTS, storage, 1, compute, nullptr},
    {BINDING_SUMS, storage, 1, compute, nullptr},
    {BINDING_BINS, storage, 1, compute, nullptr},
    {BINDING_MERGES, storage, 1, compute, nullptr},
}};
constexpr std::array<VkDescriptorSetLayoutBinding, 7> ordering_bindings = {{
    {BINDING_SITES, texels, 1, compute, nullptr},
    {BINDING_BINS, texels, 1, compute, nullptr},
    {BINDING_BIN_OF_SITE, texels, 1, compute, nullptr},
    {BINDING_FROM, storage, 1, compute, nullptr},
    {BINDING_SITE_OF_RANK, storage, 1, compute, nullptr},
    {BINDING_RANK_OF_SITE, storage, 1, compute, nullptr},
    {BINDING_SORTED_SITES, storage, 1, compute, nullptr},
}};

// A list of numbers that one shader writes and another reads.
Buffer::Kind listOf(std::string_view what) {
  return {what,
          VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |
              VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
          Placement::device, VK_FORMAT_R32_UINT};
}

std::size_t blocksOf(std::size_t counts) { return (counts + COUNTS_AT_ONCE - 1) / COUNTS_AT_ONCE; }

// Pairs of merges that the fullest bin could need: the k-th pair merges runs of RUN_SIZE * 4^k ranks.
std::size_t pairsOf(std::size_t sites) {
  std::size_t pairs = 0;
  for (std::size_t run = RUN_SIZE; run < sites; run *= 4) pairs++;
  return pairs;
}

constexpr std::size_t sumsBytes(std::size_t blocks) {
  return sizeof(VkDrawIndexedIndirectCommand) + blocks * word;
}

constexpr std::size_t dispatch_bytes = sizeof(VkDispatchIndirectCommand);

std::uint32_t number(std::size_t value) { return static_cast<std::uint32_t>(value); }

std::size_t groupsOf(std::size_t sites) {
  return std::min((sites + GROUP_SIZE - 1) / GROUP_SIZE, most_groups);
}

void order(const Device& device, VkCommandBuffer commands, VkPipelineStageFlags from, VkAccessFlags written,
           VkPipelineStageFlags to, VkAccessFlags used) {
  auto barrier = structure<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
  barrier.srcAccessMask = written;
  barrier.dstAccessMask = used;
  device.api().vkCmdPipelineBarrier(commands, from, to, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}

}  // namespace

Result<SortedSites> SortedSites::create(const Device& device) {
  VORPIPE_VAR(counting, Bindings::create(device, counting_bindings, sizeof(Slice)));
  VORPIPE_VAR(scanning, Bindings::create(device, scanning_bindings, sizeof(Slice)));
  VORPIPE_VAR(ordering, Bindings::create(device, ordering_bindings, sizeof(Slice)));
  VORPIPE_VAR(reordering, Bindings::create(device, ordering_bindings, sizeof(Slice)));
  VORPIPE_VAR(kernels, ComputeKernels::create(device));
  return SortedSites({std::move(counting), std::move(scanning), std::move(ordering), std::move(reordering)},
                     std::move(kernels));
}

SortedSites::SortedSites(Sets sets, ComputeKernels kernels)
    : sets_(std::move(sets)),
      kernels_(std::move(kernels)),
      bin_of_site_(listOf("bins of sites")),
      starts_(listOf("bins")),
      site_of_rank_(listOf("sites by rank")),
      rank_of_site_(listOf("ranks of sites")),
      sorted_({"sites in bins", VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
               Placement::device, VK_FORMAT_R32G32B32A32_SFLOAT}) {}

Result<void> SortedSites::upload(Device& device, Bindings& search, const SiteSet& sites,
                                 std::span<const std::uint8_t> palette_index, const BackendInfo& limits) {
  const Sizes sizes{sites.size(), std::size_t{sites.grid.columns} * sites.grid.rows};
  assert(sizes.sites <= limits.max_sites && sizes.bins <= limits.max_bins);
  VORPIPE_TRY(reserve(device, sizes, limits));
  send(sites);
  bind(device, sizes);
  VORPIPE_LET(made, steps(device));
  VORPIPE_TRY(device.run([&](VkCommandBuffer commands) { record(device, commands, made, sizes); }));
  search.setUniform(device, BINDING_GRID, grid_.get());
  search.setTexels(device, BINDING_SITES, sorted_.texels());
  search.setTexels(device, BINDING_BINS, starts_.texels());
  search.setTexels(device, BINDING_RANK_OF_SITE, rank_of_site_.texels());
  search.setTexels(device, BINDING_SITE_OF_RANK, site_of_rank_.texels());
  if (palette_index.empty()) return {};
  VORPIPE_TRY(marks_.reserve(device, sizes.sites * sizeof(SiteMark), limits.max_sites * sizeof(SiteMark)));
  writeSiteMarks(sites, palette_index, marks_.data());
  search.setTexels(device, BINDING_MARKS, marks_.texels());
  return {};
}

Result<void> SortedSites::reserve(const Device& device, const Sizes& sizes, const BackendInfo& limits) {
  const std::size_t most_sites = limits.max_sites;
  const std::size_t most_bins = limits.max_bins;
  VORPIPE_TRY(grid_.reserve(device, sizeof(SiteGridUniform), sizeof(SiteGridUniform)));
  for (Buffer* texel : {&sites_, &sorted_}) {
    VORPIPE_TRY(texel->reserve(device, sizes.sites * sizeof(SiteTexel), most_sites * sizeof(SiteTexel)));
  }
  for (Buffer* list : {&bin_of_site_, &site_of_rank_, &rank_of_site_, &spare_}) {
    VORPIPE_TRY(list->reserve(device, sizes.sites * word, most_sites * word));
  }
  VORPIPE_TRY(counts_.reserve(device, sizes.bins * word, most_bins * word));
  VORPIPE_TRY(sums_.reserve(device, sumsBytes(blocksOf(sizes.bins)), sumsBytes(blocksOf(most_bins))));
  VORPIPE_TRY(starts_.reserve(device, (sizes.bins + 1) * word, (most_bins + 1) * word));
  return merges_.reserve(device, (pairsOf(sizes.sites) + 1) * dispatch_bytes,
                         (pairsOf(most_sites) + 1) * dispatch_bytes);
}

void SortedSites::send(const SiteSet& sites) {
  SiteGridUniform block = siteGridUniform(sites);
  // The device's own bins add as many rounding errors again.
  block.slack *= 2;
  std::memcpy(grid_.data(), &block, sizeof(block));
  writeSiteTexels(sites, sites_.data());
  const std::vector<VkDispatchIndirectCommand> none(pairsOf(sites.size()) + 1, {0, 1, 1});
  std::memcpy(merges_.data(), none.data(), none.size() * dispatch_bytes);
}

void SortedSites::bind(const Device& device, const Sizes& sizes) {
  const std::size_t list_bytes = sizes.sites * word;
  Bindings& counting = sets_.counting;
  counting.setUniform(device, BINDING_GRID, grid_.get());
  counting.setTexels(device, BINDING_SITES, sites_.texels());
  counting.setStorage(device, BINDING_COUNTS, counts_.get(), sizes.bins * word);
  counting.setStorage(device, BINDING_BIN_OF_SITE, bin_of_site_.get(), list_bytes);
  counting.setStorage(device, BINDING_RANK_OF_SITE, rank_of_site_.get(), list_bytes);
  Bindings& scanning = sets_.scanning;
  scanning.setStorage(device, BINDING_COUNTS, counts_.get(), sizes.bins * word);
  scanning.setStorage(device, BINDING_SUMS, sums_.get(), sumsBytes(blocksOf(sizes.bins)));
  scanning.setStorage(device, BINDING_BINS, starts_.get(), (sizes.bins + 1) * word);
  scanning.setStorage(device, BINDING_MERGES, merges_.get(), (pairsOf(sizes.sites) + 1) * dispatch_bytes);
  sets_.ordering.setStorage(device, BINDING_FROM, spare_.get(), list_bytes);
  sets_.ordering.setStorage(device, BINDING_SITE_OF_RANK, site_of_rank_.get(), list_bytes);
  sets_.reordering.setStorage(device, BINDING_FROM, site_of_rank_.get(), list_bytes);
  sets_.reordering.setStorage(device, BINDING_SITE_OF_RANK, spare_.get(), list_bytes);
  for (Bindings* set : {&sets_.ordering, &sets_.reordering}) {
    set->setTexels(device, BINDING_SITES, sites_.texels());
    set->setTexels(device, BINDING_BINS, starts_.texels());
    set->setTexels(device, BINDING_BIN_OF_SITE, bin_of_site_.texels());
    set->setStorage(device, BINDING_RANK_OF_SITE, rank_of_site_.get(), list_bytes);
    set->setStorage(device, BINDING_SORTED_SITES, sorted_.get(), sizes.sites * sizeof(SiteTexel));
  }
}

Result<SortedSites::Steps> SortedSites::steps(const Device& device) {
  Steps made{};
  const struct {
    VkPipeline& pipeline;
    const Bindings& bindings;
    ComputeKernels::Code code;
  } wanted[] = {{made.count, sets_.counting, shaders::count_sites()},
                {made.sum, sets_.scanning, shaders::sum_counts()},
                {made.scan, sets_.scanning, shaders::scan_sums()},
                {made.start, sets_.scanning, shaders::bin_starts()},
                {made.scatter, sets_.reordering, shaders::scatter_sites()},
                {made.order, sets_.ordering, shaders::order_runs()},
                {made.merge, sets_.ordering, shaders::merge_runs()},
                {made.gather, sets_.reordering, shaders::gather_sites()}};
  for (const auto& step : wanted) {
    VORPIPE_LET(kernel, kernels_.kernel(device, step.bindings.layout(), step.code));
    step.pipeline = kernel;
  }
  return made;
}

void SortedSites::record(const Device& device, VkCommandBuffer commands, const Steps& steps,
                         const Sizes& sizes) const {
  const std::size_t groups = groupsOf(sizes.sites);
  const std::size_t blocks = blocksOf(sizes.bins);
  const Slice sites{0, number(sizes.sites)};
  device.api().vkCmdFillBuffer(commands, counts_.get(), 0, sizes.bins * word, 0);
  order(device, commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT,
        VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT);
  const auto step = [&](VkPipeline kernel, const Bindings& bindings, const Slice& slice, std::size_t count) {
    dispatch(device, commands, kernel, bindings, slice, count);
    orderShaders(device, commands);
  };
  step(steps.count, sets_.counting, sites, groups * GROUP_SIZE);
  step(steps.sum, sets_.scanning, {0, number(sizes.bins)}, blocks);
  step(steps.scan, sets_.scanning, {0, number(blocks)}, GROUP_SIZE);
  step(steps.start, sets_.scanning, {number(groups), number(sizes.bins)}, blocks);
  step(steps.scatter, sets_.reordering, sites, groups * GROUP_SIZE);
  step(steps.order, sets_.ordering, sites, groups * GROUP_SIZE);
  recordMerges(device, commands, steps, sizes.sites);
  step(steps.gather, sets_.reordering, sites, groups * GROUP_SIZE);
}

// Merges go from one list into the other and back, in pairs: whatever the number of pairs, the result is in
// the same list.
void SortedSites::recordMerges(const Device& device, VkCommandBuffer commands, const Steps& steps,
                               std::size_t sites) const {
  order(device, commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT,
        VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT, VK_ACCESS_INDIRECT_COMMAND_READ_BIT);
  std::size_t run = RUN_SIZE;
  for (std::size_t pair = 0; pair < pairsOf(sites); pair++) {
    for (const Bindings* bindings : {&sets_.reordering, &sets_.ordering}) {
      dispatchIndirect(device, commands, steps.merge, *bindings, {number(run), number(sites)},
                       {merges_.get(), pair * dispatch_bytes});
      orderShaders(device, commands);
      run *= 2;
    }
  }
}

}  // namespace vorpipe::vulkan

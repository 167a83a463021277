#include "space/vertex_blocks.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace vorpipe::space {
namespace {

constexpr std::size_t most_of_block = 96;

double along(const VertexSpot& spot, int axis) { return axis == 0 ? spot.x : axis == 1 ? spot.y : spot.z; }

}  // namespace

/// Let u = 2^-53, e the error of the place p and h half the lift. d is rounded (u of p . d), there are three
/// products and two sums (3 u), and the difference (u); h is off by 5 u, the difference by u: at most |d| (e
/// + 8 u |p|) + 8 u h in all, of which the first factor is a vertex' slack. Products that underflow: 2^-1070.
HalfSpace::HalfSpace(const Relative& of)
    : d_(of),
      half_(0.5 * of.lift),
      size_((1 + 0x1p-50) * of.size()),
      fixed_(0x1p-50 * std::abs(half_) + 0x1p-1070) {}

VertexBlocks::VertexBlocks(std::span<const VertexSpot> spots) : block_of_(spots.size(), 0) {
  std::vector<std::uint32_t> all(spots.size());
  std::iota(all.begin(), all.end(), 0U);
  blocks_.push_back({std::move(all), {}, {}, 0, 0, false});
  touch(0);
  update(spots);
}

void VertexBlocks::find(const HalfSpace& half_space, std::vector<std::uint32_t>& vertices) const {
  for (const Block& block : blocks_) {
    // Each step is rounded in the direction of its value, so that no vertex of the block is computed to be
    // higher.
    if (half_space.mostAbove(block.low, block.high) < -half_space.error(block.slack)) continue;
    vertices.insert(vertices.end(), block.vertices.begin(), block.vertices.end());
  }
}

void VertexBlocks::touch(std::uint32_t block) {
  if (blocks_[block].touched) return;
  blocks_[block].touched = true;
  touched_.push_back(block);
}

void VertexBlocks::append(std::uint32_t near) {
  const std::uint32_t block = block_of_[near];
  blocks_[block].vertices.push_back(static_cast<std::uint32_t>(block_of_.size()));
  block_of_.push_back(block);
  touch(block);
}

void VertexBlocks::replaceByLast(std::uint32_t vertex) {
  const auto last = static_cast<std::uint32_t>(block_of_.size() - 1);
  auto& own = blocks_[block_of_[vertex]].vertices;
  touch(block_of_[vertex]);
  own.erase(std::ranges::find(own, vertex));
  if (vertex != last) {
    std::ranges::replace(blocks_[block_of_[last]].vertices, last, vertex);
    block_of_[vertex] = block_of_[last];
  }
  block_of_.pop_back();
}

/// Splits blocks of too many at the middle of their longest side.
void VertexBlocks::update(std::span<const VertexSpot> spots) {
  while (!touched_.empty()) {
    const std::uint32_t at = touched_.back();
    touched_.pop_back();
    blocks_[at].touched = false;
    measure(at, spots);
    Block& block = blocks_[at];
    if (block.vertices.size() <= most_of_block) continue;
    const double sides[3] = {block.high.x - block.low.x, block.high.y - block.low.y,
                             block.high.z - block.low.z};
    const int axis = static_cast<int>(std::ranges::max_element(sides) - sides);
    const auto middle = block.vertices.begin() + static_cast<std::ptrdiff_t>(block.vertices.size() / 2);
    std::ranges::nth_element(block.vertices, middle, {},
                             [&](std::uint32_t v) { return along(spots[v], axis); });
    std::vector<std::uint32_t> upper(middle, block.vertices.end());
    block.vertices.erase(middle, block.vertices.end());
    const auto added = static_cast<std::uint32_t>(blocks_.size());
    for (const std::uint32_t v : upper) block_of_[v] = added;
    blocks_.push_back({std::move(upper), {}, {}, 0, 0, false});
    touch(at);
    touch(added);
  }
}

void VertexBlocks::measure(std::uint32_t at, std::span<const VertexSpot> spots) {
  constexpr double far = std::numeric_limits<double>::infinity();
  Block& block = blocks_[at];
  block.low = {far, far, far};
  block.high = {-far, -far, -far};
  block.slack = block.squared = 0;
  for (const std::uint32_t v : block.vertices) {
    const VertexSpot& spot = spots[v];
    block.low = {std::min(block.low.x, spot.x), std::min(block.low.y, spot.y), std::min(block.low.z, spot.z)};
    block.high = {std::max(block.high.x, spot.x), std::max(block.high.y, spot.y),
                  std::max(block.high.z, spot.z)};
    block.slack = std::max(block.slack, spot.slack);
    block.squared = std::max(block.squared, spot.squared);
  }
}

double VertexBlocks::largestSquared() const {
  double largest = 0;
  for (const Block& block : blocks_) largest = std::max(largest, block.squared);
  return largest;
}

}  // namespace vorpipe::space

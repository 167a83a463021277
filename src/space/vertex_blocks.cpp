#include "space/vertex_blocks.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace vorpipe::space {
namespace {

constexpr std::size_t first_of_block = 48;

double along(const VertexSpot& spot, int axis) { return axis == 0 ? spot.x : axis == 1 ? spot.y : spot.z; }

}  // namespace

/// Let u = 2^-53, e the error of the place p and h half the lift. d is rounded (u of p . d), there are three
/// products and two sums (3 u), and the difference (u); h is off by 5 u, the difference by u: at most |d| (e
/// + 8 u |p|) + 8 u h in all, of which the first factor is a vertex' slack. With weights h stands for half
/// the lift's size there, and is off by 6 u of it. Products that underflow: 2^-1070.
HalfSpace::HalfSpace(const Relative& of)
    : d_(of),
      half_(0.5 * of.lift),
      squared_((of.x * of.x + of.y * of.y) + of.z * of.z),
      size_((1 + 0x1p-50) * of.size()),
      fixed_(0x1p-50 * (0.5 * of.lift_size) + 0x1p-1070) {}

VertexBlocks::VertexBlocks(std::span<const VertexSpot> spots)
    : block_of_(spots.size()), first_size_(spots.size()) {
  std::vector<std::uint32_t> all(spots.size());
  std::iota(all.begin(), all.end(), 0U);
  make(all, spots);
}

/// Halves at the middle of the longest side what is too many for a block.
void VertexBlocks::make(std::span<std::uint32_t> vertices, std::span<const VertexSpot> spots) {
  if (vertices.size() <= first_of_block) {
    const auto block = static_cast<std::uint32_t>(blocks_.size());
    blocks_.emplace_back().vertices.assign(vertices.begin(), vertices.end());
    for (const std::uint32_t v : vertices) block_of_[v] = block;
    measure(block, spots);
    return;
  }
  const auto side = [&](int axis) {
    const auto at = [&](std::uint32_t v) { return along(spots[v], axis); };
    const auto [low, high] = std::ranges::minmax(vertices, {}, at);
    return at(high) - at(low);
  };
  const double sides[3] = {side(0), side(1), side(2)};
  const int axis = static_cast<int>(std::ranges::max_element(sides) - sides);
  const std::size_t half = vertices.size() / 2;
  const auto middle = vertices.begin() + static_cast<std::ptrdiff_t>(half);
  std::ranges::nth_element(vertices, middle, {}, [&](std::uint32_t v) { return along(spots[v], axis); });
  make(vertices.first(half), spots);
  make(vertices.subspan(half), spots);
}

/// A vertex p has p . d <= (p . n) (n . d) + |p across n| |d across n|. Computed with an axis n whose length
/// is 4 u off, from places that are projected with errors of 6 u, it is right to 22 u |p| |d|. Three times
/// the slack are more.
void VertexBlocks::find(const HalfSpace& half_space, std::vector<std::uint32_t>& vertices) const {
  for (const Block& block : blocks_) {
    const double along = half_space.along(block.axis), across = half_space.across(along);
    const double most = along * (along > 0 ? block.high : block.low) + across * block.across;
    if (most - half_space.half() < -half_space.error(4 * block.slack)) continue;
    vertices.insert(vertices.end(), block.vertices.begin(), block.vertices.end());
  }
}

void VertexBlocks::touch(std::uint32_t block) {
  if (blocks_[block].touched) return;
  blocks_[block].touched = true;
  touched_.push_back(block);
}

void VertexBlocks::move(std::uint32_t vertex) {
  touch(block_of_[vertex]);
  ++changes_;
}

void VertexBlocks::append(std::uint32_t near) {
  const std::uint32_t block = block_of_[near];
  blocks_[block].vertices.push_back(static_cast<std::uint32_t>(block_of_.size()));
  block_of_.push_back(block);
  touch(block);
  ++changes_;
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

void VertexBlocks::update(std::span<const VertexSpot> spots) {
  for (const std::uint32_t block : touched_) {
    blocks_[block].touched = false;
    measure(block, spots);
  }
  touched_.clear();
}

void VertexBlocks::measure(std::uint32_t at, std::span<const VertexSpot> spots) {
  Block& block = blocks_[at];
  Point3 sum{};
  for (const std::uint32_t v : block.vertices) {
    sum = {sum.x + spots[v].x, sum.y + spots[v].y, sum.z + spots[v].z};
  }
  const double length = std::sqrt(sum.x * sum.x + sum.y * sum.y + sum.z * sum.z);
  const bool usable = length > 0x1p-400 && length < 0x1p400;
  block.axis = usable ? Point3{sum.x / length, sum.y / length, sum.z / length} : Point3{1, 0, 0};
  block.high = block.across = block.slack = block.squared = 0;
  block.low = std::numeric_limits<double>::infinity();
  if (block.vertices.empty()) block.low = 0;
  for (const std::uint32_t v : block.vertices) {
    const VertexSpot& spot = spots[v];
    const double height = (spot.x * block.axis.x + spot.y * block.axis.y) + spot.z * block.axis.z;
    const double x = spot.x - height * block.axis.x, y = spot.y - height * block.axis.y,
                 z = spot.z - height * block.axis.z;
    block.low = std::min(block.low, height);
    block.high = std::max(block.high, height);
    block.across = std::max(block.across, std::sqrt(x * x + y * y + z * z));
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

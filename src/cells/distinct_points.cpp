#include <fmt/core.h>

#include <bit>
#include <limits>

#include "vorpipe.h"

namespace vorpipe {
namespace {

constexpr std::uint32_t vacant = std::numeric_limits<std::uint32_t>::max();

std::size_t hash(const Point& point) {
  // Adding 0 makes -0 and 0, which are equal, one bit pattern.
  const auto x = std::bit_cast<std::uint64_t>(point.x + 0.0);
  const auto y = std::bit_cast<std::uint64_t>(point.y + 0.0);
  std::uint64_t bits = (x ^ std::rotl(y, 32)) * 0x9E3779B97F4A7C15u;
  bits ^= bits >> 32;
  bits *= 0xD6E8FEB86659FD93u;
  return bits ^ bits >> 32;
}

/// Indexes positions by value. Uses open addressing: one allocation, where a standard map makes one for each
/// of tens of millions of points.
class PointTable {
 public:
  PointTable(std::size_t most_points, std::vector<Point>& points)
      : slots_(std::bit_ceil(2 * most_points + 1), vacant), points_(points) {}

  std::uint32_t indexOf(const Point& point) {
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t slot = hash(point) & mask;; slot = (slot + 1) & mask) {
      std::uint32_t& index = slots_[slot];
      if (index == vacant) {
        index = static_cast<std::uint32_t>(points_.size());
        points_.push_back(point);
        return index;
      }
      const Point& known = points_[index];
      if (known.x == point.x && known.y == point.y) return index;
    }
  }

 private:
  std::vector<std::uint32_t> slots_;
  std::vector<Point>& points_;
};

}  // namespace

Result<DistinctPoints> distinctPoints(std::span<const Point> points) {
  if (points.size() >= vacant) {
    return tl::unexpected(
        Error{ErrorCode::input, fmt::format("{} points are more than {}", points.size(), vacant - 1)});
  }
  DistinctPoints distinct;
  PointTable table(points.size(), distinct.points);
  distinct.index_of.reserve(points.size());
  for (const Point& point : points) distinct.index_of.push_back(table.indexOf(point));
  return distinct;
}

}  // namespace vorpipe

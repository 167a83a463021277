#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "domain/degrees.h"
#include "globe/direction.h"
#include "vorpipe/globe.h"

namespace vorpipe {
namespace {

using namespace core;

constexpr std::uint64_t gridSize(std::uint64_t parts) { return 10 * parts * parts + 2; }

/// How many parts each edge of the icosahedron has, rounded down, at least 1.
std::uint64_t partsOf(std::uint64_t n) {
  auto parts = static_cast<std::uint64_t>(std::sqrt(static_cast<double>(n) / 10));
  while (gridSize(parts + 1) <= n) ++parts;
  while (parts > 1 && gridSize(parts) > n) --parts;
  return std::max<std::uint64_t>(parts, 1);
}

/// Poles, and rings of five north and south of the equator.
std::array<Direction, 12> icosahedron() {
  constexpr double fifth = whole_turn / 5;
  const double latitude = std::atan(0.5) / degree;
  std::array<Direction, 12> vertices;
  vertices[0] = {0, 0, 1};
  vertices[11] = {0, 0, -1};
  for (std::size_t k = 0; k < 5; ++k) {
    const double longitude = static_cast<double>(k) * fifth;
    vertices[1 + k] = directionOf({longitude, latitude});
    vertices[6 + k] = directionOf({longitude + fifth / 2, -latitude});
  }
  return vertices;
}

using Face = std::array<std::size_t, 3>;

std::vector<Face> facesOfIcosahedron() {
  std::vector<Face> faces;
  for (std::size_t k = 0; k < 5; ++k) {
    const auto next = (k + 1) % 5;
    const auto upper = 1 + k, upper_next = 1 + next, lower = 6 + k, lower_next = 6 + next;
    faces.push_back({0, upper, upper_next});
    faces.push_back({upper, lower, upper_next});
    faces.push_back({upper_next, lower, lower_next});
    faces.push_back({lower, 11, lower_next});
  }
  return faces;
}

/// Points of a face in rows from its first corner: row r has r + 1.
class FaceGrid {
 public:
  FaceGrid(const std::array<Direction, 3>& corner, std::uint64_t parts) {
    std::uint64_t odd = parts;
    while (odd % 2 == 0) odd /= 2;
    resize(odd);
    for (std::uint64_t r = 0; r <= odd; ++r) {
      for (std::uint64_t c = 0; c <= r; ++c) {
        at(r, c) = normalized(static_cast<double>(odd - r) * corner[0] +
                              static_cast<double>(r - c) * corner[1] + static_cast<double>(c) * corner[2]);
      }
    }
    while (parts_ < parts) halve();
  }

  Direction& at(std::uint64_t r, std::uint64_t c) { return points_[r * (r + 1) / 2 + c]; }

 private:
  void resize(std::uint64_t parts) {
    parts_ = parts;
    points_.resize((parts + 1) * (parts + 2) / 2);
  }

  /// Halves each edge along its great circle.
  void halve() {
    FaceGrid old = *this;
    resize(2 * parts_);
    for (std::uint64_t r = 0; r <= parts_; ++r) {
      for (std::uint64_t c = 0; c <= r; ++c) {
        const bool is_old = r % 2 == 0 && c % 2 == 0;
        const Direction &low = old.at(r / 2, c / 2), &high = old.at((r + 1) / 2, (c + 1) / 2);
        at(r, c) = is_old ? low : normalized(low + high);
      }
    }
  }

  std::uint64_t parts_ = 0;
  std::vector<Direction> points_;
};

void add(Sites& sites, const Direction& at) {
  const Point place = placeOf(at);
  sites.x.push_back(place.x);
  sites.y.push_back(place.y);
}

/// Corners, then face by face: points of edges that no face before has, and of the inside.
Sites geodesicGrid(std::uint64_t parts) {
  const auto vertices = icosahedron();
  Sites sites;
  for (const Direction& vertex : vertices) add(sites, vertex);
  std::array<std::array<bool, 12>, 12> has_edge{};
  for (const Face& face : facesOfIcosahedron()) {
    FaceGrid grid({vertices[face[0]], vertices[face[1]], vertices[face[2]]}, parts);
    const auto isNew = [&](std::size_t a, std::size_t b) {
      const auto [low, high] = std::minmax(face[a], face[b]);
      return !std::exchange(has_edge[low][high], true);
    };
    const bool left = isNew(0, 1), right = isNew(0, 2), last = isNew(1, 2);
    for (std::uint64_t r = 1; r <= parts; ++r) {
      for (std::uint64_t c = 0; c <= r; ++c) {
        const bool is_corner = r == parts && (c == 0 || c == r);
        const bool is_kept = r == parts ? last : c == 0 ? left : c == r ? right : true;
        if (is_kept && !is_corner) add(sites, grid.at(r, c));
      }
    }
  }
  return sites;
}

/// A spiral from pole to pole, whose turns have equal distances.
Sites fibonacciSpiral(std::uint64_t n) {
  constexpr double golden_part = 0.38196601125010515180;  // of a turn
  Sites sites;
  for (std::uint64_t k = 0; k < n; ++k) {
    const double turns = static_cast<double>(k) * golden_part;
    const double sine = 1 - static_cast<double>(2 * k + 1) / static_cast<double>(n);
    sites.x.push_back(whole_turn * (turns - std::floor(turns) - 0.5));
    sites.y.push_back(std::asin(sine) / degree);
  }
  return sites;
}

}  // namespace

Result<Sites> generateOnGlobe(GlobePattern pattern, std::uint64_t n) {
  if (pattern == GlobePattern::fibonacci) return fibonacciSpiral(n);
  const auto parts = partsOf(n);
  if (gridSize(parts) == n) return geodesicGrid(parts);
  return tl::unexpected(Error{
      ErrorCode::input, fmt::format("no geodesic grid has {} places: they have 10 k^2 + 2, and next to it "
                                    "are {} and {}",
                                    n, gridSize(parts), gridSize(parts + 1))});
}

}  // namespace vorpipe

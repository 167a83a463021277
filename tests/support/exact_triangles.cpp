#include "support/exact_triangles.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace vorpipe::test {
namespace {

using Number = CGAL::Exact_predicates_exact_constructions_kernel::FT;

constexpr std::size_t most_faults_told = 10;

/// Ties end in one vertex, which may shorten several edges below nothing; by this, as a part of the
/// distance of two sites, at most.
constexpr double tie = 1e-5;

/// A side of a triangle, and the corner on the left of the way along it.
struct Side {
  std::uint32_t from, to, left;
  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> way() const { return {from, to}; }
};

class Triangles {
 public:
  Triangles(const Diagram& diagram, const Sites& sites, const Box& domain)
      : diagram_(diagram), sites_(sites), domain_(domain) {}

  TriangleFaults run(std::uint64_t count) {
    if (diagram_.triangles.size() != count)
      fault(faults_.missing, "{} triangles, not {}", diagram_.triangles.size(), count);
    for (const auto& triangle : diagram_.triangles) addTriangle(triangle);
    std::sort(sides_.begin(), sides_.end(), [](const auto& a, const auto& b) { return a.way() < b.way(); });
    for (std::size_t k = 1; k < sides_.size(); ++k) {
      if (sides_[k].way() == sides_[k - 1].way())
        fault(faults_.overlapping, "two triangles stand on the left of {}, {}", sides_[k].from, sides_[k].to);
    }
    for (const auto& side : sides_) {
      if (side.from < side.to) checkLocally(side);
    }
    for (std::uint32_t i = 0; i < sites_.size(); ++i) checkCorners(i);
    return std::move(faults_);
  }

 private:
  template <class... Args>
  void fault(std::uint64_t& count, fmt::format_string<Args...> format, Args&&... args) {
    ++count;
    if (faults_.first.size() < most_faults_told)
      faults_.first.push_back(fmt::format(format, std::forward<Args>(args)...));
  }

  struct Vector {
    Number x, y;
  };

  [[nodiscard]] Vector way(std::uint32_t from, std::uint32_t to) const {
    return {Number(sites_.x[to]) - Number(sites_.x[from]), Number(sites_.y[to]) - Number(sites_.y[from])};
  }

  static Number cross(const Vector& a, const Vector& b) { return a.x * b.y - a.y * b.x; }

  void addTriangle(const std::array<std::uint32_t, 3>& triangle) {
    const auto& [i, j, k] = triangle;
    const bool known = std::ranges::all_of(triangle, [&](auto site) {
      return site < sites_.size() && diagram_.status[site] != Status::duplicate;
    });
    if (!known || cross(way(i, j), way(i, k)) <= 0) {
      fault(faults_.turned, "triangle {}, {}, {} is not counter-clockwise, or has a duplicate", i, j, k);
      return;
    }
    sides_.push_back({i, j, k});
    sides_.push_back({j, k, i});
    sides_.push_back({k, i, j});
  }

  [[nodiscard]] const Side* find(std::uint32_t from, std::uint32_t to) const {
    const auto wanted = std::pair(from, to);
    const auto found = std::lower_bound(sides_.begin(), sides_.end(), wanted,
                                        [](const auto& side, const auto& w) { return side.way() < w; });
    return found != sides_.end() && found->way() == wanted ? &*found : nullptr;
  }

  /// Where on the bisector of a side is the center of a triangle that stands on it, as in exact_cells.
  [[nodiscard]] Number center(std::uint32_t from, const Vector& d, std::uint32_t third) const {
    const auto e = way(from, third);
    return (e.x * (e.x - d.x) + e.y * (e.y - d.y)) / (2 * cross(d, e));
  }

  void checkLocally(const Side& side) {
    const auto* back = find(side.to, side.from);
    if (!back) return;
    const auto d = way(side.from, side.to);
    const Number edge = center(side.from, d, side.left) - center(side.from, d, back->left);
    if (edge < -tie)
      fault(faults_.not_local,
            "the triangles of {}, {} with {} and {} should be flipped: edge {} of the distance", side.from,
            side.to, side.left, back->left, CGAL::to_double(edge));
  }

  [[nodiscard]] bool isOnWall(Point p) const {
    return p.x == domain_.xmin || p.x == domain_.xmax || p.y == domain_.ymin || p.y == domain_.ymax;
  }

  /// A corner of a cell that lies in the domain is the center of a triangle, which stands on the left of
  /// the way to the neighbor before the corner.
  void checkCorners(std::uint32_t i) {
    const auto begin = diagram_.cell_offsets[i];
    const auto end = diagram_.cell_offsets[i + 1];
    for (auto e = begin; e < end; ++e) {
      const auto next = e + 1 < end ? e + 1 : begin;
      const auto neighbor = diagram_.neighbors[e];
      if (neighbor < 0 || diagram_.neighbors[next] < 0 || isOnWall(diagram_.vertices[next])) continue;
      if (!find(i, static_cast<std::uint32_t>(neighbor)))
        fault(faults_.missing, "no triangle stands on the left of {}, {}", i, neighbor);
    }
  }

  const Diagram& diagram_;
  const Sites& sites_;
  const Box& domain_;
  std::vector<Side> sides_;
  TriangleFaults faults_;
};

}  // namespace

TriangleFaults findTriangleFaults(const Diagram& diagram, const Sites& sites, const Box& domain,
                                  std::uint64_t count) {
  return Triangles(diagram, sites, domain).run(count);
}

}  // namespace vorpipe::test

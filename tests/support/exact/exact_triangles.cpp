#include "support/exact/exact_triangles.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "support/exact/exact_bisector.h"

namespace vorpipe::test {
namespace {

constexpr std::size_t most_faults_told = 10;

/// Ties end in one vertex, which may shorten several edges below nothing; by this, as a part of the
/// distance of the sites that meet there, at most.
constexpr double tie = 1e-5;

/// A side of a triangle, and the corner on the left of the way along it.
struct Side {
  std::uint32_t from, to, left;
  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> way() const { return {from, to}; }
};

class Triangles {
 public:
  Triangles(const Diagram& diagram, const Sites& sites, const Box& domain, const ExactCells& exact)
      : diagram_(diagram), places_(sites), domain_(domain), exact_(exact) {}

  TriangleFaults run() {
    if (diagram_.triangles.size() != exact_.triangles)
      fault(faults_.missing, "{} triangles, not {}", diagram_.triangles.size(), exact_.triangles);
    for (const auto& triangle : diagram_.triangles) addTriangle(triangle);
    std::sort(sides_.begin(), sides_.end(), [](const auto& a, const auto& b) { return a.way() < b.way(); });
    for (std::size_t k = 1; k < sides_.size(); ++k) {
      if (sides_[k].way() == sides_[k - 1].way())
        fault(faults_.overlapping, "two triangles stand on the left of {}, {}", sides_[k].from, sides_[k].to);
    }
    for (const auto& side : sides_) {
      if (side.from < side.to) checkLocally(side);
    }
    for (std::uint32_t i = 0; i < exact_.owner.size(); ++i) checkCorners(i);
    return std::move(faults_);
  }

 private:
  template <class... Args>
  void fault(std::uint64_t& count, fmt::format_string<Args...> format, Args&&... args) {
    ++count;
    if (faults_.first.size() < most_faults_told)
      faults_.first.push_back(fmt::format(format, std::forward<Args>(args)...));
  }

  void addTriangle(const std::array<std::uint32_t, 3>& triangle) {
    const auto& [i, j, k] = triangle;
    const bool known = std::ranges::all_of(triangle, [&](auto site) {
      return site < exact_.owner.size() && exact_.owner[site] == site && exact_.hidden[site] == 0;
    });
    if (!known || cross(places_.way(i, j), places_.way(i, k)) <= 0) {
      fault(faults_.turned, "triangle {}, {}, {} is not counter-clockwise, or has a duplicate or hidden site",
            i, j, k);
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

  /// The square of the longest way between the corners of two triangles that share a side.
  [[nodiscard]] Number widest(const Side& side, std::uint32_t right) const {
    Number most = 0;
    for (const auto a : {side.from, side.to, side.left}) {
      for (const auto b : {side.left, side.to, right}) {
        const auto d = places_.way(a, b);
        most = std::max(most, Number(dot(d, d)));
      }
    }
    return most;
  }

  void checkLocally(const Side& side) {
    const auto* back = find(side.to, side.from);
    if (!back) return;
    const auto bisector = places_.bisector(side.from, side.to);
    const Number edge =
        places_.meeting(side.from, bisector, side.left) - places_.meeting(side.from, bisector, back->left);
    if (edge < 0 && edge * edge * bisector.squared > tie * tie * widest(side, back->left))
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
  ExactPlaces places_;
  const Box& domain_;
  const ExactCells& exact_;
  std::vector<Side> sides_;
  TriangleFaults faults_;
};

}  // namespace

TriangleFaults findTriangleFaults(const Diagram& diagram, const Sites& sites, const Box& domain,
                                  const ExactCells& exact) {
  return Triangles(diagram, sites, domain, exact).run();
}

}  // namespace vorpipe::test

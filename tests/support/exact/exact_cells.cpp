#include "support/exact/exact_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "support/exact/exact_bisector.h"
#include "support/exact/exact_neighbors.h"

namespace vorpipe::test {
namespace {

/// An interval that begins unbounded.
struct Interval {
  std::optional<Number> low, high;
  bool tightened = false;

  void atLeast(const Number& bound) {
    if (low && *low >= bound) return;
    low = bound;
    tightened = true;
  }
  void atMost(const Number& bound) {
    if (high && *high <= bound) return;
    high = bound;
    tightened = true;
  }
};

/// The cell of one site, in coordinates relative to the site.
class Cell {
 public:
  Cell(const Sites& sites, const Box& domain, std::uint32_t site) : places_(sites), site_(site) {
    const Number x(sites.x[site]);
    const Number y(sites.y[site]);
    walls_ = {Number(domain.xmin) - x, Number(domain.xmax) - x, Number(domain.ymin) - y,
              Number(domain.ymax) - y};
    cancels_ = walls_[0] > 0 || walls_[1] < 0 || walls_[2] > 0 || walls_[3] < 0;
  }

  void measure(const std::vector<Spoke>& spokes) {
    std::vector<Bisector> bisectors;
    for (const auto& spoke : spokes) {
      bisectors.push_back(places_.bisector(site_, spoke.to));
      cancels_ = cancels_ || bisectors.back().reach < 0;
    }
    bool inside = !spokes.empty();
    for (std::size_t k = 0; k < spokes.size(); ++k) inside = addEdge(spokes[k], bisectors[k]) && inside;
    if (inside) return;
    for (std::size_t wall = 0; wall < 4; ++wall) addWall(wall, bisectors);
  }

  [[nodiscard]] double area() const { return added_ + CGAL::to_double(to_cancel_); }
  std::vector<ExactEdge> edges;

 private:
  /// Adds the triangle between the site and an edge. Triangles of a site outside of its cell cancel each
  /// other, and only exact numbers stand that; the others need not grow with their number.
  void addArea(const Number& triangle) {
    if (cancels_) {
      to_cancel_ += triangle;
    } else {
      added_ += CGAL::to_double(triangle);
    }
  }

  /// Leaves of the bisector what lies between two walls. At `t` its coordinate is middle + t * slope.
  /// False if nothing is left.
  static bool clip(Interval& part, const Number& middle, const Number& slope, const Number& low,
                   const Number& high) {
    if (slope == 0) return low < middle && middle < high;
    const Number a = (low - middle) / slope;
    const Number b = (high - middle) / slope;
    part.atLeast(slope > 0 ? a : b);
    part.atMost(slope > 0 ? b : a);
    return true;
  }

  /// Adds the edge to a neighbor. Returns whether the domain holds all of the edge.
  bool addEdge(const Spoke& spoke, const Bisector& bisector) {
    const auto& [d, squared, reach] = bisector;
    Interval part;
    if (spoke.left != no_site) part.high = places_.meeting(site_, bisector, spoke.left);
    if (spoke.right != no_site) part.low = places_.meeting(site_, bisector, spoke.right);
    if (!clip(part, d.x * reach / 2, -d.y, walls_[0], walls_[1]) ||
        !clip(part, d.y * reach / 2, d.x, walls_[2], walls_[3]))
      return false;
    if (*part.low < *part.high) {
      const Number length = *part.high - *part.low;
      addArea(length * squared * reach / 4);
      const double in_distances = CGAL::to_double(length);
      const double distance = std::hypot(CGAL::to_double(d.x), CGAL::to_double(d.y));
      edges.push_back({spoke.to, in_distances * distance, in_distances});
    }
    return !part.tightened;
  }

  /// Adds what the cell has of a wall: the wall cut by all bisectors.
  void addWall(std::size_t wall, const std::vector<Bisector>& bisectors) {
    const bool upright = wall < 2;
    const bool greater = wall % 2 == 1;
    const Number& place = walls_[wall];
    Interval part{walls_[upright ? 2 : 0], walls_[upright ? 3 : 1]};
    for (const auto& [d, squared, reach] : bisectors) {
      const Number& across = upright ? d.x : d.y;
      const Number& along = upright ? d.y : d.x;
      const Number room = squared * reach / 2 - place * across;
      if (along > 0) part.atMost(room / along);
      if (along < 0) part.atLeast(room / along);
      // A bisector that lies in the wall leaves it to the site inside.
      if (along == 0 && (room < 0 || (room == 0 && (across > 0) != greater))) return;
    }
    if (!(*part.low < *part.high)) return;
    const Number length = *part.high - *part.low;
    const Number height = greater ? place : Number(-place);
    addArea(length * height / 2);
    const double length_there = CGAL::to_double(length);
    const double mirrored = 2 * std::abs(CGAL::to_double(height));
    edges.push_back({-1 - static_cast<std::int64_t>(wall), length_there,
                     mirrored > 0 ? length_there / mirrored : std::numeric_limits<double>::infinity()});
  }

  ExactPlaces places_;
  std::uint32_t site_;
  std::array<Number, 4> walls_;
  bool cancels_;
  double added_ = 0;
  Number to_cancel_ = 0;
};

}  // namespace

std::vector<std::uint32_t> exactOwners(const Sites& sites) {
  std::vector<std::uint32_t> order(sites.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto place = [&](std::uint32_t i) { return std::pair(sites.x[i], sites.y[i]); };
  const auto rank = [&](std::uint32_t i) {
    return std::tuple(sites.x[i], sites.y[i], sites.weight.empty() ? 0 : -sites.weight[i], i);
  };
  std::sort(order.begin(), order.end(), [&](auto i, auto j) { return rank(i) < rank(j); });
  std::vector<std::uint32_t> owner(sites.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool again = k > 0 && place(order[k]) == place(order[k - 1]);
    owner[order[k]] = again ? owner[order[k - 1]] : order[k];
  }
  return owner;
}

ExactCells exactCells(const Sites& sites, const Box& domain) {
  Number::set_relative_precision_of_to_double(1e-12);
  ExactCells cells;
  cells.owner = exactOwners(sites);
  const auto neighbors = exactNeighbors(sites, cells.owner);
  cells.triangles = neighbors.triangles;
  cells.hidden = neighbors.hidden;
  cells.area.resize(sites.size());
  cells.offsets.push_back(0);
  for (std::uint32_t i = 0; i < sites.size(); ++i) {
    if (cells.owner[i] == i && cells.hidden[i] == 0) {
      Cell cell(sites, domain, i);
      cell.measure(neighbors.of[i]);
      cells.area[i] = cell.area();
      std::sort(cell.edges.begin(), cell.edges.end(),
                [](const auto& a, const auto& b) { return a.neighbor < b.neighbor; });
      cells.edges.insert(cells.edges.end(), cell.edges.begin(), cell.edges.end());
    }
    cells.offsets.push_back(cells.edges.size());
  }
  return cells;
}

}  // namespace vorpipe::test

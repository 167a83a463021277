#include "support/exact_cells.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace vorpipe::test {
namespace {

// Predicates on doubles need no exact points; figures that follow from them do need exact numbers.
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex>>;
using Number = CGAL::Exact_predicates_exact_constructions_kernel::FT;

std::vector<std::uint32_t> ownersOf(const Sites& sites) {
  std::vector<std::uint32_t> order(sites.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto place = [&](std::uint32_t i) { return std::pair(sites.x[i], sites.y[i]); };
  std::sort(order.begin(), order.end(),
            [&](auto i, auto j) { return place(i) < place(j) || (place(i) == place(j) && i < j); });
  std::vector<std::uint32_t> owner(sites.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool again = k > 0 && place(order[k]) == place(order[k - 1]);
    owner[order[k]] = again ? owner[order[k - 1]] : order[k];
  }
  return owner;
}

/// A Delaunay edge as seen from one of its sites: `to`, and the third sites of the triangles to the left
/// and right of the way there. Without a triangle, the third site is no_site.
struct Spoke {
  std::uint32_t to, left, right;
};

/// The Delaunay neighbors of each site.
struct Neighbors {
  std::vector<std::vector<Spoke>> of;
  std::uint64_t triangles = 0;
};

Neighbors neighborsOf(const Sites& sites, const std::vector<std::uint32_t>& owner) {
  std::vector<std::pair<Kernel::Point_2, std::uint32_t>> points;
  for (std::uint32_t i = 0; i < sites.size(); ++i) {
    if (owner[i] == i) points.emplace_back(Kernel::Point_2(sites.x[i], sites.y[i]), i);
  }
  const Delaunay delaunay(points.begin(), points.end());
  const auto third = [&](const auto& vertex) {
    return delaunay.is_infinite(vertex) ? no_site : vertex->info();
  };
  Neighbors neighbors{std::vector<std::vector<Spoke>>(sites.size()),
                      delaunay.dimension() < 2 ? 0 : delaunay.number_of_faces()};
  for (auto edge = delaunay.finite_edges_begin(); edge != delaunay.finite_edges_end(); ++edge) {
    const auto& [face, opposite] = *edge;
    const auto a = face->vertex(Delaunay::ccw(opposite))->info();
    const auto b = face->vertex(Delaunay::cw(opposite))->info();
    const auto left = delaunay.dimension() < 2 ? no_site : third(face->vertex(opposite));
    const auto right = delaunay.dimension() < 2 ? no_site : third(delaunay.mirror_vertex(face, opposite));
    neighbors.of[a].push_back({b, left, right});
    neighbors.of[b].push_back({a, right, left});
  }
  return neighbors;
}

struct Vector {
  Number x, y;
};

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
  Cell(const Sites& sites, const Box& domain, std::uint32_t site) : sites_(sites), site_(site) {
    const Number x(sites.x[site]);
    const Number y(sites.y[site]);
    walls_ = {Number(domain.xmin) - x, Number(domain.xmax) - x, Number(domain.ymin) - y,
              Number(domain.ymax) - y};
    outside_ = walls_[0] > 0 || walls_[1] < 0 || walls_[2] > 0 || walls_[3] < 0;
  }

  void measure(const std::vector<Spoke>& spokes) {
    bool inside = !spokes.empty();
    for (const auto& spoke : spokes) inside = addEdge(spoke) && inside;
    if (inside) return;
    for (std::size_t wall = 0; wall < 4; ++wall) addWall(wall, spokes);
  }

  [[nodiscard]] double area() const { return added_ + CGAL::to_double(to_cancel_); }
  std::vector<ExactEdge> edges;

 private:
  [[nodiscard]] Vector to(std::uint32_t other) const {
    return {Number(sites_.x[other]) - Number(sites_.x[site_]),
            Number(sites_.y[other]) - Number(sites_.y[site_])};
  }

  /// Adds the triangle between the site and an edge. Triangles of a site outside of the domain cancel
  /// each other, and only exact numbers stand that; the others need not grow with their number.
  void addArea(const Number& triangle) {
    if (outside_) {
      to_cancel_ += triangle;
    } else {
      added_ += CGAL::to_double(triangle);
    }
  }

  /// Where on the bisector, in distances of the two sites from the point halfway between them and to
  /// the left, is the center of the circle through both and a third one.
  [[nodiscard]] Number center(const Vector& d, std::uint32_t third) const {
    const auto e = to(third);
    return (e.x * (e.x - d.x) + e.y * (e.y - d.y)) / (2 * (d.x * e.y - d.y * e.x));
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
  bool addEdge(const Spoke& spoke) {
    const auto d = to(spoke.to);
    Interval part;
    if (spoke.left != no_site) part.high = center(d, spoke.left);
    if (spoke.right != no_site) part.low = center(d, spoke.right);
    if (!clip(part, d.x / 2, -d.y, walls_[0], walls_[1]) || !clip(part, d.y / 2, d.x, walls_[2], walls_[3]))
      return false;
    if (*part.low < *part.high) {
      const Number length = *part.high - *part.low;
      addArea(length * (d.x * d.x + d.y * d.y) / 4);
      const double in_distances = CGAL::to_double(length);
      const double distance = std::hypot(CGAL::to_double(d.x), CGAL::to_double(d.y));
      edges.push_back({spoke.to, in_distances * distance, in_distances});
    }
    return !part.tightened;
  }

  /// Adds what the cell has of a wall: the wall cut by all bisectors.
  void addWall(std::size_t wall, const std::vector<Spoke>& spokes) {
    const bool upright = wall < 2;
    const bool greater = wall % 2 == 1;
    const Number& place = walls_[wall];
    Interval part{walls_[upright ? 2 : 0], walls_[upright ? 3 : 1]};
    for (const auto& spoke : spokes) {
      const auto d = to(spoke.to);
      const Number& across = upright ? d.x : d.y;
      const Number& along = upright ? d.y : d.x;
      const Number room = (d.x * d.x + d.y * d.y) / 2 - place * across;
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

  const Sites& sites_;
  std::uint32_t site_;
  std::array<Number, 4> walls_;
  bool outside_;
  double added_ = 0;
  Number to_cancel_ = 0;
};

}  // namespace

ExactCells exactCells(const Sites& sites, const Box& domain) {
  Number::set_relative_precision_of_to_double(1e-12);
  ExactCells cells;
  cells.owner = ownersOf(sites);
  const auto neighbors = neighborsOf(sites, cells.owner);
  cells.triangles = neighbors.triangles;
  cells.area.resize(sites.size());
  cells.first.push_back(0);
  for (std::uint32_t i = 0; i < sites.size(); ++i) {
    if (cells.owner[i] == i) {
      Cell cell(sites, domain, i);
      cell.measure(neighbors.of[i]);
      cells.area[i] = cell.area();
      std::sort(cell.edges.begin(), cell.edges.end(),
                [](const auto& a, const auto& b) { return a.neighbor < b.neighbor; });
      cells.edges.insert(cells.edges.end(), cell.edges.begin(), cell.edges.end());
    }
    cells.first.push_back(cells.edges.size());
  }
  return cells;
}

}  // namespace vorpipe::test

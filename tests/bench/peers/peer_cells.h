/// The full job's result: the cells of all sites, clipped to the domain, with areas, centroids and neighbors.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bench/input.h"

namespace vorpipe::test {

/// Filled in the order in which a peer has its cells, in the units of BenchInput::sites. Neighbors are the
/// indices of sites, or walls, as Diagram has them.
class PeerCells {
 public:
  /// Has room for all; no site has a cell yet. Refers to the input.
  explicit PeerCells(const BenchInput& input);

  /// Takes the polygon of a site, in either direction; edge k, from vertex k to the next one, belongs to
  /// neighbors[k].
  void add(std::uint32_t site, std::span<const Point> vertices, std::span<const std::int32_t> neighbors);

  /// Takes what is left of the domain when the bisectors with these sites have cut it, perhaps nothing: the
  /// way to add a cell that may reach beyond the domain.
  void addCut(std::uint32_t site, std::span<const std::int32_t> neighbors);

  /// Takes a cell that the peer measured; its neighbors follow, each with the square of its edge's length.
  void begin(std::uint32_t site, double area, Point centroid);
  void addNeighbor(std::uint32_t site, std::int32_t neighbor, double square);

  /// Says by how much the areas' sum is not the domain's, if it is not.
  [[nodiscard]] std::string areaDisagreement() const;
  /// The same, and in how many cells the status, the neighbors or the area are not those of the reference,
  /// whose owners are taken for granted.
  [[nodiscard]] std::string disagreement(const Diagram& reference) const;

 private:
  struct Room {
    std::vector<Point> vertices, vertices_before;
    std::vector<std::int32_t> neighbors, neighbors_before;
  };
  void cutBy(Point site, double weight, std::int32_t neighbor);

  const BenchInput* input_;
  double tie_square_;  ///< no edge longer than this is a tie
  std::vector<double> area_;
  std::vector<Point> centroid_;
  std::vector<std::uint32_t> first_, count_;
  std::vector<std::int32_t> neighbors_;
  Room room_;  ///< for one cell, kept
};

/// Whether no coordinate lies beyond the box.
inline bool contains(const Box& box, Point p) {
  return p.x >= box.xmin && p.x <= box.xmax && p.y >= box.ymin && p.y <= box.ymax;
}

}  // namespace vorpipe::test

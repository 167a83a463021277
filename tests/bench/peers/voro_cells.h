/// What both versions of Voro++ say of a cell.
#pragma once

#include <cmath>
#include <numeric>

#include "bench/peers/space_peer.h"

namespace vorpipe::test {

constexpr int room_in_voro_block = 8;

/// As many in each direction as its documentation finds best, with so many sites in a block.
inline int voroBlocks(const SpaceInput& input, double sites_in_block) {
  return static_cast<int>(std::cbrt(static_cast<double>(input.sites.size()) / sites_in_block)) + 1;
}

/// Takes cells of one thread.
template <class Cell>
class VoroCells {
 public:
  /// With room for about as many as will come.
  VoroCells(CellsInOrder& cells, std::size_t count, Detail3 detail) : cells_(cells), detail_(detail) {
    cells_.site.reserve(count);
    cells_.volume.reserve(count);
    cells_.surface.reserve(count);
    cells_.centroid.reserve(count);
    cells_.faces_end.reserve(count);
    cells_.neighbors.reserve(usual_faces * count);
    cells_.face_areas.reserve(usual_faces * count);
    if (detail_ == Detail3::measures) return;
    cells_.vertices.reserve(3 * usual_vertices * count);
    cells_.face_vertices.reserve((3 * usual_vertices + usual_faces) * count);
  }

  void add(Cell& cell, int site, Point3 place) {
    Point3 centroid{};
    cell.centroid(centroid.x, centroid.y, centroid.z);
    cell.neighbors(neighbors_);
    cell.face_areas(areas_);
    cells_.site.push_back(site);
    cells_.volume.push_back(cell.volume());
    cells_.surface.push_back(std::accumulate(areas_.begin(), areas_.end(), 0.0));
    cells_.centroid.push_back({place.x + centroid.x, place.y + centroid.y, place.z + centroid.z});
    append(cells_.neighbors, neighbors_);
    append(cells_.face_areas, areas_);
    cells_.faces_end.push_back(cells_.neighbors.size());
    if (detail_ == Detail3::measures) return;
    cell.vertices(place.x, place.y, place.z, vertices_);
    cell.face_vertices(face_vertices_);
    append(cells_.vertices, vertices_);
    append(cells_.face_vertices, face_vertices_);
  }

 private:
  static constexpr std::size_t usual_faces = 17, usual_vertices = 30;

  template <class Number>
  static void append(std::vector<Number>& to, const std::vector<Number>& more) {
    to.insert(to.end(), more.begin(), more.end());
  }

  CellsInOrder& cells_;
  Detail3 detail_;
  std::vector<int> neighbors_, face_vertices_;
  std::vector<double> areas_, vertices_;
};

}  // namespace vorpipe::test

/// What must hold of cells that agree.
#pragma once

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>

#include "unit/fixtures/proposed_cells.h"

namespace vorpipe::test {

using Neighbors = std::vector<std::int64_t>;

inline Neighbors neighborsOf(const Diagram& d, std::size_t i) {
  return {d.neighbors.begin() + static_cast<std::ptrdiff_t>(d.cell_offsets[i]),
          d.neighbors.begin() + static_cast<std::ptrdiff_t>(d.cell_offsets[i + 1])};
}

inline Neighbors fromLowest(Neighbors row) {
  std::rotate(row.begin(), std::min_element(row.begin(), row.end()), row.end());
  return row;
}

inline double sumOfAreas(const Diagram& d) { return std::accumulate(d.area.begin(), d.area.end(), 0.0); }

/// Says how a diagram breaks what must hold of any; empty if it does not.
inline std::string broken(const Diagram& d) {
  std::map<std::pair<std::int64_t, std::int64_t>, std::size_t> half_edges;
  std::set<std::pair<double, double>> vertices;
  std::size_t faces = 1, edges = 0;
  for (std::size_t i = 0; i + 1 < d.cell_offsets.size(); ++i) {
    faces += d.status[i] == Status::ok ? 1u : 0u;
    for (auto e = d.cell_offsets[i]; e < d.cell_offsets[i + 1]; ++e) {
      vertices.insert({d.vertices[e].x, d.vertices[e].y});
      const bool once = half_edges.insert({{static_cast<std::int64_t>(i), d.neighbors[e]}, e}).second;
      if (!once) return "a cell has a neighbor twice";
      edges += d.neighbors[e] < 0 ? 2u : 1u;
    }
  }
  const auto end = [&](std::size_t cell, std::size_t e) {
    return d.vertices[e + 1 < d.cell_offsets[cell + 1] ? e + 1 : d.cell_offsets[cell]];
  };
  for (const auto& [cells, e] : half_edges) {
    if (cells.second < 0) continue;
    const auto back = half_edges.find({cells.second, cells.first});
    if (back == half_edges.end()) return "neighbors are not mutual";
    const auto there = end(static_cast<std::size_t>(cells.second), back->second);
    if (there.x != d.vertices[e].x || there.y != d.vertices[e].y) return "a vertex differs between cells";
    if (d.edge_lengths[e] != d.edge_lengths[back->second]) return "a length differs between cells";
  }
  if (std::abs(sumOfAreas(d) - 1) > 1e-12) return "the areas do not add up";
  // V + F = E + 2, edges counted twice.
  return 2 * vertices.size() + 2 * faces == edges + 4 ? "" : "Euler's relation does not hold";
}

/// Southwest, southeast, northeast, northwest.
inline SiteSet quarterSites() { return sitesAt({0.25, 0.75, 0.75, 0.25}, {0.25, 0.25, 0.75, 0.75}); }

inline const Rows quarters{{wall_ymin, 1, 3, wall_xmin},
                           {wall_ymin, wall_xmax, 2, 0},
                           {1, wall_xmax, wall_ymax, 3},
                           {0, 2, wall_ymax, wall_xmin}};

}  // namespace vorpipe::test

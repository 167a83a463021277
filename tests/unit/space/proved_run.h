/// Diagrams of sites whose cells are computed by integers, as a run hands its cells over.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "space/certified_cells.h"
#include "support/exact3.h"

namespace vorpipe::test {

inline constexpr Box3 unit_box{0, 0, 0, 1, 1, 1};

struct ProvedRunOptions {
  Detail3 detail = Detail3::polyhedra;
  int threads = 1;
  unsigned order = 0;     ///< seed of the run's order; 0: the input's
  double unit = 1;        ///< of the run's coordinates
  bool measured = false;  ///< whether the run hands over the measures of its cells: made up ones
};

struct Diagrammed {
  Diagram3 diagram;
  space::TieCounts ties;
};

inline Diagrammed diagramOf(const std::vector<Point3>& sites, const Box3& box,
                            const ProvedRunOptions& options = {}) {
  std::vector<std::uint32_t> owner(sites.size()), input;
  std::vector<Status> status(sites.size(), Status::ok);
  for (std::uint32_t i = 0; i < sites.size(); ++i) {
    owner[i] = static_cast<std::uint32_t>(std::ranges::find(sites, sites[i]) - sites.begin());
    if (owner[i] == i) input.push_back(i);
    if (owner[i] != i) status[i] = Status::duplicate;
  }
  if (options.order != 0) std::shuffle(input.begin(), input.end(), std::mt19937(options.order));
  std::vector<Point3> placed;
  for (const auto i : input)
    placed.push_back({sites[i].x / options.unit, sites[i].y / options.unit, sites[i].z / options.unit});
  const Box3 run_box{box.xmin / options.unit, box.ymin / options.unit, box.zmin / options.unit,
                     box.xmax / options.unit, box.ymax / options.unit, box.zmax / options.unit};
  const auto label_rows = rowsOf(ExactSpace(placed, run_box));
  StoredRows stored(label_rows, input);
  std::vector<std::uint32_t> all(placed.size());
  std::iota(all.begin(), all.end(), 0U);
  Diagrammed result;
  const space::Places places{placed.data(), run_box};
  space::Records records(places, options.unit, input, sites, options.detail, options.threads, result.diagram);
  records.layOut(stored.rows(), options.threads);
  for (std::size_t r = 0; r < placed.size(); ++r) {
    if (label_rows[r].empty()) status[input[r]] = Status::empty;
    if (!options.measured) continue;
    records.write(r, {static_cast<double>(input[r]), 2, {0.5, 0.25, 0.125}}, {});
    for (std::size_t f = 0; f < label_rows[r].size(); ++f)
      records.writeArea(r, f, static_cast<double>(input[r]) + 0.5);
  }
  const std::vector<std::uint32_t> unmeasured = options.measured ? std::vector<std::uint32_t>{} : all;
  const space::ProvedCells cells{places,     options.unit, stored.rows(), input, all,
                                 unmeasured, sites,        status,        owner};
  const auto ties = space::writeDiagram(cells, records, options.detail, options.threads, result.diagram);
  EXPECT_TRUE(ties.has_value());
  if (ties) result.ties = *ties;
  return result;
}

inline std::span<const std::uint32_t> ringOf(const Diagram3& diagram, std::uint64_t face) {
  const auto begin = diagram.face_vertex_offsets[face], end = diagram.face_vertex_offsets[face + 1];
  return std::span(diagram.face_vertices).subspan(begin, end - begin);
}

inline std::vector<std::int64_t> neighborsOf(const Diagram3& diagram, std::size_t cell) {
  return {diagram.neighbors.begin() + static_cast<std::ptrdiff_t>(diagram.face_offsets[cell]),
          diagram.neighbors.begin() + static_cast<std::ptrdiff_t>(diagram.face_offsets[cell + 1])};
}

/// Expects what is promised of the polyhedra of every diagram: both cells of a face have its ring, in
/// opposite directions; no ring visits a vertex twice; surfaces are closed; cells with four faces or more
/// fulfil Euler's formula; the sites of a vertex are those whose cells have it.
inline void expectWhole(const Diagram3& d) {
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<std::uint32_t>> rings;
  std::vector<std::set<std::int64_t>> around(d.vertices.size());
  for (std::size_t i = 0; i < d.size(); ++i) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    std::set<std::uint32_t> vertices;
    for (auto f = d.face_offsets[i]; f < d.face_offsets[i + 1]; ++f) {
      if (f > d.face_offsets[i]) {
        EXPECT_LT(d.neighbors[f - 1], d.neighbors[f]) << "cell " << i;
      }
      const auto ring = ringOf(d, f);
      EXPECT_GE(ring.size(), 3U);
      EXPECT_EQ(std::set(ring.begin(), ring.end()).size(), ring.size()) << "cell " << i;
      rings[{static_cast<std::int64_t>(i), d.neighbors[f]}].assign(ring.begin(), ring.end());
      for (std::size_t k = 0; k < ring.size(); ++k) {
        ++edges[{ring[k], ring[(k + 1) % ring.size()]}];
        vertices.insert(ring[k]);
        around[ring[k]].insert(static_cast<std::int64_t>(i));
        if (isWall(d.neighbors[f])) around[ring[k]].insert(d.neighbors[f]);
      }
    }
    for (const auto& [edge, count] : edges) {
      EXPECT_EQ(count, (edges[{edge.second, edge.first}])) << "cell " << i << " is open";
    }
    const auto faces = static_cast<std::size_t>(d.face_offsets[i + 1] - d.face_offsets[i]);
    if (faces >= 4) {
      EXPECT_EQ(vertices.size() + faces, edges.size() / 2 + 2) << "cell " << i;
    }
  }
  for (const auto& [pair, ring] : rings) {
    if (isWall(pair.second)) continue;
    const auto found = rings.find({pair.second, pair.first});
    ASSERT_NE(found, rings.end()) << pair.first << " and " << pair.second;
    auto reverse = found->second;
    std::ranges::reverse(reverse);
    std::ranges::rotate(reverse, std::ranges::find(reverse, ring[0]));
    EXPECT_EQ(reverse, ring) << pair.first << " and " << pair.second;
  }
  for (std::size_t v = 0; v < d.vertices.size(); ++v) {
    const std::vector<std::int64_t> sites(
        d.vertex_sites.begin() + static_cast<std::ptrdiff_t>(d.vertex_site_offsets[v]),
        d.vertex_sites.begin() + static_cast<std::ptrdiff_t>(d.vertex_site_offsets[v + 1]));
    EXPECT_EQ(sites, std::vector(around[v].begin(), around[v].end())) << "vertex " << v;
    EXPECT_GE(sites.size(), 3U);
  }
}

}  // namespace vorpipe::test

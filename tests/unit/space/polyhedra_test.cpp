// Diagrams in space: lattices by closed forms, numbers and order, and what is thin or outside.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "unit/space/proved_run.h"

namespace vorpipe::test {
namespace {

std::vector<Point3> uniformSites(std::size_t count, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> inside(0, 1);
  std::vector<Point3> sites(count);
  for (auto& p : sites) p = {inside(random), inside(random), inside(random)};
  return sites;
}

/// A lattice with sites `basis` in each cell of the edges `edge`.
struct Lattice {
  const char* name;
  std::array<Point3, 3> edge;
  std::vector<Point3> basis;
  std::size_t of;  ///< the basis' site whose cell is known
  std::size_t faces, vertices;
  double volume, surface;
  double moment;                                    ///< per dimension, by volume^(5/3); 0: not known
  std::vector<std::size_t> squares_and_so_on = {};  ///< how many faces have 3, 4, 5, 6 edges

  [[nodiscard]] Point3 at(double a, double b, double c) const {
    return {a * edge[0].x + b * edge[1].x + c * edge[2].x, a * edge[0].y + b * edge[1].y + c * edge[2].y,
            a * edge[0].z + b * edge[1].z + c * edge[2].z};
  }
};

constexpr std::array<Point3, 3> cubic_edges{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

std::vector<Lattice> lattices() {
  const double root2 = std::numbers::sqrt2, root3 = std::numbers::sqrt3;
  const std::vector<Point3> fcc{{0, 0, 0}, {.5, .5, 0}, {.5, 0, .5}, {0, .5, .5}};
  std::vector<Point3> diamond = fcc;
  for (const auto& p : fcc) diamond.push_back({p.x + .25, p.y + .25, p.z + .25});
  const std::vector<Point3> a15{{0, 0, 0},    {.5, .5, .5}, {.25, 0, .5}, {.75, 0, .5},
                                {.5, .25, 0}, {.5, .75, 0}, {0, .5, .25}, {0, .5, .75}};
  const std::array<Point3, 3> hexagonal{{{1, 0, 0}, {.5, root3 / 2, 0}, {0, 0, 1}}};
  const std::array<Point3, 3> close_packed{{{1, 0, 0}, {.5, root3 / 2, 0}, {0, 0, std::sqrt(8. / 3)}}};
  // The hexagons have sides 1 / sqrt(3).
  const double hexagon = root3 / 2, around = 2 * root3;
  return {
      {"cubic", cubic_edges, {{0, 0, 0}}, 0, 6, 8, 1, 6, 1. / 12, {0, 6}},
      {"fcc", cubic_edges, fcc, 0, 12, 14, .25, 3 / root2, std::pow(2., -11. / 3), {0, 12}},
      {"hcp",
       close_packed,
       {{0, 0, 0}, {1. / 3, 1. / 3, .5}},
       0,
       12,
       14,
       1 / root2,
       3 * root2,
       std::pow(2., -11. / 3),
       {0, 12}},
      {"bcc",
       cubic_edges,
       {{0, 0, 0}, {.5, .5, .5}},
       0,
       14,
       24,
       .5,
       (6 + 12 * root3) / 8,
       19 / (192 * std::cbrt(2.)),
       {0, 6, 0, 8}},
      {"diamond", cubic_edges, diamond, 0, 16, 16, .125, 0, 0, {12, 0, 0, 4}},
      {"a15, of 12", cubic_edges, a15, 0, 12, 20, 0, 0, 0, {0, 0, 12}},
      {"a15, of 14", cubic_edges, a15, 2, 14, 24, 0, 0, 0, {0, 0, 12, 2}},
      {"hexagonal", hexagonal, {{0, 0, 0}}, 0, 8, 12, hexagon, 2 * hexagon + around, 0, {0, 6, 0, 2}},
  };
}

/// The sites of a lattice next to one, that first, each moved by less than `noise`.
std::vector<Point3> around(const Lattice& lattice, std::size_t count, double noise, unsigned seed) {
  const Point3 own = lattice.basis[lattice.of];
  const Point3 center = lattice.at(own.x, own.y, own.z);
  std::vector<Point3> sites;
  for (int a = -4; a <= 4; ++a) {
    for (int b = -4; b <= 4; ++b) {
      for (int c = -4; c <= 4; ++c) {
        for (const auto& p : lattice.basis) {
          const Point3 at = lattice.at(a + p.x, b + p.y, c + p.z);
          sites.push_back({at.x - center.x, at.y - center.y, at.z - center.z});
        }
      }
    }
  }
  const auto far = [](const Point3& p) { return p.x * p.x + p.y * p.y + p.z * p.z; };
  std::ranges::stable_sort(sites, {}, far);
  sites.resize(count);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> moved(-noise, noise);
  for (auto& p : sites) p = {p.x + 10 + moved(random), p.y + 10 + moved(random), p.z + 10 + moved(random)};
  return sites;
}

TEST(Polyhedra, ofLatticesHaveTheirFacesWhateverTheNoise) {
  constexpr Box3 box{5, 5, 5, 15, 15, 15};
  for (const auto& lattice : lattices()) {
    for (const double noise : {0., 1e-15, 1e-12, 1e-9}) {
      SCOPED_TRACE(std::string(lattice.name) + " with noise " + std::to_string(std::log10(noise)));
      const auto [d, ties] = diagramOf(around(lattice, 70, noise, 7), box);
      expectWhole(d);
      EXPECT_EQ(d.face_offsets[1], lattice.faces);
      std::set<std::uint32_t> vertices;
      std::vector<std::size_t> by_edges(4, 0);
      for (std::uint64_t f = 0; f < d.face_offsets[1]; ++f) {
        const auto ring = ringOf(d, f);
        vertices.insert(ring.begin(), ring.end());
        ASSERT_LE(ring.size(), 6U);
        ++by_edges[ring.size() - 3];
      }
      EXPECT_EQ(vertices.size(), lattice.vertices);
      auto expected = lattice.squares_and_so_on;
      expected.resize(4, 0);
      EXPECT_EQ(by_edges, expected);
      const double close = 1e-12 + 20 * noise;
      if (lattice.volume > 0) {
        EXPECT_NEAR(d.volume[0] / lattice.volume, 1, close);
      }
      if (lattice.surface > 0) {
        EXPECT_NEAR(d.surface[0] / lattice.surface, 1, close);
      }
      if (lattice.moment > 0) {
        const auto& m = d.second_moments[0];
        const double all = (m[0] + m[1] + m[2]) / 3 / std::pow(d.volume[0], 5. / 3);
        EXPECT_NEAR(all / lattice.moment, 1, close);
      }
      for (const double x : {d.centroid[0].x, d.centroid[0].y, d.centroid[0].z}) {
        if (lattice.volume > 0 && std::string_view(lattice.name) != "diamond") {
          EXPECT_NEAR(x, 10, close);
        }
      }
      double volume = 0;
      for (const double v : d.volume) volume += v;
      EXPECT_NEAR(volume / 1000, 1, 1e-12);
    }
  }
}

TEST(Polyhedra, areNumberedByTheInputAlone) {
  auto sites = uniformSites(40, 3);
  sites.push_back(sites[5]);
  sites.push_back({3, 3, 3});
  for (int k = 0; k < 27; ++k)
    sites.push_back({.25 + .25 * (k % 3), .25 + .25 * (k / 3 % 3), .25 + .25 * (k / 9)});
  const auto first = diagramOf(sites, unit_box).diagram;
  expectWhole(first);
  EXPECT_EQ(first.status[40], Status::duplicate);
  EXPECT_EQ(first.owner[40], 5U);
  EXPECT_EQ(first.status[41], Status::empty);
  EXPECT_EQ(first.volume[41], 0);
  EXPECT_EQ(first.centroid[41], sites[41]);
  EXPECT_EQ(first.face_offsets[41], first.face_offsets[42]);
  std::uint32_t next = 0;
  for (const auto v : first.face_vertices) {
    EXPECT_LE(v, next) << "vertices are numbered as the faces name them";
    next = std::max(next, v + 1);
  }
  EXPECT_EQ(next, first.vertices.size());
  for (const unsigned order : {0U, 1U, 2U}) {
    for (const int threads : {1, 3}) {
      const auto other = diagramOf(sites, unit_box, {.threads = threads, .order = order}).diagram;
      EXPECT_EQ(other.face_offsets, first.face_offsets);
      EXPECT_EQ(other.neighbors, first.neighbors);
      EXPECT_EQ(other.face_vertex_offsets, first.face_vertex_offsets);
      EXPECT_EQ(other.face_vertices, first.face_vertices);
      EXPECT_EQ(other.vertex_site_offsets, first.vertex_site_offsets);
      EXPECT_EQ(other.vertex_sites, first.vertex_sites);
      for (std::size_t v = 0; v < first.vertices.size(); ++v) {
        EXPECT_NEAR(other.vertices[v].x, first.vertices[v].x, 4e-16);
        EXPECT_NEAR(other.vertices[v].y, first.vertices[v].y, 4e-16);
        EXPECT_NEAR(other.vertices[v].z, first.vertices[v].z, 4e-16);
      }
      if (order != 0) continue;
      EXPECT_EQ(other.vertices, first.vertices);
      EXPECT_EQ(other.volume, first.volume);
      EXPECT_EQ(other.second_moments, first.second_moments);
    }
  }
  // Where the least order is asked, the cells are the same.
  const auto measures = diagramOf(sites, unit_box, {.detail = Detail3::measures, .order = 1}).diagram;
  EXPECT_EQ(measures.face_offsets, first.face_offsets);
  EXPECT_EQ(measures.neighbors, first.neighbors);
  EXPECT_TRUE(measures.vertices.empty() && measures.second_moments.empty());
}

TEST(Polyhedra, haveVerticesAtEqualDistanceFromTheirSitesAndOnTheirWalls) {
  auto sites = uniformSites(30, 4);
  for (int k = 0; k < 27; ++k)
    sites.push_back({.25 + .25 * (k % 3), .25 + .25 * (k / 3 % 3), .25 + .25 * (k / 9)});
  const auto d = diagramOf(sites, unit_box).diagram;
  std::size_t corners = 0;
  for (std::size_t v = 0; v < d.vertices.size(); ++v) {
    const Point3 p = d.vertices[v];
    double distance = -1;
    int walls = 0;
    for (auto s = d.vertex_site_offsets[v]; s < d.vertex_site_offsets[v + 1]; ++s) {
      const auto at = d.vertex_sites[s];
      walls += isWall(at);
      if (at == wall_xmin) {
        EXPECT_EQ(p.x, 0);
      }
      if (at == wall_xmax) {
        EXPECT_EQ(p.x, 1);
      }
      if (at == wall_ymin) {
        EXPECT_EQ(p.y, 0);
      }
      if (at == wall_ymax) {
        EXPECT_EQ(p.y, 1);
      }
      if (at == wall_zmin) {
        EXPECT_EQ(p.z, 0);
      }
      if (at == wall_zmax) {
        EXPECT_EQ(p.z, 1);
      }
      if (isWall(at)) continue;
      const Point3& site = sites[static_cast<std::size_t>(at)];
      const double to = std::hypot(p.x - site.x, p.y - site.y, p.z - site.z);
      if (distance >= 0) {
        EXPECT_NEAR(to, distance, 1e-14);
      }
      distance = to;
    }
    corners += walls == 3;
    for (const auto& site : sites) {
      EXPECT_GE(std::hypot(p.x - site.x, p.y - site.y, p.z - site.z), distance - 1e-14);
    }
  }
  EXPECT_EQ(corners, 8U);
}

TEST(Polyhedra, areInTheCallersUnits) {
  const auto sites = uniformSites(20, 5);
  const double unit = 0x1p-20;
  std::vector<Point3> small;
  for (const auto& p : sites) small.push_back({p.x * unit, p.y * unit, p.z * unit});
  const auto a = diagramOf(sites, unit_box).diagram;
  const auto b = diagramOf(small, {0, 0, 0, unit, unit, unit}, {.unit = unit}).diagram;
  EXPECT_EQ(a.neighbors, b.neighbors);
  EXPECT_EQ(a.face_vertices, b.face_vertices);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    EXPECT_EQ(a.volume[i] * unit * unit * unit, b.volume[i]);
    EXPECT_EQ(a.surface[i] * unit * unit, b.surface[i]);
    EXPECT_EQ(a.centroid[i].z * unit, b.centroid[i].z);
    EXPECT_EQ(a.second_moments[i][3] * std::pow(unit, 5), b.second_moments[i][3]);
  }
  for (std::size_t f = 0; f < a.face_areas.size(); ++f)
    EXPECT_EQ(a.face_areas[f] * unit * unit, b.face_areas[f]);
  for (std::size_t v = 0; v < a.vertices.size(); ++v) EXPECT_EQ(a.vertices[v].y * unit, b.vertices[v].y);
}

TEST(Polyhedra, takeMeasuresThatAreThere) {
  const auto sites = uniformSites(20, 6);
  for (const auto detail : {Detail3::measures, Detail3::polyhedra}) {
    const auto d = diagramOf(sites, unit_box, {.detail = detail, .order = 9, .measured = true}).diagram;
    for (std::size_t i = 0; i < sites.size(); ++i) {
      EXPECT_EQ(d.volume[i], static_cast<double>(i));
      EXPECT_EQ(d.surface[i], 2);
      EXPECT_EQ(d.centroid[i].y, sites[i].y + 0.25);
      for (auto f = d.face_offsets[i]; f < d.face_offsets[i + 1]; ++f)
        EXPECT_EQ(d.face_areas[f], static_cast<double>(i) + 0.5);
    }
  }
}

TEST(Polyhedra, ofASlabThinnerThanATieAreFlat) {
  const std::vector<Point3> sites{{.5, .5, .5}, {.5, .5, 1.5 - 1e-8}};
  const auto [d, ties] = diagramOf(sites, unit_box);
  expectWhole(d);
  EXPECT_EQ(d.flat, 1U);
  EXPECT_EQ(d.status[1], Status::ok);
  EXPECT_NEAR(d.volume[1], 0.5e-8, 1e-15);
  EXPECT_EQ(neighborsOf(d, 1), (std::vector<std::int64_t>{wall_zmax, 0}));
  EXPECT_EQ(neighborsOf(d, 0),
            (std::vector<std::int64_t>{wall_zmin, wall_ymax, wall_ymin, wall_xmax, wall_xmin, 1}));
  EXPECT_EQ(d.vertices.size(), 8U);
}

TEST(Polyhedra, ofACellSmallerThanATieAreNone) {
  // The other site's cell is a corner of the box, of edges of 3e-8.
  const double far = 1.5 - 2e-8;
  const std::vector<Point3> sites{{.5, .5, .5}, {far, far, far}};
  for (const auto detail : {Detail3::measures, Detail3::polyhedra}) {
    const auto [d, ties] = diagramOf(sites, unit_box, {.detail = detail});
    EXPECT_EQ(ties.gone, 1U);
    EXPECT_EQ(d.status[1], Status::empty);
    EXPECT_EQ(d.volume[1], 0);
    EXPECT_EQ(d.centroid[1], sites[1]);
    EXPECT_TRUE(neighborsOf(d, 1).empty());
    EXPECT_EQ(neighborsOf(d, 0).size(), 6U);
    if (detail == Detail3::measures) continue;
    expectWhole(d);
    EXPECT_EQ(d.vertices.size(), 8U);
    EXPECT_NE(std::ranges::find(d.vertices, Point3{1, 1, 1}), d.vertices.end());
  }
}

TEST(Polyhedra, mayHaveHundredsOfFaces) {
  std::mt19937_64 random(8);
  std::normal_distribution<double> normal;
  std::vector<Point3> sites{{.5, .5, .5}};
  for (int k = 0; k < 140; ++k) {
    const Point3 q{normal(random), normal(random), normal(random)};
    const double part = .3 / std::hypot(q.x, q.y, q.z);
    sites.push_back({.5 + part * q.x, .5 + part * q.y, .5 + part * q.z});
  }
  const auto [d, ties] = diagramOf(sites, unit_box, {.threads = 2, .order = 3});
  expectWhole(d);
  EXPECT_EQ(d.face_offsets[1], 140U);
  double volume = 0;
  for (const double v : d.volume) volume += v;
  EXPECT_NEAR(volume, 1, 1e-13);
}

}  // namespace
}  // namespace vorpipe::test

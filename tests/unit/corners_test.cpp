#include "core/corners.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "core/dual.h"

namespace vorpipe::test {
namespace {

SiteSet sitesAt(std::vector<double> x, std::vector<double> y) {
  SiteSet set{std::move(x), std::move(y), {}, {0, 0, 1, 1}};
  set.id.resize(set.x.size());
  std::iota(set.id.begin(), set.id.end(), 0u);
  return set;
}

Topology topologyOf(const std::vector<std::vector<std::int64_t>>& cells) {
  Topology topology;
  for (const auto& cell : cells) {
    topology.status.push_back(cell.empty() ? CellStatus::empty : CellStatus::certified);
    topology.neighbor.insert(topology.neighbor.end(), cell.begin(), cell.end());
    topology.first.push_back(topology.neighbor.size());
  }
  return topology;
}

void expectPoint(Point p, double x, double y) {
  EXPECT_EQ(p.x, x);
  EXPECT_EQ(p.y, y);
}

TEST(Corners, ofTwoSitesLieOnTheWalls) {
  const auto sites = sitesAt({0.25, 0.75}, {0.5, 0.5});
  const auto topology =
      topologyOf({{wall_ymin, 1, wall_ymax, wall_xmin}, {wall_ymin, wall_xmax, wall_ymax, 0}});
  const auto agreement = agreeOnCorners(sites, topology, 1);
  EXPECT_TRUE(agreement.disputed.empty());
  const auto& corners = agreement.corners;
  expectPoint(corners.position[0], 0, 0);
  expectPoint(corners.position[1], 0.5, 0);
  expectPoint(corners.position[2], 0.5, 1);
  expectPoint(corners.position[3], 0, 1);
  EXPECT_EQ(corners.root[1], corners.root[4]);
  EXPECT_EQ(corners.root[2], corners.root[7]);
  EXPECT_NE(corners.root[1], corners.root[2]);
  EXPECT_EQ(corners.next[3], 0u);
  EXPECT_TRUE(dualTriangles(sites, topology, corners).empty());
}

/// Southwest, southeast, northeast, northwest; `diagonal`: the first and the third believe to be
/// neighbors.
Topology fourQuarters(bool diagonal) {
  if (!diagonal) {
    return topologyOf({{wall_ymin, 1, 3, wall_xmin},
                       {wall_ymin, wall_xmax, 2, 0},
                       {1, wall_xmax, wall_ymax, 3},
                       {0, 2, wall_ymax, wall_xmin}});
  }
  return topologyOf({{wall_ymin, 1, 2, 3, wall_xmin},
                     {wall_ymin, wall_xmax, 2, 0},
                     {1, wall_xmax, wall_ymax, 3, 0},
                     {0, 2, wall_ymax, wall_xmin}});
}

const SiteSet& quarterSites() {
  static const auto sites = sitesAt({0.25, 0.75, 0.75, 0.25}, {0.25, 0.25, 0.75, 0.75});
  return sites;
}

TEST(Corners, whereFourCellsMeetAreOneVertex) {
  const auto topology = fourQuarters(false);
  const auto agreement = agreeOnCorners(quarterSites(), topology, 1);
  EXPECT_TRUE(agreement.disputed.empty());
  const auto root = agreement.corners.root[2];
  for (const std::size_t e : {2u, 7u, 8u, 13u}) {
    EXPECT_EQ(agreement.corners.root[e], root) << e;
    expectPoint(agreement.corners.position[e], 0.5, 0.5);
  }
  const auto triangles = dualTriangles(quarterSites(), topology, agreement.corners);
  EXPECT_EQ(triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Corners, ofAnEdgeWithoutLengthAreOneVertexAndTheEdgeIsATie) {
  const auto topology = fourQuarters(true);
  const auto agreement = agreeOnCorners(quarterSites(), topology, 1);
  EXPECT_TRUE(agreement.disputed.empty());
  int ties = 0;
  for (std::size_t e = 0; e < topology.neighbor.size(); ++e) ties += agreement.corners.tie[e] ? 1 : 0;
  EXPECT_EQ(ties, 2);
  EXPECT_TRUE(agreement.corners.tie[2]);
  EXPECT_EQ(agreement.corners.root[2], agreement.corners.root[3]);
  EXPECT_EQ(dualTriangles(quarterSites(), topology, agreement.corners).size(), 2u);
}

TEST(Corners, areDisputedByCellsThatDoNotKnowEachOther) {
  const auto sites = sitesAt({0.25, 0.75}, {0.5, 0.5});
  const auto topology =
      topologyOf({{wall_ymin, 1, wall_ymax, wall_xmin}, {wall_ymin, wall_xmax, wall_ymax, wall_xmin}});
  EXPECT_EQ(agreeOnCorners(sites, topology, 1).disputed, (std::vector<std::uint32_t>{0, 1}));
}

TEST(Corners, doNotDependOnTheOrderOfTheSet) {
  auto sites = sitesAt({0.21, 0.83, 0.47}, {0.19, 0.32, 0.91});
  const auto topology = topologyOf(
      {{wall_ymin, 1, 2, wall_xmin}, {wall_ymin, wall_xmax, 2, 0}, {0, 1, wall_xmax, wall_ymax, wall_xmin}});
  const auto straight = agreeOnCorners(sites, topology, 1);
  ASSERT_TRUE(straight.disputed.empty());
  // The same three sites, stored from last to first.
  SiteSet turned{{0.47, 0.83, 0.21}, {0.91, 0.32, 0.19}, {2, 1, 0}, sites.domain};
  const auto turned_topology = topologyOf(
      {{2, 1, wall_xmax, wall_ymax, wall_xmin}, {wall_ymin, wall_xmax, 0, 2}, {wall_ymin, 1, 0, wall_xmin}});
  const auto other = agreeOnCorners(turned, turned_topology, 1);
  const auto vertex = straight.corners.position[2];
  EXPECT_NEAR(std::hypot(vertex.x - 0.21, vertex.y - 0.19), std::hypot(vertex.x - 0.47, vertex.y - 0.91),
              1e-15);
  for (const std::size_t e : {7u, 9u}) expectPoint(straight.corners.position[e], vertex.x, vertex.y);
  for (const std::size_t e : {1u, 8u, 11u}) expectPoint(other.corners.position[e], vertex.x, vertex.y);
}

}  // namespace
}  // namespace vorpipe::test

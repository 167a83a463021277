#include <gmock/gmock.h>

#include <cmath>

#include "domain/periodic_records.h"
#include "sites/images.h"
#include "unit/fixtures/periodic_runs.h"

namespace vorpipe::test {

using namespace core;

namespace {

using ::testing::IsEmpty;

TEST(Proof, AsksForAsMuchAsCellsNeed) {
  // All but a few sites stand in the middle: cells at the border are wide.
  auto sites = generate(Pattern::random, 400, 3);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    sites.x[i] = 0.4 + 0.2 * sites.x[i];
    sites.y[i] = 0.4 + 0.2 * sites.y[i];
  }
  const auto in_domain = placed(sites);
  Band thin;
  thin.width = {0.05, 0.05};
  auto imaged = withImages(in_domain, thin);
  const auto wider = bandThatProves(in_domain, imaged, imagedCells(imaged), thin, 1);
  EXPECT_GT(wider.width[0], 0.1);
  Band whole;
  whole.width = {1, 1};
  imaged = withImages(in_domain, whole);
  EXPECT_EQ(bandThatProves(in_domain, imaged, imagedCells(imaged), whole, 1).width, whole.width);
  // Within the most that cells need, all are as in the whole.
  const auto even = placed(generate(Pattern::random, 400, 3));
  auto band = likelyBandForCells(even, 1);
  for (;;) {
    imaged = withImages(even, band);
    auto next = bandThatProves(even, imaged, imagedCells(imaged), band, 1);
    if (next.width == band.width) break;
    EXPECT_GT(next.width[0] + next.width[1], band.width[0] + band.width[1]);
    band = next;
  }
  EXPECT_LT(band.width[0], 1);
  auto found = imagedCells(imaged), all = imagedCells(withImages(even, whole));
  EXPECT_TRUE(isClosed(imaged, found));
  for (std::size_t i = 0; i < 400; ++i) EXPECT_NEAR(found.area[i], all.area[i], 1e-14);
}

/// Cells of 30 sites and all their images; the tests change them.
class Seam : public ::testing::Test {
 protected:
  Seam() {
    Band whole;
    whole.width = {1, 1};
    imaged = withImages(in_domain, whole);
    cells = imagedCells(imaged);
    keepSites(imaged, cells);
  }
  /// An edge across the border: its site and its number.
  std::pair<std::size_t, std::uint64_t> acrossBorder() const {
    for (std::size_t i = 0; i < 30; ++i) {
      for (auto e = cells.cell_offsets[i]; e < cells.cell_offsets[i + 1]; ++e) {
        if (cells.neighbors[e] >= 30) return {i, e};
      }
    }
    return {};
  }
  std::uint64_t after(std::size_t i, std::uint64_t e) const {
    return e + 1 < cells.cell_offsets[i + 1] ? e + 1 : cells.cell_offsets[i];
  }
  /// Moves a vertex in all cells of sites that have it.
  void move(Point from, Point to) {
    for (auto& vertex : cells.vertices) {
      if (vertex.x == from.x && vertex.y == from.y) vertex = to;
    }
  }
  void erase(std::size_t i, std::uint64_t e) {
    const auto at = static_cast<std::ptrdiff_t>(e);
    cells.vertices.erase(cells.vertices.begin() + at);
    cells.neighbors.erase(cells.neighbors.begin() + at);
    cells.edge_lengths.erase(cells.edge_lengths.begin() + at);
    for (auto j = i + 1; j < cells.cell_offsets.size(); ++j) --cells.cell_offsets[j];
  }
  /// What check() finds once the cells are settled.
  std::vector<std::string> brokenOnceSettled() {
    EXPECT_TRUE(settleSeam(in_domain, imaged, cells));
    finishRecords(in_domain, imaged, Detail::polygons, 1, cells);
    return promisesOf(check(sites, periodicCells(Periodic::xy, Detail::polygons), cells));
  }

  Sites sites = generate(Pattern::random, 30, 12);
  PeriodicSites in_domain = placed(sites);
  ImagedSites imaged;
  Diagram cells;
};

TEST_F(Seam, OfCopiesThatAgreeStaysAsItIs) {
  const auto before = cells;
  EXPECT_TRUE(settleSeam(in_domain, imaged, cells));
  EXPECT_EQ(cells.neighbors, before.neighbors);
  EXPECT_EQ(cells.area, before.area);
  EXPECT_THAT(brokenOnceSettled(), IsEmpty());
}

TEST_F(Seam, JoinsCopiesOfACornerThatDiffer) {
  const auto [i, e] = acrossBorder();
  const Point from = cells.vertices[e];
  move(from, {from.x + 3e-8, from.y - 2e-8});
  EXPECT_THAT(brokenOnceSettled(), IsEmpty());
}

TEST_F(Seam, DropsAnEdgeThatIsATieInOneOfTwoCopies) {
  const auto [i, e] = acrossBorder();
  // As if the edge were short: its end is moved to its beginning, in all copies.
  const Point begin = cells.vertices[e], end = cells.vertices[after(i, e)];
  const double part = 1e-6;
  const Point short_end{begin.x + part * (end.x - begin.x), begin.y + part * (end.y - begin.y)};
  for (auto& vertex : cells.vertices) {
    const double x = std::round(vertex.x - end.x), y = std::round(vertex.y - end.y);
    const bool copy = std::hypot(vertex.x - end.x - x, vertex.y - end.y - y) < 1e-12;
    if (copy) vertex = {short_end.x + x, short_end.y + y};
  }
  const auto other = imaged.siteOf(static_cast<std::uint32_t>(cells.neighbors[e]));
  move(short_end, begin);
  erase(i, e);
  const auto count = cells.neighbors.size();
  ASSERT_TRUE(settleSeam(in_domain, imaged, cells));
  EXPECT_EQ(cells.neighbors.size(), count - 1);
  for (auto k = cells.cell_offsets[other]; k < cells.cell_offsets[other + 1]; ++k) {
    const auto neighbor = cells.neighbors[k];
    EXPECT_NE(imaged.siteOf(static_cast<std::uint32_t>(neighbor)), i);
  }
  double sum = 0;
  for (const double area : cells.area) sum += area;
  EXPECT_NEAR(sum, 1, 1e-5) << "cells elsewhere are measured as they were";
}

TEST_F(Seam, DoesNotExplainWhatNoTieDoes) {
  const auto right = cells;
  const auto [i, e] = acrossBorder();
  erase(i, e);
  const auto erased = cells;
  EXPECT_FALSE(settleSeam(in_domain, imaged, cells));
  EXPECT_EQ(cells.neighbors, erased.neighbors) << "nothing is changed then";
  cells = right;
  const Point from = cells.vertices[e];
  move(from, {from.x + 1e-3, from.y});
  EXPECT_FALSE(settleSeam(in_domain, imaged, cells));
}

}  // namespace
}  // namespace vorpipe::test

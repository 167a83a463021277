/// Pieces of cells in regions, against runs over all sites in each region.
#include "vorpipe/pieces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "support/sites/random_sites.h"
#include "unit/fixtures/checked_runs.h"
#include "unit/fixtures/outlines.h"

namespace vorpipe::test {
namespace {

CellsOptions inSquare() {
  CellsOptions options = unit_cells;
  options.detail = Detail::polygons;
  return options;
}

std::vector<Outline> someRegions() {
  return {outlineOf({{rectangle(0, 0, 1, 1)}}), outlineOf({{coast({0.4, 0.5}, 0.3, 200, 0.4, 5)}}),
          outlineOf({{rectangle(0.2, 0.2, 0.9, 0.6), rectangle(0.3, 0.3, 0.5, 0.5)},
                     {rectangle(0.1, 0.8, 0.2, 0.9)}}),
          outlineOf({{rectangle(0.5, 0.5, 0.501, 0.502)}})};
}

/// What the pieces in a region are, and what a run over all sites finds in it.
void expectAsAlone(const Pieces& pieces, std::uint32_t r, const Outline& region, const Sites& sites) {
  CellsOptions alone = inSquare();
  alone.outline = region;
  alone.domain = boxOf(region.points);
  const Diagram cells = cellsOf(sites, alone);
  const double area = areaSum(cells);
  EXPECT_NEAR(pieces.region_area[r], area, 1e-12 * area);
  std::size_t count = 0;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (pieces.region[k] != r) continue;
    const std::uint32_t site = pieces.site[k];
    ++count;
    EXPECT_EQ(cells.status[site], Status::ok);
    EXPECT_NEAR(pieces.cells.area[k], cells.area[site], 1e-12 * area);
    const Cell piece = pieces.cells.cell(k), cell = cells.cell(site);
    EXPECT_THAT(std::vector<std::int64_t>(piece.neighbors().begin(), piece.neighbors().end()),
                testing::UnorderedElementsAreArray(cell.neighbors()));
    EXPECT_EQ(piece.rings().size(), cell.rings().size());
  }
  EXPECT_EQ(count, static_cast<std::size_t>(std::ranges::count(cells.status, Status::ok)));
}

TEST(Pieces, AreThoseOfARunInEachRegion) {
  Sites sites = mixedSites();
  const auto regions = someRegions();
  const std::uint64_t seed = std::random_device()();
  SCOPED_TRACE(seed);
  for (const bool weighted : {false, true}) {
    if (weighted) {
      Random random(seed);
      for (std::size_t i = 0; i < sites.size(); ++i) sites.weight.push_back(0.003 * random.uniform());
    }
    Session session = cpuSession();
    const auto pieces = piecesOf(session, sites, inSquare(), regions);
    ASSERT_TRUE(pieces) << pieces.error().message;
    ASSERT_EQ(pieces->region_area.size(), regions.size());
    EXPECT_TRUE(std::ranges::is_sorted(pieces->region));
    for (std::uint32_t r = 0; r < regions.size(); ++r) expectAsAlone(*pieces, r, regions[r], sites);
    EXPECT_EQ(pieces->cells.report.ok + pieces->cells.report.empty + pieces->cells.report.duplicate,
              sites.size());
  }
}

TEST(Pieces, EachRegionIsShownAndMayEndIt) {
  const Sites sites = mixedSites();
  const auto regions = someRegions();
  std::size_t shown = 0;
  const auto each = [&](const Sites& some, const CellsOptions& options,
                        const Diagram& cells) -> Result<void> {
    EXPECT_EQ(some.size(), cells.size());
    EXPECT_EQ(options.outline.points, regions[shown].points);
    if (++shown == 2) return tl::unexpected(Error{ErrorCode::input, "enough"});
    return {};
  };
  Session session = cpuSession();
  const auto pieces = piecesOf(session, sites, inSquare(), regions, each);
  ASSERT_FALSE(pieces);
  EXPECT_EQ(pieces.error().message, "enough");
  EXPECT_EQ(shown, 2u);
}

TEST(Triangulation, ItsEdgesAreThoseOfTrianglesOrOfALine) {
  const Sites square{{0, 1, 0, 1.1}, {0, 0, 1, 1}, {}};
  CellsOptions options = unit_cells;
  EXPECT_THAT(
      triangulationEdges(square, cellsOf(square, options)),
      testing::ElementsAre(SitePair{0, 1}, SitePair{0, 2}, SitePair{1, 2}, SitePair{1, 3}, SitePair{2, 3}));
  const Sites line{{0, 1, 0.5, 0.5}, {0, 1, 0.5, 0.5}, {}};
  EXPECT_THAT(triangulationEdges(line, cellsOf(line, options)),
              testing::ElementsAre(SitePair{0, 2}, SitePair{1, 2}));
}

}  // namespace
}  // namespace vorpipe::test

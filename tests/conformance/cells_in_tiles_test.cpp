/// That measures in tiles are those of Session::cells, whatever the sites, the tiles and the device.
#include <gtest/gtest.h>

#include <cmath>

#include "conformance/cells_fixture.h"
#include "support/sites/data_sets.h"
#include "vorpipe/tiled.h"

namespace vorpipe::test {
namespace {

class CellsInTilesOf : public Cells {
 protected:
  struct Measures {
    std::vector<double> area;
    std::vector<Point> centroid;
    std::vector<std::uint32_t> neighbors;
    std::vector<Status> status;
    std::vector<int> times;  ///< that the sink got the site
    TiledReport made;
  };

  Measures measure(const SitesInPlace& sites, const TiledOptions& options) {
    Measures all;
    all.area.resize(sites.count);
    all.centroid.resize(sites.count);
    all.neighbors.resize(sites.count);
    all.status.resize(sites.count);
    all.times.resize(sites.count);
    const auto sink = [&](auto which, auto cells) -> Result<void> {
      for (std::size_t k = 0; k < which.size(); ++k) {
        const auto i = which[k];
        all.area[i] = cells[k].area;
        all.centroid[i] = cells[k].centroid;
        all.neighbors[i] = cells[k].neighbors;
        all.status[i] = cells[k].status;
        ++all.times[i];
      }
      return {};
    };
    auto made = CellsInTiles(sharedSession(GetParam()), options).measure(sites, sink);
    EXPECT_TRUE(made) << made.error().message;
    if (made) all.made = std::move(*made);
    return all;
  }

  /// The same to the last bit, but where there are ties: the places of these are so to rounding.
  void expectTheSame(const Sites& sites, const Box& domain, std::uint64_t usual, bool has_ties = false) {
    const double slack = has_ties ? 1e-12 : 0;
    const Measures tiled = measure(sitesInPlace(sites), {.domain = domain, .usual = usual});
    CellsOptions options = within(domain);
    options.detail = Detail::measures;
    const Diagram whole = cells(sites, options);
    EXPECT_EQ(tiled.status, whole.status);
    const double width = domain.xmax - domain.xmin, height = domain.ymax - domain.ymin;
    const double side = slack * std::max(width, height), area = 1e-4 * slack * width * height;
    std::size_t areas = 0, centroids = 0, neighbors = 0;
    for (std::size_t i = 0; i < sites.size(); ++i) {
      const Point a = tiled.centroid[i], b = whole.centroid[i];
      areas += std::abs(tiled.area[i] - whole.area[i]) <= area + slack * whole.area[i] ? 0u : 1u;
      // A cell that ties leave nothing of but rounding has its centroid somewhere along it.
      const bool is_nothing = has_ties && whole.area[i] <= 1e-12 * width * height;
      const bool is_there = std::abs(a.x - b.x) <= side && std::abs(a.y - b.y) <= side;
      centroids += is_there || is_nothing ? 0u : 1u;
      neighbors += tiled.neighbors[i] == whole.cell_offsets[i + 1] - whole.cell_offsets[i] ? 0u : 1u;
      ASSERT_EQ(tiled.times[i], 1) << "site " << i;
    }
    EXPECT_EQ(areas, 0u);
    EXPECT_EQ(centroids, 0u);
    EXPECT_EQ(neighbors, 0u);
    EXPECT_EQ(tiled.made.report.ok, whole.report.ok);
    EXPECT_EQ(tiled.made.report.empty, whole.report.empty);
    EXPECT_EQ(tiled.made.report.duplicate, whole.report.duplicate);
  }
};

TEST_P(CellsInTilesOf, hardSitesHaveTheSameCells) {
  for (const DataSetKind& kind : dataSetKinds()) {
    SCOPED_TRACE(kind.name);
    const auto set = makeDataSet(kind.name, 600, 7);
    expectTheSame(set.sites, set.domain, 250, true);
  }
}

TEST_P(CellsInTilesOf, sitesWithoutTiesAreTheSameBytes) {
  for (const auto pattern : {Pattern::random, Pattern::clusters, Pattern::jitter}) {
    expectTheSame(generate(pattern, 20'000, 3), unit, 4000);
  }
}

TEST_P(CellsInTilesOf, latticesHaveTheSameCells) {
  for (const auto pattern : {Pattern::square, Pattern::hex}) {
    expectTheSame(generate(pattern, 20'000, 3), unit, 4000, true);
  }
}

TEST_P(CellsInTilesOf, sitesBeyondTheDomainAreTheSameBytes) {
  const auto sites = generate(Pattern::random, 20'000, 5);
  expectTheSame(sites, {0.3, 0.2, 0.5, 0.9}, 3000);
  expectTheSame(sites, {-3, 0.2, 0.5, 0.9}, 3000);
  expectTheSame(sites, {2, 2, 3, 3}, 3000);
}

TEST_P(CellsInTilesOf, floatsAndRowsAreReadWhereTheyAre) {
  const auto sites = generate(Pattern::random, 5000, 9);
  std::vector<float> rows;
  Sites rounded;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const float x = static_cast<float>(sites.x[i]), y = static_cast<float>(sites.y[i]);
    rows.insert(rows.end(), {x, y});
    rounded.x.push_back(x);
    rounded.y.push_back(y);
  }
  const auto* first = reinterpret_cast<const std::byte*>(rows.data());
  const SitesInPlace places{
      {first, 2 * sizeof(float), true}, {first + sizeof(float), 2 * sizeof(float), true}, sites.size()};
  const TiledOptions options{.domain = unit, .usual = 2000};
  EXPECT_EQ(measure(places, options).area, measure(sitesInPlace(rounded), options).area);
}

TEST_P(CellsInTilesOf, moreInOnePlaceThanATileMayHaveIsRefused) {
  const auto sites = generate(Pattern::random, 5000, 9);
  const auto sink = [](auto, auto) -> Result<void> { return {}; };
  const auto made = CellsInTiles(sharedSession(GetParam()), {.domain = unit, .usual = 100, .most = 100})
                        .measure(sitesInPlace(sites), sink);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::input);
  EXPECT_NE(made.error().message.find("crowded"), std::string::npos) << made.error().message;
}

TEST_P(CellsInTilesOf, aRunThatIsToldToStopDoes) {
  const auto sites = generate(Pattern::random, 5000, 9);
  int calls = 0;
  TiledOptions options{.domain = unit, .usual = 1000};
  options.progress = [&](std::string_view, double) { return ++calls < 4; };
  const auto sink = [](auto, auto) -> Result<void> { return {}; };
  const auto made = CellsInTiles(sharedSession(GetParam()), options).measure(sitesInPlace(sites), sink);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::cancelled);
}

INSTANTIATE_TEST_SUITE_P(Backends, CellsInTilesOf, testing::ValuesIn(backend_names),
                         [](const auto& instance) { return testName(instance.param); });

}  // namespace
}  // namespace vorpipe::test

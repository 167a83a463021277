/// That measures in tiles are those of Session::cells, whatever the sites, the tiles and the device.
#include <gtest/gtest.h>

#include <cstring>

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

  void expectTheSame(const Sites& sites, const Box& domain, std::uint64_t usual) {
    const Measures tiled = measure(sitesInPlace(sites), {.domain = domain, .usual = usual});
    CellsOptions options = within(domain);
    options.detail = Detail::measures;
    const Diagram whole = cells(sites, options);
    EXPECT_EQ(tiled.status, whole.status);
    const auto sameBytes = [](const auto& a, const auto& b) {
      return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
    };
    EXPECT_TRUE(sameBytes(tiled.area, whole.area));
    EXPECT_TRUE(sameBytes(tiled.centroid, whole.centroid));
    std::size_t other_areas = 0, other_neighbors = 0;
    for (std::size_t i = 0; i < sites.size(); ++i) {
      other_areas += tiled.area[i] != whole.area[i] ? 1u : 0u;
      other_neighbors += tiled.neighbors[i] != whole.cell_offsets[i + 1] - whole.cell_offsets[i] ? 1u : 0u;
      ASSERT_EQ(tiled.times[i], 1) << "site " << i;
    }
    EXPECT_EQ(other_areas, 0u);
    EXPECT_EQ(other_neighbors, 0u);
    EXPECT_EQ(tiled.made.report.ok, whole.report.ok);
    EXPECT_EQ(tiled.made.report.empty, whole.report.empty);
    EXPECT_EQ(tiled.made.report.duplicate, whole.report.duplicate);
    std::printf("  %llu tiles, largest %llu, %llu open of %zu\n",
                static_cast<unsigned long long>(tiled.made.tiles),
                static_cast<unsigned long long>(tiled.made.largest),
                static_cast<unsigned long long>(tiled.made.open), sites.size());
  }
};

TEST_P(CellsInTilesOf, hardSitesAreTheSameBytes) {
  for (const DataSetKind& kind : dataSetKinds()) {
    SCOPED_TRACE(kind.name);
    std::printf("%s\n", std::string(kind.name).c_str());
    const auto set = makeDataSet(kind.name, 4000, 7);
    expectTheSame(set.sites, set.domain, 1500);
  }
}

TEST_P(CellsInTilesOf, patternsAreTheSameBytes) {
  for (const auto pattern : {Pattern::random, Pattern::clusters, Pattern::square, Pattern::hex,
                             Pattern::jitter, Pattern::circle}) {
    const auto sites = generate(pattern, 20'000, 3);
    expectTheSame(sites, unit, 4000);
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

/// The cells of periodic domains of every backend, by name, against exact arithmetic on nine tiles.
#include <algorithm>
#include <map>
#include <string>
#include <tuple>

#include "conformance/periodic_fixture.h"
#include "support/exact/exact_cells.h"
#include "support/sites/data_sets.h"

namespace vorpipe::test {
namespace {

constexpr double shortest = 1e-6, gap = 1e-9;  // in distances of the two sites

void expectExact(const Diagram& d, const ExactCells& exact, const Tiled& tiled, double mean_area) {
  for (std::size_t i = 0; i < tiled.count; ++i) {
    SCOPED_TRACE(testing::Message() << "site " << i);
    const auto begin = exact.edges.begin() + static_cast<std::ptrdiff_t>(exact.offsets[i]);
    const auto end = exact.edges.begin() + static_cast<std::ptrdiff_t>(exact.offsets[i + 1]);
    EXPECT_EQ(d.status[i], begin == end ? Status::empty : Status::ok);
    EXPECT_NEAR(d.area[i], exact.area[i], 1e-5 * exact.area[i] + 1e-9 * mean_area);
    std::set<ImageOf> beside, in_doubt;
    for (auto edge = begin; edge != end; ++edge) {
      auto& images = std::abs(edge->part - shortest) < gap * shortest ? in_doubt : beside;
      if (edge->part > shortest * (1 - gap)) images.insert(tiled.imageAt(edge->neighbor));
    }
    auto reported = imagesBeside(d, i);
    for (const auto& image : in_doubt) reported.erase(image);
    EXPECT_EQ(reported, beside);
  }
}

class PeriodicAgainstExact : public PeriodicCells {
 protected:
  /// `name` is that of the sites: what is exact of them is found once for all backends.
  static void compare(const std::string& name, const Sites& sites, const CellsOptions& wanted) {
    SCOPED_TRACE(testing::Message() << "periodic " << static_cast<int>(wanted.periodic));
    const auto tiled = tile(sites, wanted);
    const Box& box = wanted.domain;
    static std::map<std::tuple<std::string, std::size_t, Periodic, double>, ExactCells> known;
    const auto [exact, fresh] = known.try_emplace({name, sites.size(), wanted.periodic, box.xmin});
    if (fresh) exact->second = exactCells(tiled.sites, tiled.domain);
    const double mean_area =
        (box.xmax - box.xmin) * (box.ymax - box.ymin) / static_cast<double>(sites.size());
    expectExact(cells(sites, wanted), exact->second, tiled, mean_area);
  }
};

TEST_P(PeriodicAgainstExact, agreeByWeight) {
  for (const char* name :
       {"weights-1", "weights-100", "ten-heavy", "one-swallows-all", "flattened-turned", "weighted-curves"}) {
    SCOPED_TRACE(name);
    for (const std::uint64_t n : {5u, 120u}) {
      const auto set = makeDataSet(name, n, 20261122);
      for (const auto periodic : {Periodic::x, Periodic::y, Periodic::xy}) {
        compare(name, set.sites, repeated(periodic, set.domain));
      }
    }
  }
}

/// With one site on the border, and its image.
TEST_P(PeriodicAgainstExact, agreeOnAChessboard) {
  for (const char* name : {"chessboard", "chessboard-verge", "chessboard-touching"}) {
    SCOPED_TRACE(name);
    const auto sites = makeDataSet(name, 64, 1).sites;
    for (const double offset : {-1.0, -0.5, 0.0}) {
      const Box board{offset, offset, offset + 16, offset + 16};
      for (const auto periodic : {Periodic::x, Periodic::xy}) compare(name, sites, repeated(periodic, board));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, PeriodicAgainstExact, testing::ValuesIn(backend_names),
                         [](const auto& instance) { return testName(instance.param); });

}  // namespace
}  // namespace vorpipe::test

// Cells on the globe: the promises for hard sites, and the same bytes from every backend.
#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

#include "conformance/cells_fixture.h"
#include "conformance/metamorphic_fixture.h"
#include "support/oracles/same_bytes.h"
#include "support/sites/globe_sites.h"

namespace vorpipe::test {
namespace {

constexpr double whole_sphere = 4 * std::numbers::pi, earth_km2 = 510065621.7240887;

double relativeSum(const std::vector<double>& parts, double whole) {
  return std::accumulate(parts.begin(), parts.end(), 0.0) / whole - 1;
}

class GlobeCells : public Cells {
 protected:
  static void expectRight(const Sites& sites, std::string_view name) {
    SCOPED_TRACE(name);
    const Diagram found = cells(sites, ofGlobe());
    expectSameBytes(found, cells(sharedSession("cpu"), sites, ofGlobe()));
    const auto broken = check(sites, ofGlobe(), found);
    ASSERT_TRUE(broken) << broken.error().message;
    EXPECT_EQ(*broken, std::vector<std::string>{});
    EXPECT_NEAR(relativeSum(found.solid_angle, whole_sphere), 0, 1e-12);
    EXPECT_NEAR(relativeSum(found.area, earth_km2), 0, 1e-12);
  }
};

TEST_P(GlobeCells, keepTheirPromises) {
  for (const GlobeSet& set : hardOnGlobe()) expectRight(set.sites, set.name);
}

TEST_P(GlobeCells, keepThemWithWeights) {
  for (const GlobeSet& set : hardOnGlobe()) {
    if (set.sites.size() > 500) continue;
    expectRight(capsOf(set.sites, 0, 4e6, 1), set.name + ", caps that hide others");
    expectRight(capsOf(set.sites, -1e4, 1e4, 2), set.name + ", small caps, some imaginary");
  }
  Sites twice = randomOnGlobe(50, 3);
  append(twice, Sites(twice));
  expectRight(capsOf(twice, 0, 1e5, 4), "two weights at each place");
}

/// Those of the seed that VORPIPE_SEED names.
TEST_P(GlobeCells, keepThemForRandomHardSites) {
  if (GetParam() != std::string("cpu")) GTEST_SKIP() << "the sites of a run, once";
  const auto seed = seedOfRun();
  for (std::uint64_t number = 0; number < 60; ++number) {
    Random random(seed + number);
    Sites sites;
    const auto parts = 1 + random.below(4);
    for (std::uint64_t part = 0; part < parts; ++part) {
      const std::uint64_t draw = random(), count = 1 + random.below(120);
      switch (random.below(6)) {
        case 0:
          append(sites, randomOnGlobe(count, draw));
          break;
        case 1:
          append(sites, around(noise(random, 200), noise(random, 89), tenTo(random, -7, 1), count, draw));
          break;
        case 2:
          append(sites, degreeGrid(oneOf(random, {15.0, 30.0, 45.0}), onceIn(random, 2)));
          break;
        case 3:
          append(sites, icosahedral(static_cast<int>(1 + random.below(4))));
          break;
        case 4:
          for (std::uint64_t k = 0; k < count; ++k)
            add(sites, {noise(random, 360), oneOf(random, {-90.0, 0.0, 45.0, 90.0})});
          break;
        default:
          for (std::uint64_t k = 0; k < count; ++k) {
            add(sites, {std::round(noise(random, 20)) * 9, std::round(noise(random, 10)) * 9});
          }
      }
    }
    const bool has_weights = onceIn(random, 3);
    if (has_weights) sites = capsOf(std::move(sites), -tenTo(random, -2, 5), tenTo(random, -2, 6), random());
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", number " << number);
    expectRight(sites, has_weights ? "weighted" : "unweighted");
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, GlobeCells, testing::ValuesIn(backend_names),
                         [](const auto& instance) { return testName(instance.param); });

}  // namespace
}  // namespace vorpipe::test

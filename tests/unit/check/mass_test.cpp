#include <gmock/gmock.h>

#include <algorithm>
#include <random>

#include "unit/fixtures/checked_runs.h"
#include "unit/fixtures/outlines.h"

namespace vorpipe::test {
namespace {

using ::testing::Contains;
using ::testing::IsEmpty;

Density randomDensity(int width, int height) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform(1, 2);
  Density density{width, height, {}};
  for (int k = 0; k < width * height; ++k) density.values.push_back(uniform(random));
  return density;
}

/// The tests change the masses of cells, and see whether that is found.
class CheckMass : public ::testing::Test {
 protected:
  CheckMass() {
    options.density = randomDensity(30, 20);
    cells = cellsOf(sites, options);
  }
  [[nodiscard]] std::vector<std::string> broken() const { return promisesOf(check(sites, options, cells)); }

  Sites sites = mixedSites();
  CellsOptions options = unit_cells;
  Diagram cells;
};

TEST_F(CheckMass, FindsNothingInRightOnes) {
  EXPECT_THAT(broken(), IsEmpty());
  sites.weight.resize(sites.size());
  for (std::size_t i = 0; i < sites.size(); ++i) sites.weight[i] = 1e-4 * static_cast<double>(i % 20);
  for (const auto periodic : {Periodic::none, Periodic::y, Periodic::xy}) {
    options.periodic = periodic;
    for (const auto detail : {Detail::measures, Detail::everything}) {
      options.detail = detail;
      cells = cellsOf(sites, options);
      EXPECT_THAT(broken(), IsEmpty());
    }
  }
  options = inside(country(1000));
  options.density = randomDensity(64, 64);
  cells = cellsOf(sites, options);
  EXPECT_THAT(broken(), IsEmpty());
  options.outline = {};
  options.density.values.assign(64 * 64, 0);
  options.density.values[700] = 1e200;
  cells = cellsOf(sites, options);
  EXPECT_THAT(broken(), IsEmpty());
}

TEST_F(CheckMass, FindsMassesThatNoDensityGives) {
  const auto right = cells;
  for (const double factor : {0.0, 0.4, 2.5, -1.0}) {
    cells = right;
    cells.mass[7] *= factor;
    EXPECT_THAT(broken(), Contains("masses")) << factor;
  }
  cells = right;
  cells.mass[7] *= 1 + 1e-4;
  EXPECT_THAT(broken(), Contains("masses"));
  cells = right;
  cells.mass[202] = 1;
  EXPECT_THAT(broken(), Contains("masses"));
  cells = right;
  for (double& mass : cells.mass) mass = -mass;
  options.detail = Detail::measures;
  EXPECT_THAT(broken(), Contains("masses"));
}

TEST_F(CheckMass, FindsMassesOfThinCellsThatNoDensityGives) {
  sites = {{0, 0, 1}, {0, 2e-7, 0}, {}};
  for (const auto detail : {Detail::measures, Detail::polygons}) {
    options.detail = detail;
    cells = cellsOf(sites, options);
    EXPECT_THAT(broken(), IsEmpty());
    cells.mass[0] *= 0.4;
    cells.mass[1] += 1.5 * cells.mass[0];
    EXPECT_THAT(broken(), Contains("masses"));
  }
}

TEST_F(CheckMass, FindsCentersBeyondTheCell) {
  const auto right = cells;
  cells.mass_centroid[7].x += 0.5;
  EXPECT_THAT(broken(), Contains("masses"));
  cells = right;
  cells.mass_centroid[202].y += 1;
  EXPECT_THAT(broken(), Contains("masses"));
}

TEST_F(CheckMass, FindsAnotherDensity) {
  options.density.values[17] += 0.01;
  EXPECT_THAT(broken(), Contains("masses"));
  options.density = {};
  EXPECT_THAT(broken(), Contains("arrays"));
  cells.mass.pop_back();
  options.density = randomDensity(30, 20);
  EXPECT_THAT(broken(), Contains("arrays"));
}

}  // namespace
}  // namespace vorpipe::test

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <tuple>

#include "checked_runs.h"
#include "core/periodic.h"
#include "core/periodic_band.h"
#include "core/periodic_proof.h"
#include "core/periodic_records.h"
#include "core/periodic_seam.h"

namespace vorpipe::test {
namespace {

using ::testing::Contains;
using ::testing::IsEmpty;

constexpr Box unit{0, 0, 1, 1};

PeriodicSites placed(const Sites& sites, const Box& domain = unit, Periodic periodic = Periodic::xy) {
  return std::move(*placeSites(sites, domain, periodic, 2));
}

CellsOptions periodicCells(Periodic periodic = Periodic::xy, Detail detail = Detail::everything) {
  CellsOptions options = unit_cells;
  options.periodic = periodic;
  options.detail = detail;
  return options;
}

/// Cells of sites and images, as far as `band` goes.
Diagram imagedCells(const ImagedSites& imaged) {
  CellsOptions options = unit_cells;
  options.domain = imaged.box;
  options.detail = Detail::polygons;
  return cellsOf(imaged.sites, options);
}

TEST(PeriodicAxis, HasExactImages) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> part(0, 1);
  for (const auto& [low, high] : {std::pair{0.0, 1.0},
                                  {-0.1, 0.9 * 1.3},
                                  {0.3, 1.9},
                                  {1e-30, 1.1},
                                  {5e6, 5e6 + 1},
                                  {-1e9, -1e9 + 1.7},
                                  {-0.7, 0.8}}) {
    const PeriodicAxis axis(low, high, true);
    EXPECT_NEAR(axis.length, high - low, 1e-15 * (std::abs(high) + 1));
    for (int k = 0; k < 1000; ++k) {
      const double number = low + part(random) * (high - low);
      const auto place = axis.put(number);
      EXPECT_GE(place.place, axis.low);
      EXPECT_LT(place.place, axis.high);
      EXPECT_NEAR(axis.number(place.place, place.periods), number, 4e-16 * (std::abs(number) + high - low));
      EXPECT_EQ((place.place + axis.length) - place.place, axis.length);
      EXPECT_EQ((place.place - axis.length) - place.place, -axis.length);
      EXPECT_EQ((place.place + axis.length) - axis.length, place.place);
    }
  }
}

TEST(PeriodicAxis, PutsTheSamePlaceOfEveryPeriodIntoTheDomain) {
  const PeriodicAxis axis(0, 1, true);
  const auto place = axis.put(0.375);
  EXPECT_EQ(place.periods, 0);
  for (const double periods : {-0x1p40, -3.0, -1.0, 1.0, 2.0, 1000.0, 0x1p40}) {
    const auto other = axis.put(0.375 + periods);
    EXPECT_EQ(other.place, place.place);
    EXPECT_EQ(other.periods, periods);
  }
  EXPECT_EQ(axis.put(1).place, axis.put(0).place);
  EXPECT_EQ(axis.put(1).periods, 1);
  EXPECT_EQ(axis.put(-1e-300).place, axis.put(0).place);
  EXPECT_EQ(axis.put(1 - 0x1p-54).place, axis.put(0).place);
  EXPECT_GT(std::abs(axis.put(1e300).periods), 0x1p50) << "too far to tell";
}

TEST(Wrapped, LeavesSitesInTheDomainWhereTheyAre) {
  const Sites sites{{0, 1, 0.375, 1.25, -7.5}, {0, 0.5, 1, 3, 0.25}, {1, 2, 3, 4, 5}};
  const auto both = *wrapped(sites, unit, Periodic::xy);
  EXPECT_EQ(both.x, (std::vector<double>{0, 1, 0.375, 0.25, 0.5}));
  EXPECT_EQ(both.y, (std::vector<double>{0, 0.5, 1, 0, 0.25}));
  EXPECT_EQ(both.weight, sites.weight);
  const auto x = *wrapped(sites, unit, Periodic::x);
  EXPECT_EQ(x.x, both.x);
  EXPECT_EQ(x.y, sites.y);
  EXPECT_EQ(wrapped(sites, unit, Periodic::none)->x, sites.x);
}

TEST(Wrapped, ChangesNothingTwice) {
  for (const Box& domain :
       {unit, Box{0.1, -0.3, 1.7, 0.4}, Box{5e6, -77, 5e6 + 3, -76}, Box{-1e-9, 0, 1e-9, 3e-9}}) {
    auto sites = generate(Pattern::random, 500, 4);
    for (std::size_t i = 0; i < sites.size(); ++i) {
      sites.x[i] = domain.xmin + (3 * sites.x[i] - 1) * (domain.xmax - domain.xmin);
      sites.y[i] = domain.ymin + (3 * sites.y[i] - 1) * (domain.ymax - domain.ymin);
    }
    const auto once = *wrapped(sites, domain, Periodic::xy);
    const auto twice = *wrapped(once, domain, Periodic::xy);
    EXPECT_EQ(once.x, twice.x);
    EXPECT_EQ(once.y, twice.y);
  }
}

TEST(Wrapped, RefusesWhatIsTooFarToTell) {
  const auto refused = wrapped({{0.5, 0x1p52}, {0.5, 0.5}, {}}, unit, Periodic::x);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::input);
  EXPECT_THAT(refused.error().message, testing::HasSubstr("site 1"));
  EXPECT_TRUE(wrapped({{0.5, 0x1p52}, {0.5, 0.5}, {}}, unit, Periodic::y));
}

TEST(Images, AreAllOfABandOnce) {
  auto sites = generate(Pattern::random, 300, 2);
  sites.weight.assign(300, 0);
  for (std::size_t i = 0; i < 300; ++i) sites.weight[i] = static_cast<double>(i);
  const auto in_domain = placed(sites);
  Band band;
  band.width = {0.25, 0.125};
  band.heavy = {17, 250};
  const auto imaged = withImages(in_domain, band);
  std::set<std::tuple<std::uint32_t, int, int>> wanted, found;
  for (std::uint32_t i = 0; i < 300; ++i) {
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= 1; ++y) {
        const double px = in_domain.sites.x[i] + x, py = in_domain.sites.y[i] + y;
        const bool inside = std::abs(px) <= 0.75 && std::abs(py) <= 0.625;
        if ((x != 0 || y != 0) && (inside || i == 17 || i == 250)) wanted.insert({i, x, y});
      }
    }
  }
  for (std::uint32_t k = 0; k < imaged.images.size(); ++k) {
    const auto& [site, shift] = imaged.images[k];
    EXPECT_TRUE((found.insert({site, shift[0], shift[1]}).second));
    EXPECT_EQ(imaged.sites.x[300 + k], in_domain.sites.x[site] + shift[0]);
    EXPECT_EQ(imaged.sites.y[300 + k], in_domain.sites.y[site] + shift[1]);
    EXPECT_EQ(imaged.sites.weight[300 + k], imaged.sites.weight[site]);
    EXPECT_EQ(imaged.siteOf(300 + k), site);
  }
  EXPECT_EQ(found, wanted);
}

/// How much nearer the nearest image in the 5 x 5 tiles is than the nearest of some sites, over places of
/// the domain.
double missedBy(const PeriodicSites& all, const ImagedSites& some) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> part(-0.5, 0.5);
  const auto power = [&](std::size_t i, double x, double y, const Sites& of) {
    const double dx = of.x[i] - x, dy = of.y[i] - y;
    return dx * dx + dy * dy - (of.weight.empty() ? 0 : of.weight[i]);
  };
  double missed = 0;
  for (int k = 0; k < 2000; ++k) {
    double x = part(random), y = part(random);
    (k % 4 == 0 ? x : y) = k % 2 == 0 ? -0.5 : 0.5;
    double least = std::numeric_limits<double>::infinity(), known = least;
    for (std::size_t i = 0; i < all.sites.size(); ++i) {
      for (int sx = -2; sx <= 2; ++sx) {
        for (int sy = -2; sy <= 2; ++sy) least = std::min(least, power(i, x + sx, y + sy, all.sites));
      }
    }
    for (std::size_t i = 0; i < some.sites.size(); ++i) known = std::min(known, power(i, x, y, some.sites));
    missed = std::max(missed, known - least);
  }
  return missed;
}

TEST(Band, HoldsTheNearestImageOfEveryPlace) {
  for (const auto pattern : {Pattern::random, Pattern::clusters, Pattern::square, Pattern::circle}) {
    for (const std::uint64_t n : {1u, 2u, 5u, 300u}) {
      for (const double weights : {0.0, 1e-3, 1.0}) {
        SCOPED_TRACE(testing::Message()
                     << n << " sites, pattern " << static_cast<int>(pattern) << ", weights " << weights);
        auto sites = generate(pattern, n, 8);
        std::mt19937_64 random(n);
        if (weights > 0) {
          for (std::size_t i = 0; i < sites.size(); ++i) {
            const auto part = std::generate_canonical<double, 53>(random);
            sites.weight.push_back(weights * part * part * part);
          }
        }
        const auto in_domain = placed(sites);
        EXPECT_LT(missedBy(in_domain, withImages(in_domain, bandForPlaces(in_domain, 1))), 1e-14);
      }
    }
  }
}

TEST(Band, IsThinForManySites) {
  const auto in_domain = placed(generate(Pattern::random, 100'000, 8));
  const auto band = likelyBandForCells(in_domain, 1);
  EXPECT_LT(band.width[0], 0.03);
  EXPECT_LT(withImages(in_domain, band).images.size(), 15'000u);
}

TEST(Band, TellsHowManySitesAndImagesThereAre) {
  const auto many = generate(Pattern::random, 100'000, 8);
  EXPECT_EQ(sitesAndImages(many, unit, Periodic::none), 100'000u);
  const auto count = sitesAndImages(many, unit, Periodic::xy).value_or(0);
  EXPECT_GT(count, 101'000u);
  EXPECT_LT(count, 115'000u);
  EXPECT_EQ(sitesAndImages({{0.5}, {0.5}, {}}, unit, Periodic::xy), 9u);
  EXPECT_EQ(sitesAndImages({{0.5}, {0.5}, {}}, unit, Periodic::y), 3u);
  EXPECT_FALSE(sitesAndImages({}, unit, Periodic::y));
}

TEST(Band, StaysThinWhereAFewSitesAreHeavy) {
  auto sites = generate(Pattern::random, 10'000, 8);
  sites.weight.assign(10'000, 0);
  for (const std::size_t i : {5u, 77u}) sites.weight[i] = 0.3;
  const auto band = likelyBandForCells(placed(sites), 1);
  EXPECT_EQ(band.heavy, (std::vector<std::uint32_t>{5, 77}));
  EXPECT_LT(band.width[0], 0.1);
}

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

/// The tests change the cells of a periodic domain, and see which promises are broken then.
class CheckPeriodicCells : public ::testing::Test {
 protected:
  [[nodiscard]] std::vector<std::string> broken() const {
    return promisesOf(check(sites, periodicCells(), cells));
  }
  Sites sites = generate(Pattern::random, 60, 12);
  Diagram cells = cellsOf(sites, periodicCells());
};

TEST_F(CheckPeriodicCells, FindsNothingInRightOnes) {
  EXPECT_THAT(broken(), IsEmpty());
  sites = mixedSites();
  for (const auto periodic : {Periodic::x, Periodic::y, Periodic::xy}) {
    const auto wanted = periodicCells(periodic);
    EXPECT_THAT(promisesOf(check(sites, wanted, cellsOf(sites, wanted))), IsEmpty());
  }
}

TEST_F(CheckPeriodicCells, FindsOrdinaryOnes) {
  cells = cellsOf(sites, unit_cells);
  EXPECT_THAT(broken(), Contains("arrays"));
  cells.neighbor_shifts.resize(cells.neighbors.size());
  EXPECT_THAT(broken(), Contains("neighbors"));
}

TEST_F(CheckPeriodicCells, FindsWrongShifts) {
  for (std::size_t e = 0; e < cells.neighbors.size(); e += 17) {
    const auto right = cells;
    cells.neighbor_shifts[e][e % 2] += 1;
    EXPECT_THAT(broken(), Contains("symmetry")) << "edge " << e;
    cells = right;
  }
  cells.neighbor_shifts.pop_back();
  EXPECT_THAT(broken(), Contains("arrays"));
}

TEST_F(CheckPeriodicCells, FindsShiftsAlongTheOtherAxis) {
  const auto x = periodicCells(Periodic::x);
  cells = cellsOf(sites, x);
  const auto wall = std::ranges::find(cells.neighbors, wall_ymin) - cells.neighbors.begin();
  cells.neighbors[static_cast<std::size_t>(wall)] = wall_xmin;
  EXPECT_THAT(promisesOf(check(sites, x, cells)), Contains("neighbors"));
}

TEST_F(CheckPeriodicCells, FindsCellsOfOtherSites) {
  for (double& x : sites.x) x = 1 - x;
  EXPECT_THAT(broken(), Contains("nearest sites"));
}

TEST_F(CheckPeriodicCells, FindsMovedVerticesAndWrongAreas) {
  const auto right = cells;
  cells.vertices[40].x += 1e-6;
  EXPECT_THAT(broken(), Contains("symmetry"));
  cells = right;
  cells.area[7] *= 1 + 1e-8;
  EXPECT_THAT(broken(), Contains("areas"));
}

TEST(DiffIds, KnowsBisectorsAcrossTheBorder) {
  // Sites at 0.1 and 0.8 meet at 0.45 and, across the border, at 0.95: the center of column 9 of 10.
  const Sites sites{{0.1, 0.8}, {0.5, 0.5}, {}};
  std::vector<std::uint32_t> a(100), b(100);
  for (std::size_t pixel = 0; pixel < 100; ++pixel) {
    const auto column = pixel % 10;
    a[pixel] = column < 5 || column == 9 ? 0 : 1;
    b[pixel] = column < 5 ? 0 : 1;
  }
  const auto periodic = diffIds(a, b, 10, 10, sites, unit, Periodic::x);
  ASSERT_TRUE(periodic);
  EXPECT_EQ(periodic->ties, 10u);
  EXPECT_TRUE(periodic->agree());
  EXPECT_EQ(diffIds(a, b, 10, 10, sites, unit)->wrong, 10u);
  EXPECT_EQ(diffIds(a, b, 10, 10, sites, unit, Periodic::y)->wrong, 10u);
  b[3] = 1;
  EXPECT_EQ(diffIds(a, b, 10, 10, sites, unit, Periodic::x)->wrong, 1u);
}

TEST(DiffCells, TellsImagesOfANeighborApart) {
  const auto sites = generate(Pattern::random, 20, 1);
  const auto a = cellsOf(sites, periodicCells());
  auto b = a;
  EXPECT_TRUE(diffCells(a, b)->agree());
  b.neighbor_shifts[5][1] += 1;
  EXPECT_EQ(diffCells(a, b)->neighbors, 1u);
}

}  // namespace
}  // namespace vorpipe::test

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <tuple>

#include "sites/images.h"
#include "unit/fixtures/periodic_runs.h"

namespace vorpipe::test {

using namespace core;

namespace {

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

/// Whatever the rounding of its ends: the one below is not the other one, but a period from it.
TEST(PeriodicAxis, HasOnePlaceForBothEnds) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> end(-1, 1);
  for (int k = 0; k < 1000; ++k) {
    const auto [low, high] = std::minmax({end(random), end(random)});
    const PeriodicAxis axis(low, high, true);
    EXPECT_EQ(axis.put(low).place, axis.put(high).place) << low << " to " << high;
  }
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

TEST(Wrapped, HasBothEndsOfADomainThatEndsAHairFromAnAxis) {
  for (const double end : {-1e-100, -1e-180, -1e-300}) {
    const auto ends = *wrapped({{0, 0}, {-0.5, end}, {}}, {0, -0.5, 1, end}, Periodic::y);
    EXPECT_EQ(ends.y, (std::vector<double>{-0.5, 0})) << end;
  }
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

/// What cells and pictures say of sites that they refuse, which is the same.
std::string refusalOf(const Sites& sites, Periodic periodic, const Box& domain = unit) {
  auto wanted = periodicCells(periodic);
  wanted.domain = domain;
  RenderOptions picture{};
  picture.domain = domain;
  picture.periodic = periodic;
  picture.width = picture.height = 4;
  auto session = cpuSession();
  const auto cells = session.cells(sites, wanted);
  const auto rendering = session.render(sites, picture);
  if (cells || rendering) return "accepted";
  EXPECT_EQ(cells.error().message, rendering.error().message);
  EXPECT_EQ(cells.error().code, ErrorCode::input);
  return cells.error().message;
}

TEST(PeriodicRefusals, NameTheCallersSites) {
  const double near = 1e-26;
  EXPECT_THAT(refusalOf({{0.5, 0.25, 0.25}, {0.5, near, 0}, {}}, Periodic::x),
              testing::StartsWith("sites 1 and 2: 0.25, 1e-26 and 0.25, 0 are not equal"));
  EXPECT_THAT(refusalOf({{0.7, 1.25, 0.25}, {0.5, near, 0}, {}}, Periodic::x),
              testing::StartsWith("sites 1 and 2: 1.25, 1e-26 and 0.25, 0 are not equal"));
  EXPECT_EQ(refusalOf({{0.5, 0}, {0.5, 1e300}, {}}, Periodic::x),
            "site 1 is too far from the domain: 0, 1e+300");
  EXPECT_EQ(refusalOf({{0.5, 0}, {0.5, INFINITY}, {}}, Periodic::x), "site 1 is not finite: 0, inf");
  EXPECT_EQ(refusalOf({{0.5, 0}, {0.5, 0}, {0, 1e308}}, Periodic::xy),
            "the weight of site 1 is too large for the domain: 1e+308");
  EXPECT_EQ(refusalOf({{0.5, 0}, {0.5, 0}, {0, NAN}}, Periodic::xy),
            "the weight of site 1 is not finite: nan");
  EXPECT_THAT(refusalOf({{0.1}, {0.1}, {}}, Periodic::y, {0, 1, 1, 0}), testing::StartsWith("the domain "));
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
    for (const std::uint64_t n : {1u, 2u, 5u, 100u}) {
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
  EXPECT_EQ(sitesAndImages(many, unit, Periodic::none, ImagesFor::cells), 100'000u);
  const auto count = sitesAndImages(many, unit, Periodic::xy, ImagesFor::cells).value_or(0);
  EXPECT_GT(count, 101'000u);
  EXPECT_LT(count, 115'000u);
  EXPECT_EQ(sitesAndImages({{0.5}, {0.5}, {}}, unit, Periodic::xy, ImagesFor::cells), 9u);
  EXPECT_EQ(sitesAndImages({{0.5}, {0.5}, {}}, unit, Periodic::y, ImagesFor::cells), 3u);
  EXPECT_FALSE(sitesAndImages({}, unit, Periodic::y, ImagesFor::cells));
  const auto fewer = sitesAndImages(many, unit, Periodic::xy, ImagesFor::pictures).value_or(0);
  EXPECT_GT(fewer, 100'000u);
  EXPECT_LT(fewer, count);
  EXPECT_EQ(fewer, 100'000 + withImages(placed(many), bandForPlaces(placed(many), 1)).images.size());
}

TEST(Band, StaysThinWhereAFewSitesAreHeavy) {
  auto sites = generate(Pattern::random, 10'000, 8);
  sites.weight.assign(10'000, 0);
  for (const std::size_t i : {5u, 77u}) sites.weight[i] = 0.3;
  const auto band = likelyBandForCells(placed(sites), 1);
  EXPECT_EQ(band.heavy, (std::vector<std::uint32_t>{5, 77}));
  EXPECT_LT(band.width[0], 0.1);
}

}  // namespace
}  // namespace vorpipe::test

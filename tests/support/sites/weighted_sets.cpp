#include <algorithm>
#include <cmath>

#include "support/sites/data_set_makers.h"
#include "support/sites/site_shapes.h"
#include "support/sites/weighted_sites.h"

namespace vorpipe::test {
namespace {

using N = std::uint64_t;

template <Pattern pattern, int most_in_thousandths>
DataSet ofPattern(N n, Random& random) {
  return inUnit(withRandomWeights(generate(pattern, n, random()), 0, most_in_thousandths * 1e-3, random));
}

/// All but a few weigh at most the square of the mean spacing.
template <class Weigh>
DataSet withHeavy(N n, N heavy, Random& random, const Weigh& weigh) {
  auto sites = withRandomWeights(randomSites(n, random), 0, 1, random);
  for (N i = 0; i < std::min<N>(heavy, sites.size()); ++i) sites.weight[i] = weigh();
  return inUnit(std::move(sites));
}

/// The weight of a disk, whose radius is at most that of one with the mean cell's area.
Sites disks(N n, Random& random) {
  const double largest = std::sqrt(1 / (3.14 * static_cast<double>(n)));
  return weighted(randomSites(n, random), [&](std::size_t) {
    const double radius = largest * random.uniform();
    return radius * radius;
  });
}

/// In whole numbers of 2^-30, so that a number added to all is added exactly.
Sites dyadic(N n, Random& random) {
  return weighted(randomSites(n, random), [&](std::size_t) {
    return std::round(0x1p30 * random.uniform() / static_cast<double>(n)) * 0x1p-30;
  });
}

Sites plus(Sites sites, double number) {
  for (auto& weight : sites.weight) weight += number;
  return sites;
}

/// The diagram of other places: each weight moves it along.
Sites slope(N n, double steepness, Random& random) {
  const auto sites = randomSites(n, random);
  return weighted(sites, [&](std::size_t i) { return steepness * sites.x[i]; });
}

/// Sites on a line, of weights that are whole squares of its steps.
template <int step_x, int step_y>
DataSet onLine(N n, Random& random) {
  const auto sites = collinear(n, step_x, step_y, random);
  return inUnit(
      weighted(sites, [&](std::size_t) { return static_cast<double>(random.below(1 << 16)) * 0x1p-36; }));
}

DataSet inLayers(N n, Random& random) {
  auto sites = mapped(randomSites(n, random), 3, -1.3, -0.7);
  const double square = 9 / static_cast<double>(n);
  return {{}, weighted(std::move(sites), [&](std::size_t) { return 20 * square * random.uniform(); }), unit};
}

}  // namespace

const std::vector<Maker>& weightedMakers() {
  static const std::vector<Maker> all{
      {{"towns", "degrees and inhabitants: clustered, heavy-tailed, coincident sites of any weights"},
       [](N n, Random& r) { return inItsBox(populatedTowns(n, r)); }},
      {{"stars", "degrees and brightness: heavy-tailed, decimals"},
       [](N n, Random& r) { return inItsBox(brightStars(n, r)); }},
      {{"weights-like", "nearly equal weights"}, ofPattern<Pattern::random, 1>},
      {{"weights-1", "weights up to the mean spacing squared"}, ofPattern<Pattern::random, 1000>},
      {{"weights-100", "up to 100 times that: most sites are hidden"}, ofPattern<Pattern::random, 100000>},
      {{"weights-10000", "10,000 times: nearly all are"}, ofPattern<Pattern::random, 10000000>},
      {{"weighted-clusters", "normal clusters, the dense ones hidden"}, ofPattern<Pattern::clusters, 1000>},
      {{"weighted-lattice", "a square lattice, random weights"}, ofPattern<Pattern::square, 500>},
      {{"weighted-circle", "cells as long as thin, of sites on a circle"},
       [](N n, Random& r) {
         return inUnit(withRandomWeights(generate(Pattern::circle, n, 1), 0, 1 / static_cast<double>(n), r));
       }},
      {{"weighted-curves", "along curves, where a little weight hides many"},
       [](N n, Random& r) {
         return inUnit(withRandomWeights(curves(n, r), 0, 10 / static_cast<double>(n), r));
       }},
      {{"weighted-crowd", "99 % of the sites in 1 % of the area, and heavier outside"},
       [](N n, Random& r) { return inUnit(withRandomWeights(crowded(n, r), 0, 1, r)); }},
      {{"weighted-dust", "a cluster 1e-9 wide, of which weights leave a few sites"},
       [](N n, Random& r) {
         const auto sites = dust(n, r);
         return inUnit(
             weighted(sites, [&](std::size_t i) { return (i % 2 == 0 ? 1e-4 : 1e-20) * r.uniform(); }));
       }},
      {{"unequal-pairs", "pairs 1e-12 of the domain apart, one of them hidden or hardly"},
       [](N n, Random& r) { return inUnit(unequalPairs(n, r)); }},
      {{"disks", "radii, with columns of two"}, [](N n, Random& r) { return inUnit(disks(n, r)); }},
      {{"one-swallows-all", "all sites hidden but one"},
       [](N n, Random& r) { return withHeavy(n, 1, r, [] { return 1e3; }); }},
      {{"two-giants", "all sites hidden but two"},
       [](N n, Random& r) { return withHeavy(n, 2, r, [&] { return 1e3 + r.uniform(); }); }},
      {{"ten-heavy", "a tenth of the domain for each of a few"},
       [](N n, Random& r) { return withHeavy(n, 10, r, [&] { return 0.02 + 0.05 * r.uniform(); }); }},
      {{"fifty-heavy", "more of them than are tried everywhere"},
       [](N n, Random& r) { return withHeavy(n, 50, r, [&] { return 0.01 * r.uniform(); }); }},
      {{"equal-weights", "those of the Voronoi diagram"},
       [](N n, Random& r) { return inUnit(weighted(randomSites(n, r), [](std::size_t) { return 0.7; })); }},
      {{"negative-weights", "none above zero"},
       [](N n, Random& r) { return inUnit(withRandomWeights(randomSites(n, r), -5, -1, r)); }},
      {{"offset-weights", "a million domains added to each"},
       [](N n, Random& r) { return inUnit(plus(dyadic(n, r), 1e6)); }},
      {{"rounded-weights", "a number added that leaves of each a few bits: many are equal"},
       [](N n, Random& r) { return inUnit(plus(dyadic(n, r), 0x1p40)); }},
      {{"slope", "cells half a domain from their sites"},
       [](N n, Random& r) { return inUnit(slope(n, 0.8, r)); }},
      {{"steep-slope", "all sites hidden but those that come from far"},
       [](N n, Random& r) { return inUnit(slope(n, 2.5, r)); }},
      {{"chessboard", "a square lattice of two weights: squares in octagons"},
       [](N n, Random&) { return inItsBox(chessboard(n, 1)); }},
      {{"chessboard-verge", "the lighter ones exactly on the verge of being hidden"},
       [](N n, Random&) { return inItsBox(chessboard(n, 4)); }},
      {{"chessboard-touching", "cells that meet in points as well"},
       [](N n, Random&) { return inItsBox(chessboard(n, 2)); }},
      {{"three-weights", "a hexagonal lattice of three weights"},
       [](N n, Random&) { return inUnit(threeWeights(n)); }},
      {{"verge", "integers: hidden by the last bit, or not, or on the verge"},
       [](N n, Random& r) { return inItsBox(onTheVerge(n, r)); }},
      {{"flattened", "a lattice with its corners' cells alone, all others on the verge"},
       [](N n, Random&) { return inItsBox(flattened(n)); }},
      {{"flattened-turned", "the same but for rounding"},
       [](N n, Random& r) {
         const auto sites = randomSites(n, r);
         return inUnit(weighted(
             sites, [&](std::size_t i) { return sites.x[i] * sites.x[i] + sites.y[i] * sites.y[i]; }));
       }},
      {{"weighted-row", "collinear, level, coincident ones of several weights"}, onLine<2, 0>},
      {{"weighted-diagonal", "collinear, aslant"}, onLine<3, 2>},
      {{"weighted-concentric", "integers on circles, all of one circle with one weight"},
       [](N n, Random& r) {
         const auto sites = shuffled(concentric(n), r);
         return inItsBox(weighted(
             sites, [&](std::size_t i) { return (sites.x[i] * sites.x[i] + sites.y[i] * sites.y[i]) / 2; }));
       }},
      {{"moved-circle", "integers on a circle that weights move: all cells meet in one point"},
       [](N n, Random& r) {
         const auto sites = shuffled(pythagorean(n, 1), r);
         return inItsBox(weighted(sites, [&](std::size_t i) { return sites.x[i] * 100 - sites.y[i] * 37; }));
       }},
      {{"layers", "most sites outside of the domain, some of them heavy"}, inLayers},
      {{"far-heavy", "no site in the domain"},
       [](N n, Random& r) {
         return inUnit(mapped(withRandomWeights(randomSites(n, r), 0, 20, r), 1, 5, -3));
       }},
      {{"tiny-weights", "coordinates of 1e-60"},
       [](N n, Random& r) {
         return DataSet{{},
                        mapped(withRandomWeights(randomSites(n, r), 0, 2, r), 1e-60, 0, 0),
                        mapped(unit, 1e-60, 0, 0)};
       }},
      {{"huge-weights", "coordinates of 1e60"},
       [](N n, Random& r) {
         return DataSet{
             {}, mapped(withRandomWeights(randomSites(n, r), 0, 2, r), 1e60, 0, 0), mapped(unit, 1e60, 0, 0)};
       }},
      {{"two-weights", "two sites"},
       [](N, Random& r) { return inUnit(withRandomWeights(randomSites(2, r), 0, 0.5, r)); }},
  };
  return all;
}

}  // namespace vorpipe::test

#include "support/sites/data_sets.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "support/sites/data_set_makers.h"
#include "support/sites/site_shapes.h"

namespace vorpipe::test {

namespace {

Sites withCenter(Sites sites) {
  add(sites, {0.5, 0.5});
  return sites;
}

template <Pattern pattern>
DataSet ofPattern(std::uint64_t n, Random& random) {
  return inUnit(generate(pattern, n, random()));
}

/// A square lattice in a domain that cuts it along its bisectors.
DataSet latticeCutAtBisectors(std::uint64_t n, Random&) {
  auto sites = generate(Pattern::square, n, 1);
  const auto side = std::sqrt(static_cast<double>(sites.size()));
  return {{}, std::move(sites), {1 / side, 2 / side, (side - 2) / side, (side - 1) / side}};
}

DataSet turnedLattice(std::uint64_t n, Random&) {
  auto sites = generate(Pattern::square, n, 1);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const double x = sites.x[i];
    sites.x[i] = 0.8 * x - 0.6 * sites.y[i];
    sites.y[i] = 0.6 * x + 0.8 * sites.y[i];
  }
  return {{}, std::move(sites), {-0.3, 0.2, 0.5, 1.1}};
}

DataSet scaled(double scale, std::uint64_t n, Random& random) {
  return {{}, mapped(randomSites(n, random), scale, 0, 0), mapped(unit, scale, 0, 0)};
}

/// Eastings and northings in meters, to the millimeter.
DataSet utm(std::uint64_t n, Random& random) {
  Sites sites;
  for (std::uint64_t i = 0; i < n; ++i) {
    add(sites,
        {5e5 + std::round(2e6 * random.uniform()) / 1e3, 5e6 + std::round(2e6 * random.uniform()) / 1e3});
  }
  return {{}, std::move(sites), {5e5, 5e6, 502e3, 5002e3}};
}

const std::vector<Maker>& makers() {
  using N = std::uint64_t;
  static const std::vector<Maker> all{
      {{"random", "white noise"}, ofPattern<Pattern::random>},
      {{"jitter", "nearly a lattice"}, ofPattern<Pattern::jitter>},
      {{"clusters", "normal clusters"}, ofPattern<Pattern::clusters>},
      {{"square", "four cells meet in each vertex"}, ofPattern<Pattern::square>},
      {{"hex", "equal cells"}, ofPattern<Pattern::hex>},
      {{"circle", "all cells nearly meet in one point"}, ofPattern<Pattern::circle>},
      {{"circle-center", "one cell with all others as neighbors"},
       [](N n, Random&) { return inUnit(withCenter(generate(Pattern::circle, n - 1, 1))); }},
      {{"square-shifted", "a lattice whose ties rounding breaks"},
       [](N n, Random&) {
         return DataSet{{}, mapped(generate(Pattern::square, n, 1), 0.7, 0.1, 0.3), {0.1, 0.3, 0.8, 1}};
       }},
      {{"square-turned", "a lattice along no axis, cropped"}, turnedLattice},
      {{"square-cut", "walls that are bisectors"}, latticeCutAtBisectors},
      {{"board", "drill holes: few distinct x, equal steps"},
       [](N n, Random& r) { return inItsBox(circuitBoard(n, r)); }},
      {{"zip-codes", "decimals, a fifth duplicates, clustered"},
       [](N n, Random& r) { return inItsBox(zipCodes(n, r)); }},
      {{"airports", "degrees, clustered, with duplicates"},
       [](N n, Random& r) { return inItsBox(airports(n, r)); }},
      {{"spiral", "long thin cells along a curve"}, [](N n, Random&) { return inUnit(spiral(n)); }},
      {{"sunflower", "near ties everywhere"}, [](N n, Random&) { return inUnit(sunflower(n)); }},
      {{"curves", "long thin cells, a grid mostly empty"},
       [](N n, Random& r) { return inUnit(curves(n, r)); }},
      {{"crowded", "99 % of the sites in 1 % of the area"},
       [](N n, Random& r) { return inUnit(crowded(n, r)); }},
      {{"tight-clusters", "100 clusters 1e-4 wide"},
       [](N n, Random& r) { return inUnit(tightClusters(n, r)); }},
      {{"dust", "a cluster 1e-9 wide beside one spread over the domain"},
       [](N n, Random& r) { return inUnit(dust(n, r)); }},
      {{"pairs", "pairs 1e-12 of the domain apart"}, [](N n, Random& r) { return inUnit(pairs(n, r)); }},
      {{"stripes", "a row of sites 1e-12 of the domain apart"},
       [](N n, Random& r) { return inUnit(stripes(n, r)); }},
      {{"line-1e-12", "collinear but for 1e-12"},
       [](N n, Random& r) { return inUnit(nearlyCollinear(n, 1e-12, r)); }},
      {{"line-1e-9", "collinear but for 1e-9"},
       [](N n, Random& r) { return inUnit(nearlyCollinear(n, 1e-9, r)); }},
      {{"line-1e-6", "collinear but for 1e-6"},
       [](N n, Random& r) { return inUnit(nearlyCollinear(n, 1e-6, r)); }},
      {{"line-1e-3", "collinear but for 1e-3"},
       [](N n, Random& r) { return inUnit(nearlyCollinear(n, 1e-3, r)); }},
      {{"row", "exactly collinear, level, duplicates"},
       [](N n, Random& r) { return inUnit(collinear(n, 2, 0, r)); }},
      {{"column", "exactly collinear, upright, duplicates"},
       [](N n, Random& r) { return inUnit(collinear(n, 0, 2, r)); }},
      {{"diagonal", "exactly collinear, aslant, duplicates"},
       [](N n, Random& r) { return inUnit(collinear(n, 3, 2, r)); }},
      {{"pythagorean", "integers, exactly cocircular"},
       [](N n, Random& r) { return inItsBox(shuffled(pythagorean(n, 1), r)); }},
      {{"concentric", "integers on circles about one center"},
       [](N n, Random& r) { return inItsBox(shuffled(concentric(n), r)); }},
      {{"concentric-center", "the same with their center"},
       [](N n, Random& r) {
         auto sites = concentric(n);
         add(sites, {0, 0});
         return inItsBox(shuffled(std::move(sites), r));
       }},
      {{"cropped", "most sites outside of the domain"},
       [](N n, Random& r) {
         return DataSet{{}, mapped(randomSites(n, r), 3, -1.3, -0.7), unit};
       }},
      {{"far", "no site in the domain"},
       [](N n, Random& r) { return inUnit(mapped(randomSites(n, r), 1, 5, -3)); }},
      {{"utm", "large offsets"}, utm},
      {{"tiny", "coordinates of 1e-150"}, [](N n, Random& r) { return scaled(1e-150, n, r); }},
      {{"huge", "coordinates of 1e150"}, [](N n, Random& r) { return scaled(1e150, n, r); }},
      {{"one", "one site"}, [](N, Random& r) { return inUnit(randomSites(1, r)); }},
      {{"two", "two sites"}, [](N, Random& r) { return inUnit(randomSites(2, r)); }},
      {{"walls", "sites on walls and in corners"}, [](N n, Random& r) { return inUnit(onWalls(n, r)); }},
      {{"mirrored", "vertices of four cells on two axes"},
       [](N n, Random& r) { return inUnit(mirrored(n, r)); }},
      {{"mirrored-half", "the same, with walls on the axes"},
       [](N n, Random& r) {
         return DataSet{{}, mirrored(n, r), {0.5, 0.5, 1, 1}};
       }},
      {{"mirrored-at-walls", "bisectors that are walls"},
       [](N n, Random& r) { return inUnit(mirroredAtWalls(n, r)); }},
  };
  return all;
}

std::vector<DataSetKind> kindsOf(const std::vector<Maker>& makers) {
  std::vector<DataSetKind> kinds;
  for (const auto& maker : makers) kinds.push_back(maker.kind);
  return kinds;
}

}  // namespace

const std::vector<DataSetKind>& dataSetKinds() {
  static const auto kinds = kindsOf(makers());
  return kinds;
}

const std::vector<DataSetKind>& weightedSetKinds() {
  static const auto kinds = kindsOf(weightedMakers());
  return kinds;
}

DataSet makeDataSet(std::string_view name, std::uint64_t n, std::uint64_t seed) {
  for (const auto* all : {&makers(), &weightedMakers()}) {
    for (const auto& maker : *all) {
      if (maker.kind.name != name) continue;
      Random random(seed);
      auto set = maker.make(n, random);
      set.name = name;
      return set;
    }
  }
  throw std::invalid_argument("no data set is called " + std::string(name));
}

Box boxAround(const Sites& sites) {
  const auto [left, right] = std::minmax_element(sites.x.begin(), sites.x.end());
  const auto [bottom, top] = std::minmax_element(sites.y.begin(), sites.y.end());
  const double longer = std::max(*right - *left, *top - *bottom);
  const double margin = longer > 0 ? 0.05 * longer : 0.5;
  return {*left - margin, *bottom - margin, *right + margin, *top + margin};
}

}  // namespace vorpipe::test

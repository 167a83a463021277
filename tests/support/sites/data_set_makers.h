/// How data sets are made: what makeDataSet looks up names in.
#pragma once

#include <utility>
#include <vector>

#include "support/sites/data_sets.h"
#include "support/sites/random_sites.h"
#include "support/sites/unit.h"

namespace vorpipe::test {

struct Maker {
  DataSetKind kind;
  DataSet (*make)(std::uint64_t n, Random& random);
};

/// Those of weightedSetKinds().
const std::vector<Maker>& weightedMakers();

inline DataSet inUnit(Sites sites) { return {{}, std::move(sites), unit}; }

inline DataSet inItsBox(Sites sites) {
  const Box box = boxAround(sites);
  return {{}, std::move(sites), box};
}

inline Sites randomSites(std::uint64_t n, Random& random) { return generate(Pattern::random, n, random()); }

/// Places times `scale`, moved by (x, y); weights times its square.
inline Sites mapped(Sites sites, double scale, double x, double y) {
  for (auto& value : sites.x) value = x + scale * value;
  for (auto& value : sites.y) value = y + scale * value;
  for (auto& value : sites.weight) value *= scale * scale;
  return sites;
}

inline Box mapped(const Box& box, double scale, double x, double y) {
  return {x + scale * box.xmin, y + scale * box.ymin, x + scale * box.xmax, y + scale * box.ymax};
}

}  // namespace vorpipe::test

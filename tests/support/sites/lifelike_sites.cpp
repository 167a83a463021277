#include <algorithm>
#include <cmath>

#include "support/sites/site_shapes.h"

namespace vorpipe::test {
namespace {

double rounded(double value, int digits) {
  const double scale = std::pow(10, digits);
  return std::round(value * scale) / scale;
}

/// Towns in a box: sites are drawn around them, more of them around the first.
class Towns {
 public:
  Towns(std::size_t count, const Box& box, Random& random) : box_(box) {
    for (std::size_t i = 0; i < count; ++i) {
      add(centers_, {box.xmin + (box.xmax - box.xmin) * random.uniform(),
                     box.ymin + (box.ymax - box.ymin) * random.uniform()});
    }
  }
  Point draw(Random& random) const {
    const double rank = random.uniform();
    const auto town = static_cast<std::size_t>(rank * rank * rank * static_cast<double>(centers_.size()));
    const double spread = 0.05 + 2 * rank;
    return {std::clamp(centers_.x[town] + spread * random.normal(), box_.xmin, box_.xmax),
            std::clamp(centers_.y[town] + spread * random.normal(), box_.ymin, box_.ymax)};
  }

 private:
  Box box_;
  Sites centers_;
};

}  // namespace

Sites circuitBoard(std::uint64_t n, Random& random) {
  const auto columns = std::clamp<std::uint64_t>(881 * n / 5000, 8, 881);
  Sites sites;
  double x = 1000;
  for (std::uint64_t column = 0; column < columns; ++column) {
    x += 12.5 * static_cast<double>(1 + random.below(2) * random.below(4));
    const auto begin = n * column / columns;
    const auto end = n * (column + 1) / columns;
    double y = 1000 + 25 * static_cast<double>(random.below(100));
    for (auto i = begin; i < end; ++i) {
      y += random.below(8) == 0 ? 25 * static_cast<double>(1 + random.below(300)) : 50;
      add(sites, {x, y});
    }
  }
  return sites;
}

Sites zipCodes(std::uint64_t n, Random& random) {
  const Towns towns(300, {-124.5, 25, -67, 49}, random);
  Sites sites;
  for (std::uint64_t i = 0; i < n; ++i) {
    if (i > 0 && random.below(5) == 0) {
      const auto again = random.below(i);
      add(sites, {sites.x[again], sites.y[again]});
      continue;
    }
    const auto place = towns.draw(random);
    const int digits = 4 + static_cast<int>(random.below(3));
    add(sites, {rounded(place.x, digits), rounded(place.y, digits)});
  }
  return sites;
}

Sites airports(std::uint64_t n, Random& random) {
  const Towns dense(400, {-125, 25, 40, 60}, random);
  Sites sites;
  for (std::uint64_t i = 0; i < n; ++i) {
    const auto kind = random.below(50);
    if (kind == 0 && i > 0) {
      const auto again = random.below(i);
      add(sites, {sites.x[again], sites.y[again]});
      continue;
    }
    const auto place =
        kind < 30 ? dense.draw(random) : Point{360 * random.uniform() - 180, 170 * random.uniform() - 85};
    if (kind % 3 == 0) {
      add(sites, {std::round(place.x * 60) / 60, std::round(place.y * 60) / 60});
    } else {
      add(sites, {rounded(place.x, 6), rounded(place.y, 6)});
    }
  }
  return sites;
}

}  // namespace vorpipe::test

#include "support/sites/weighted_sites.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "support/sites/site_shapes.h"

namespace vorpipe::test {
namespace {

/// A square lattice of about n sites, `step` apart; weigh(column, row) are their weights.
template <class Weigh>
Sites lattice(std::uint64_t n, std::uint64_t step, const Weigh& weigh) {
  const auto side = static_cast<std::uint64_t>(std::sqrt(static_cast<double>(n)));
  Sites sites;
  for (std::uint64_t row = 0; row < side; ++row) {
    for (std::uint64_t column = 0; column < side; ++column) {
      add(sites, {static_cast<double>(step * column), static_cast<double>(step * row)});
      sites.weight.push_back(weigh(column, row));
    }
  }
  return sites;
}

}  // namespace

Sites withRandomWeights(Sites sites, double least, double most, Random& random) {
  const double square = 1 / static_cast<double>(sites.size());
  return weighted(std::move(sites),
                  [&](std::size_t) { return square * (least + (most - least) * random.uniform()); });
}

Sites populatedTowns(std::uint64_t n, Random& random) {
  Sites sites = airports(n, random);
  constexpr double inhabitants_of_a_square_degree = 2e5;
  for (std::size_t i = 1; i < sites.size(); ++i) {
    if (random.below(10) != 0) continue;
    const auto same = random.below(i);
    sites.x[i] = sites.x[same];
    sites.y[i] = sites.y[same];
  }
  return weighted(std::move(sites), [&](std::size_t) {
    const double inhabitants = std::floor(500 / (random.uniform() + 2e-5));
    return (random.below(20) == 0 ? 1000 : inhabitants) / inhabitants_of_a_square_degree;
  });
}

Sites brightStars(std::uint64_t n, Random& random) {
  Sites sites;
  for (std::uint64_t i = 0; i < n; ++i) {
    const double declination = std::asin(2 * random.uniform() - 1) * 180 / std::numbers::pi;
    add(sites, {std::round(360e4 * random.uniform()) / 1e4, std::round(declination * 1e4) / 1e4});
  }
  const double faintest = std::log(static_cast<double>(n)) / std::log(3.0) - 1;
  return weighted(std::move(sites), [&](std::size_t) {
    const double magnitude = faintest + std::log(random.uniform() + 0x1p-53) / std::log(3.0);
    return std::pow(100, -std::round(100 * magnitude) / 100 / 5) * 50;
  });
}

Sites onTheVerge(std::uint64_t n, Random& random) {
  constexpr std::uint64_t side = 64;
  const auto squares =
      std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::sqrt(static_cast<double>(n) / 2)));
  Sites sites;
  const auto put = [&](double x, double y, double weight) {
    add(sites, {x, y});
    sites.weight.push_back(weight);
  };
  for (std::uint64_t row = 0; row < squares; ++row) {
    for (std::uint64_t column = 0; column < squares; ++column) {
      const auto x = static_cast<double>(column * side);
      const auto y = static_cast<double>(row * side);
      put(x, y, 0);
      const auto dx = static_cast<double>(random.below(side - 1) + 1);
      const auto dy = static_cast<double>(random.below(side - 1) + 1);
      // With 0 for the corners of the square, the power of its site is on the plane of theirs.
      const double verge = dx * dx + dy * dy - side * (dx + dy);
      constexpr std::array<double, 7> off{0, 0, 0, 0x1p-36, -0x1p-36, 0x1p-6, -0x1p-6};
      put(x + dx, y + dy, verge + off[random.below(off.size())]);
    }
  }
  return sites;
}

Sites flattened(std::uint64_t n) {
  return lattice(n, 1, [](std::uint64_t column, std::uint64_t row) {
    return static_cast<double>(column * column + row * row);
  });
}

Sites chessboard(std::uint64_t n, double lighter) {
  return lattice(n, 2, [lighter](std::uint64_t column, std::uint64_t row) {
    return (column + row) % 2 == 0 ? 0 : -lighter;
  });
}

Sites threeWeights(std::uint64_t n) {
  Sites sites = generate(Pattern::hex, n, 1);
  const double square = 1 / static_cast<double>(n);
  return weighted(std::move(sites), [&](std::size_t i) { return 0.3 * square * static_cast<double>(i % 3); });
}

Sites unequalPairs(std::uint64_t n, Random& random) {
  return weighted(pairs(n, random), [&](std::size_t) {
    constexpr std::array<double, 4> most{0, 1e-24, 1e-18, 1e-6};
    return most[random.below(most.size())] * random.uniform();
  });
}

}  // namespace vorpipe::test

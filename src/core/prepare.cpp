#include "core/prepare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "parallel.h"

namespace vorpipe {
namespace {

constexpr std::size_t grain = 1 << 16;
constexpr int farthest_exponent = 300;
constexpr int fewest_neighbors = 3;
constexpr int most_neighbors = 1024;

tl::unexpected<Error> refuse(std::string message) {
  return tl::unexpected(Error{ErrorCode::input, std::move(message)});
}

Result<void> checkDomain(const Box& domain) {
  const bool finite = std::isfinite(domain.xmin) && std::isfinite(domain.ymin) &&
                      std::isfinite(domain.xmax) && std::isfinite(domain.ymax) &&
                      std::isfinite(domain.xmax - domain.xmin) && std::isfinite(domain.ymax - domain.ymin);
  if (!finite || !(domain.xmin < domain.xmax) || !(domain.ymin < domain.ymax)) {
    return refuse(fmt::format("the domain {},{},{},{} is not a rectangle with xmin < xmax and ymin < ymax",
                              domain.xmin, domain.ymin, domain.xmax, domain.ymax));
  }
  return {};
}

/// The power of two that brings the domain's longer side into [1, 2).
int scaleExponent(const Box& domain) {
  int exponent = 0;
  std::frexp(std::max(domain.xmax - domain.xmin, domain.ymax - domain.ymin), &exponent);
  return 1 - exponent;
}

Result<void> checkSites(const Sites& sites, int exponent) {
  if (sites.size() == 0) return refuse("there are no sites");
  if (sites.y.size() != sites.size() || (!sites.weight.empty() && sites.weight.size() != sites.size())) {
    return refuse("x, y and weight differ in length");
  }
  if (sites.size() >= no_site) return refuse(fmt::format("{} sites are more than 4294967294", sites.size()));
  const double limit = std::ldexp(1.0, farthest_exponent - exponent);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (!std::isfinite(sites.x[i]) || !std::isfinite(sites.y[i])) {
      return refuse(fmt::format("site {} is not finite: {}, {}", i, sites.x[i], sites.y[i]));
    }
    if (std::abs(sites.x[i]) > limit || std::abs(sites.y[i]) > limit) {
      return refuse(fmt::format("site {} is too far from the domain: {}, {}", i, sites.x[i], sites.y[i]));
    }
  }
  return {};
}

/// The place of cell (x, y) of a 2^32 x 2^32 grid on the Hilbert curve.
std::uint64_t hilbertPlace(std::uint32_t x, std::uint32_t y) {
  std::uint64_t place = 0;
  for (std::uint32_t side = 1u << 31; side > 0; side >>= 1) {
    const std::uint32_t right = (x & side) ? 1 : 0;
    const std::uint32_t up = (y & side) ? 1 : 0;
    place = (place << 2) | ((3 * right) ^ up);
    if (up == 0) {
      if (right == 1) {
        x = ~x;
        y = ~y;
      }
      std::swap(x, y);
    }
  }
  return place;
}

struct Extent {
  double low, scale;
  [[nodiscard]] std::uint32_t place(double value) const {
    return static_cast<std::uint32_t>(std::min((value - low) * scale, 4294967295.0));
  }
};

Extent extentOf(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return {*low, *high > *low ? 4294967295.0 / (*high - *low) : 0.0};
}

struct Placed {
  std::uint64_t place;
  std::uint32_t index;
};

/// Input indices along the curve; equal positions stand together, the lowest index first.
std::vector<Placed> orderAlongCurve(const Sites& sites, int threads) {
  std::vector<Placed> order(sites.size());
  const auto x = extentOf(sites.x);
  const auto y = extentOf(sites.y);
  parallelFor(order.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      order[i] = {hilbertPlace(x.place(sites.x[i]), y.place(sites.y[i])), static_cast<std::uint32_t>(i)};
    }
  });
  std::sort(order.begin(), order.end(), [&](const Placed& a, const Placed& b) {
    if (a.place != b.place) return a.place < b.place;
    if (sites.x[a.index] != sites.x[b.index]) return sites.x[a.index] < sites.x[b.index];
    if (sites.y[a.index] != sites.y[b.index]) return sites.y[a.index] < sites.y[b.index];
    return a.index < b.index;
  });
  return order;
}

}  // namespace

Result<void> checkSearch(const SearchOptions& search) {
  if (search.neighbors >= fewest_neighbors && search.neighbors <= most_neighbors) return {};
  return refuse(
      fmt::format("{} neighbors: must be {} to {}", search.neighbors, fewest_neighbors, most_neighbors));
}

Result<Prepared> prepare(const Sites& sites, const Box& domain, int threads) {
  if (auto checked = checkDomain(domain); !checked) return tl::unexpected(checked.error());
  const int exponent = scaleExponent(domain);
  if (auto checked = checkSites(sites, exponent); !checked) return tl::unexpected(checked.error());

  const auto scaled = [exponent](double value) { return std::ldexp(value, exponent); };
  Prepared prepared;
  prepared.exponent = exponent;
  auto& set = prepared.set;
  set.domain = {scaled(domain.xmin), scaled(domain.ymin), scaled(domain.xmax), scaled(domain.ymax)};
  prepared.owner.resize(sites.size());
  set.x.reserve(sites.size());
  set.y.reserve(sites.size());
  set.id.reserve(sites.size());
  for (const auto& placed : orderAlongCurve(sites, threads)) {
    const auto i = placed.index;
    const auto last = set.id.empty() ? no_site : set.id.back();
    if (last != no_site && sites.x[last] == sites.x[i] && sites.y[last] == sites.y[i]) {
      prepared.owner[i] = last;
      continue;
    }
    prepared.owner[i] = i;
    set.id.push_back(i);
    set.x.push_back(scaled(sites.x[i]));
    set.y.push_back(scaled(sites.y[i]));
  }
  return prepared;
}

}  // namespace vorpipe

#include "core/sites/site_set.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "backend/tie.h"
#include "base/inside.h"
#include "base/parallel.h"
#include "base/refusal.h"
#include "core/sites/bin_sort.h"
#include "core/sites/grid.h"
#include "core/sites/near_sites.h"
#include "core/sites/weights.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t grain = 1 << 16;
constexpr double farthest = 0x1p300;  ///< in domains
/// A neighbor is an index of 32 bits with a sign.
constexpr std::size_t most_sites = std::numeric_limits<std::int32_t>::max();
constexpr double infinite = std::numeric_limits<double>::infinity();

tl::unexpected<Error> refuse(Subject subject, std::string message) {
  return tl::unexpected(refusal(subject, std::move(message)));
}

Result<void> checkDomain(const Box& domain) {
  const bool finite = std::isfinite(domain.xmin) && std::isfinite(domain.ymin) &&
                      std::isfinite(domain.xmax) && std::isfinite(domain.ymax) &&
                      std::isfinite(domain.xmax - domain.xmin) && std::isfinite(domain.ymax - domain.ymin);
  if (!finite || !(domain.xmin < domain.xmax) || !(domain.ymin < domain.ymax)) {
    return refuse(Subject::domain,
                  fmt::format("the domain {},{},{},{} is not a rectangle with xmin < xmax and ymin < ymax",
                              domain.xmin, domain.ymin, domain.xmax, domain.ymax));
  }
  return {};
}

/// What one pass over the sites finds out, in scaled units.
struct Extent {
  Box box{infinite, infinite, -infinite, -infinite};
  std::size_t inside = 0;  ///< sites within the box that was asked about
  bool usable = true;      ///< every coordinate is finite and not too far away

  void add(double x, double y, const Box& near) {
    box = {std::min(box.xmin, x), std::min(box.ymin, y), std::max(box.xmax, x), std::max(box.ymax, y)};
    inside += isInside(near, x, y) ? 1U : 0U;
    usable = usable && std::abs(x) <= farthest && std::abs(y) <= farthest;
  }
  void add(const Extent& other) {
    const auto& b = other.box;
    box = {std::min(box.xmin, b.xmin), std::min(box.ymin, b.ymin), std::max(box.xmax, b.xmax),
           std::max(box.ymax, b.ymax)};
    inside += other.inside;
    usable = usable && other.usable;
  }
};

Extent extentOf(const Sites& sites, const PowerOfTwo& scale, const Box& near, int threads) {
  std::vector<Extent> extents((sites.size() + grain - 1) / grain);
  parallelFor(sites.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
    Extent extent;
    for (auto i = begin; i < end; ++i) extent.add(scale(sites.x[i]), scale(sites.y[i]), near);
    extents[begin / grain] = extent;
  });
  Extent all;
  for (const auto& extent : extents) all.add(extent);
  return all;
}

/// The error of the first site that is not usable; there is one.
Error unusableSite(const Sites& sites, const PowerOfTwo& scale) {
  const auto isUsable = [&](double value) { return std::abs(scale(value)) <= farthest; };
  std::size_t i = 0;
  while (isUsable(sites.x[i]) && isUsable(sites.y[i])) ++i;
  const bool finite = std::isfinite(sites.x[i]) && std::isfinite(sites.y[i]);
  return refusal(Subject::sites,
                 fmt::format("site {} {}: {}, {}", i, finite ? "is too far from the domain" : "is not finite",
                             sites.x[i], sites.y[i]));
}

Error nearSites(const Sites& sites, std::uint32_t a, std::uint32_t b) {
  if (a > b) std::swap(a, b);
  if (a == b) {
    return refusal(Subject::domain,
                   fmt::format("the domain is too narrow: site {} is nearer to its own image than "
                               "{:.0e} of the domain's longer side",
                               a, least_distance));
  }
  return refusal(
      Subject::sites,
      fmt::format("sites {} and {}: {}, {} and {}, {} are not equal, but nearer to each other than {:.0e} of "
                  "the domain's longer side: make them equal, or move one",
                  a, b, sites.x[a], sites.y[a], sites.x[b], sites.y[b], least_distance));
}

Result<void> checkNumber(const Sites& sites) {
  if (sites.size() == 0) return refuse(Subject::sites, "there are no sites");
  if (sites.y.size() != sites.size() || (!sites.weight.empty() && sites.weight.size() != sites.size())) {
    return refuse(Subject::sites, "x, y and weight differ in length");
  }
  if (sites.size() > most_sites)
    return refuse(Subject::sites, fmt::format("{} sites are more than {}", sites.size(), most_sites));
  return {};
}

void dropTiny(std::vector<double>& coordinates, int threads) {
  parallelFor(coordinates.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto i = begin; i < end; ++i) {
      if (std::abs(coordinates[i]) < least_coordinate) coordinates[i] = 0;
    }
  });
}

/// The domain and as much again on every side: farther sites bound few cells, and would make the bins
/// of the others large.
Box surroundings(const Box& domain) {
  const double margin = std::max(domain.xmax - domain.xmin, domain.ymax - domain.ymin);
  return {domain.xmin - margin, domain.ymin - margin, domain.xmax + margin, domain.ymax + margin};
}

/// What the grid covers: the box of the sites, as far as it lies in `near`. Where sites lie beyond,
/// the grid ends outside the domain, so that the bins at its border may hold them: seen from inside
/// the domain, such a site is farther away than its bin.
Box gridBox(const Box& sites, const Box& near) {
  return {std::clamp(sites.xmin, near.xmin, near.xmax), std::clamp(sites.ymin, near.ymin, near.ymax),
          std::clamp(sites.xmax, near.xmin, near.xmax), std::clamp(sites.ymax, near.ymin, near.ymax)};
}

}  // namespace

int scaleExponent(const Box& domain) {
  int exponent = 0;
  std::frexp(std::max(domain.xmax - domain.xmin, domain.ymax - domain.ymin), &exponent);
  return 1 - exponent;
}

Result<void> checkSites(const Sites& sites, const Box& domain, int threads) {
  if (auto checked = checkDomain(domain); !checked) return checked;
  if (auto checked = checkNumber(sites); !checked) return checked;
  const int exponent = scaleExponent(domain);
  const PowerOfTwo scale(exponent);
  if (!extentOf(sites, scale, domain, threads).usable) return tl::unexpected(unusableSite(sites, scale));
  const auto weights = scaledWeights(sites, exponent, threads);
  return weights ? Result<void>{} : tl::unexpected(weights.error());
}

Result<Prepared> prepare(const Sites& sites, const Box& domain, int threads, const CallersSites* callers) {
  if (auto checked = checkDomain(domain); !checked) return tl::unexpected(checked.error());
  if (auto checked = checkNumber(sites); !checked) return tl::unexpected(checked.error());
  Prepared prepared;
  prepared.exponent = scaleExponent(domain);
  const PowerOfTwo scale(prepared.exponent);
  auto& set = prepared.set;
  set.domain = {scale(domain.xmin), scale(domain.ymin), scale(domain.xmax), scale(domain.ymax)};
  if (callers != nullptr) set.shorter_side = scale(shorterSide(callers->domain));
  set.coverage = {-infinite, -infinite, infinite, infinite};

  const auto near = surroundings(set.domain);
  const auto extent = extentOf(sites, scale, near, threads);
  if (!extent.usable) return tl::unexpected(unusableSite(sites, scale));
  const auto weights = scaledWeights(sites, prepared.exponent, threads);
  if (!weights) return tl::unexpected(weights.error());
  set.grid = layGrid(gridBox(extent.box, near), extent.inside);
  orderByBins(sites, scale, threads, set, prepared.owner);
  giveWeights(*weights, threads, set);
  if (const auto near_sites = tooNear(set, threads)) {
    const auto a = set.id[near_sites->first], b = set.id[near_sites->second];
    return tl::unexpected(callers == nullptr
                              ? nearSites(sites, a, b)
                              : nearSites(callers->sites, callers->siteOf(a), callers->siteOf(b)));
  }
  dropTiny(set.x, threads);
  dropTiny(set.y, threads);
  return prepared;
}

}  // namespace vorpipe::core

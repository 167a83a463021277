#include "sites/site_set.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "backend/tie.h"
#include "base/parallel.h"
#include "base/refusal.h"
#include "base/try.h"
#include "sites/bin_sort.h"
#include "sites/frame.h"
#include "sites/grid.h"
#include "sites/near_sites.h"
#include "sites/weights.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t site_set_grain = 1 << 16;
/// A neighbor is a signed 32-bit index.
constexpr std::size_t most_sites = std::numeric_limits<std::int32_t>::max();
constexpr double infinite = std::numeric_limits<double>::infinity();

tl::unexpected<Error> refuse(Subject subject, std::string message) {
  return tl::unexpected(refusal(subject, std::move(message)));
}

Extent extentOf(const Sites& sites, const PowerOfTwo& scale, const Box& near, int threads) {
  std::vector<Extent> extents((sites.size() + site_set_grain - 1) / site_set_grain);
  parallelFor(sites.size(), site_set_grain, threads, [&](std::size_t begin, std::size_t end) {
    Extent extent;
    for (auto i = begin; i < end; ++i) extent.add(scale(sites.x[i]), scale(sites.y[i]), near);
    extents[begin / site_set_grain] = extent;
  });
  Extent all;
  for (const auto& extent : extents) all.add(extent);
  return all;
}

/// The error of the first site that is not usable; there is one.
Error firstUnusable(const Sites& sites, const PowerOfTwo& scale) {
  const auto isUsable = [&](double value) { return std::abs(scale(value)) <= farthest_site; };
  std::size_t i = 0;
  while (isUsable(sites.x[i]) && isUsable(sites.y[i])) ++i;
  return unusableSite(i, sites.x[i], sites.y[i]);
}

/// `names` are the caller's numbers of the sites; empty: the same as here.
Error nearSites(const Sites& sites, std::uint32_t a, std::uint32_t b,
                std::span<const std::uint32_t> names = {}) {
  if (a > b) std::swap(a, b);
  const auto nameOfSite = [&](std::uint32_t i) { return names.empty() ? i : names[i]; };
  return refusal(
      Subject::sites,
      fmt::format("sites {} and {}: {}, {} and {}, {} are not equal, but nearer to each other than {:.0e} of "
                  "the domain's longer side: make them equal, or move one",
                  nameOfSite(a), nameOfSite(b), sites.x[a], sites.y[a], sites.x[b], sites.y[b],
                  least_distance));
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
  parallelFor(coordinates.size(), site_set_grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto i = begin; i < end; ++i) {
      coordinates[i] = usableCoordinate(coordinates[i]);
    }
  });
}

}  // namespace

Result<void> checkSites(const Sites& sites, const Box& domain, int threads) {
  VORPIPE_TRY(checkDomain(domain));
  VORPIPE_TRY(checkNumber(sites));
  const int exponent = scaleExponent(domain);
  const PowerOfTwo scale(exponent);
  if (!extentOf(sites, scale, domain, threads).usable) return tl::unexpected(firstUnusable(sites, scale));
  const auto weights = scaledWeights(sites, exponent, threads);
  return weights ? Result<void>{} : tl::unexpected(weights.error());
}

Result<Prepared> prepare(const Sites& sites, const Box& domain, int threads, const CallersSites* callers) {
  VORPIPE_TRY(checkDomain(domain));
  VORPIPE_TRY(checkNumber(sites));
  Prepared prepared;
  prepared.exponent = scaleExponent(domain);
  const PowerOfTwo scale(prepared.exponent);
  auto& set = prepared.set;
  set.domain = scaledDomain(domain, prepared.exponent);
  set.has_images = callers != nullptr;
  if (set.has_images) set.shorter_side = scale(shorterSide(callers->domain));
  set.coverage = {-infinite, -infinite, infinite, infinite};

  const auto near = surroundings(set.domain);
  const auto extent = extentOf(sites, scale, near, threads);
  if (!extent.usable) return tl::unexpected(firstUnusable(sites, scale));
  const auto weights = scaledWeights(sites, prepared.exponent, threads);
  if (!weights) return tl::unexpected(weights.error());
  set.grid = gridOver(extent, near);
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

Result<Prepared> preparePart(const Sites& sites, const PartOfRun& part, int threads) {
  Prepared prepared;
  prepared.exponent = part.exponent;
  auto& set = prepared.set;
  set.domain = part.domain;
  set.shorter_side = part.shorter_side;
  set.coverage = {-infinite, -infinite, infinite, infinite};
  set.grid = part.grid;
  orderByBins(sites, PowerOfTwo(part.exponent), threads, set, prepared.owner, part.block);
  if (const auto near_sites = tooNear(set, threads)) {
    const auto a = set.id[near_sites->first], b = set.id[near_sites->second];
    return tl::unexpected(nearSites(sites, a, b, part.names));
  }
  dropTiny(set.x, threads);
  dropTiny(set.y, threads);
  return prepared;
}

}  // namespace vorpipe::core

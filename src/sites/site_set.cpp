#include "sites/site_set.h"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "backend/tie.h"
#include "base/parallel.h"
#include "base/refusal.h"
#include "base/try.h"
#include "sites/bin_sort.h"
#include "sites/distinct_sites.h"
#include "sites/grid.h"
#include "sites/weights.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t site_set_grain = 1 << 16;
/// In scaled units. For sites farther apart, products of distances are in the range of double, and the
/// exact_search's numbers have enough digits for the points where their bisectors meet.
constexpr double least_distance = 0x1p-80;
/// For sites that are triangulated only: they stay apart when tiny coordinates are rounded.
constexpr double least_to_triangulate = 0x1p-140;

using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// Whether two different doubles of this size may be nearer to each other than `least`.
bool isSmall(double value, double least) { return std::abs(value) < least * 0x1p54; }

/// Whether any coordinate is small and not 0. Two sites near each other have such a coordinate.
bool anySmall(const SiteSet& set, double least, int threads) {
  std::atomic<bool> any = false;
  parallelFor(set.size(), site_set_grain, threads, [&](std::size_t begin, std::size_t end) {
    bool here = false;
    for (auto i = begin; i < end; ++i) {
      here =
          here || (isSmall(set.x[i], least) && set.x[i] != 0) || (isSmall(set.y[i], least) && set.y[i] != 0);
    }
    if (here) any = true;
  });
  return any;
}

/// Searches `sites` in rows of the plane, which are as high as the least distance and shifted by a part of
/// that.
std::optional<Pair> nearInRows(const SiteSet& set, std::vector<std::uint32_t>& sites, double least,
                               double shift) {
  const auto row = [&](std::uint32_t i) { return std::floor(set.y[i] / least + shift); };
  std::sort(sites.begin(), sites.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(row(a), set.x[a]) < std::pair(row(b), set.x[b]);
  });
  for (std::size_t k = 1; k < sites.size(); ++k) {
    const auto a = sites[k - 1], b = sites[k];
    if (row(a) == row(b) && set.x[b] - set.x[a] < least) return Pair{std::min(a, b), std::max(a, b)};
  }
  return std::nullopt;
}

/// Returns two sites, as indices in the set, that differ by less than `least` in x and in y. May
/// miss such pairs, but none that differ by less than half of it in y.
std::optional<Pair> tooNear(const SiteSet& set, double least, int threads) {
  if (!anySmall(set, least, threads)) return std::nullopt;
  std::vector<std::uint32_t> sites;
  for (std::uint32_t i = 0; i < set.size(); ++i) {
    if (isSmall(set.x[i], least) || isSmall(set.y[i], least)) sites.push_back(i);
  }
  // Sites on both sides of a border between rows share one of the shifted rows.
  auto pair = nearInRows(set, sites, least, 0);
  return pair ? pair : nearInRows(set, sites, least, 0.5);
}

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
  parallelEach(coordinates.size(), site_set_grain, threads,
               [&](std::size_t i) { coordinates[i] = usableCoordinate(coordinates[i]); });
}

/// Refuses sites that are too near to each other; error(i, j) names those of input indices i and j. Then
/// rounds tiny coordinates.
template <class NearError>
Result<void> separate(SiteSet& set, double least, int threads, const NearError& error) {
  if (const auto pair = tooNear(set, least, threads)) {
    return tl::unexpected(error(set.id[pair->first], set.id[pair->second]));
  }
  dropTiny(set.x, threads);
  dropTiny(set.y, threads);
  return {};
}

/// Prepares sites at least `least` apart; order(extent, scale, prepared) fills the set's sites and grid.
template <class Order>
Result<Prepared> prepareBy(const Sites& sites, const Box& domain, double least, int threads,
                           const CallersSites* callers, const Order& order) {
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
  const auto extent = extentOf(sites, scale, surroundings(set.domain), threads);
  if (!extent.usable) return tl::unexpected(firstUnusable(sites, scale));
  VORPIPE_LET(weights, scaledWeights(sites, prepared.exponent, threads));
  order(extent, scale, prepared);
  giveWeights(weights, threads, set);
  VORPIPE_TRY(separate(set, least, threads, [&](std::uint32_t i, std::uint32_t j) {
    return callers == nullptr ? nearSites(sites, i, j)
                              : nearSites(callers->sites, callers->siteOf(i), callers->siteOf(j));
  }));
  return prepared;
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
  return prepareBy(sites, domain, least_distance, threads, callers,
                   [&](const Extent& extent, const PowerOfTwo& scale, Prepared& prepared) {
                     prepared.set.grid = gridOver(extent, surroundings(prepared.set.domain));
                     orderByBins(sites, scale, threads, prepared.set, prepared.owner);
                   });
}

Result<Prepared> prepareInOneBin(const Sites& sites, const Box& domain, int threads) {
  return prepareBy(sites, domain, least_to_triangulate, threads, nullptr,
                   [&](const Extent&, const PowerOfTwo& scale, Prepared& prepared) {
                     keepDistinct(sites, scale, threads, prepared.set, prepared.owner);
                   });
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
  VORPIPE_TRY(separate(set, least_distance, threads,
                       [&](std::uint32_t i, std::uint32_t j) { return nearSites(sites, i, j, part.names); }));
  return prepared;
}

}  // namespace vorpipe::core

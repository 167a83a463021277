#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/block_sums.h"
#include "base/parallel.h"
#include "base/refusal.h"
#include "base/try.h"
#include "vorpipe.h"

namespace vorpipe {
namespace {

/// Of the domain's longest side: farther sites would take numbers that no double holds. The square is the
/// largest weight.
constexpr double farthest = 0x1p180;

/// Of volumes, the cube roots: a cell may have 1e-7 of the least, and still has all digits.
const double least_root = std::cbrt(1e-301), most_root = std::cbrt(1e301);

tl::unexpected<Error> refused(Subject subject, std::string message) {
  return tl::unexpected(refusal(subject, std::move(message)));
}

Result<void> checkBox(const Box3& box) {
  const double dx = box.xmax - box.xmin, dy = box.ymax - box.ymin, dz = box.zmax - box.zmin;
  const bool valid =
      std::isfinite(dx) && std::isfinite(dy) && std::isfinite(dz) && dx > 0 && dy > 0 && dz > 0;
  if (!valid) {
    return refused(Subject::domain,
                   fmt::format("the domain {},{},{},{},{},{} is not a box with xmin < xmax, ymin < ymax and "
                               "zmin < zmax",
                               box.xmin, box.ymin, box.zmin, box.xmax, box.ymax, box.zmax));
  }
  constexpr double least = 1e-301, most = 1e301;
  // Corners closer than this merge: the cell of a flatter domain has no volume.
  constexpr double flattest = 1e-12;
  const auto [shortest, longest] = std::minmax({dx, dy, dz});
  const std::string sides = fmt::format("the domain has the sides {}, {} and {}", dx, dy, dz);
  // By roots, since a product of two sides alone may leave the range.
  const double root = std::cbrt(dx) * std::cbrt(dy) * std::cbrt(dz);
  if (!(root >= least_root && root <= most_root)) {
    return refused(
        Subject::domain,
        fmt::format("{}: volumes need one whose own lies between {:.0e} and {:.0e}, such as sides of "
                    "1e-100 to 1e100; scale the sites",
                    sides, least, most));
  }
  if (shortest < flattest * longest) {
    return refused(Subject::domain,
                   fmt::format("{}: each must be at least {:.0e} of the longest", sides, flattest));
  }
  return {};
}

/// Around one period.
Box3 boxOf(const Lattice& lattice) {
  const auto& [a, b, c] = lattice;
  const auto side = [](double x, double y, double z) { return (std::abs(x) + std::abs(y)) + std::abs(z); };
  return {0, 0, 0, side(a.x, b.x, c.x), side(a.y, b.y, c.y), side(a.z, b.z, c.z)};
}

Result<void> checkLattice(const Lattice& lattice) {
  const auto& [a, b, c] = lattice;
  const std::string vectors =
      fmt::format("the lattice {},{},{},{},{},{},{},{},{}", a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z);
  const Box3 box = boxOf(lattice);
  const double longest = std::max({box.xmax, box.ymax, box.zmax});
  if (!std::isfinite((box.xmax + box.ymax) + box.zmax))
    return refused(Subject::domain, vectors + " has numbers that are not finite");
  // In units of the longest, so that products do not leave the range.
  const auto part = [longest](const Point3& v) {
    return Point3{v.x / longest, v.y / longest, v.z / longest};
  };
  const Point3 p = part(a), q = part(b), r = part(c);
  const double volume =
      p.x * (q.y * r.z - q.z * r.y) + p.y * (q.z * r.x - q.x * r.z) + p.z * (q.x * r.y - q.y * r.x);
  constexpr double least = 1e-12;
  if (!(longest > 0) || !(std::abs(volume) >= least))
    return refused(Subject::domain, vectors + " has vectors that lie in a plane, or nearly so");
  const double root = longest * std::cbrt(std::abs(volume));
  if (!(root >= least_root && root <= most_root))
    return refused(Subject::domain,
                   vectors + ": its volume must lie between 1e-301 and 1e301; scale the sites");
  return {};
}

Result<void> checkWeights(std::size_t sites, std::span<const double> weights, double longest, int threads) {
  if (weights.empty()) return {};
  if (weights.size() != sites)
    return refused(Subject::weights, fmt::format("there are {} weights and {} sites", weights.size(), sites));
  // By the side twice, whose square may leave the range.
  const auto usable = [&](double weight) {
    return std::isfinite(weight) && std::abs(weight) / longest / longest <= farthest * farthest;
  };
  const auto found = byBlocks<std::size_t>(sites, threads, [&](std::size_t begin, std::size_t end) {
    while (begin < end && usable(weights[begin])) ++begin;
    return begin < end ? begin : sites;
  });
  const std::size_t first = *std::ranges::min_element(found);
  if (first == sites) return {};
  return refused(
      Subject::weights,
      fmt::format("the weight of site {} is {}: {}", first,
                  std::isfinite(weights[first]) ? "too large for the domain" : "not finite", weights[first]));
}

}  // namespace

Box3 domainOf(std::span<const Point3> sites, const Margin& margin) {
  Box3 box{sites[0].x, sites[0].y, sites[0].z, sites[0].x, sites[0].y, sites[0].z};
  for (const Point3& p : sites) {
    box = {std::min(box.xmin, p.x), std::min(box.ymin, p.y), std::min(box.zmin, p.z),
           std::max(box.xmax, p.x), std::max(box.ymax, p.y), std::max(box.zmax, p.z)};
  }
  const double longest = std::max({box.xmax - box.xmin, box.ymax - box.ymin, box.zmax - box.zmin});
  double grown = margin.value;
  if (margin.relative) grown = longest > 0 ? margin.value * longest : 0.5;
  if (margin.value > 0) {
    // Far from the origin so little may be below a coordinate's resolution; a few thousand steps are not.
    const double largest = std::max({std::abs(box.xmin), std::abs(box.xmax), std::abs(box.ymin),
                                     std::abs(box.ymax), std::abs(box.zmin), std::abs(box.zmax)});
    grown = std::max(grown, 4096 * (largest - std::nextafter(largest, 0.0)));
  }
  return {box.xmin - grown, box.ymin - grown, box.zmin - grown,
          box.xmax + grown, box.ymax + grown, box.zmax + grown};
}

Result<void> checkInput(std::span<const Point3> sites, const Cells3Options& options, int threads) {
  if (options.lattice) {
    VORPIPE_TRY(checkLattice(*options.lattice));
  } else {
    VORPIPE_TRY(checkBox(options.domain));
  }
  if (sites.empty()) return refused(Subject::sites, "there are no sites");
  constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
  if (sites.size() > most)
    return refused(Subject::sites, fmt::format("{} sites are more than {}", sites.size(), most));
  const Box3 box = options.lattice ? boxOf(*options.lattice) : options.domain;
  const double longest = std::max({box.xmax - box.xmin, box.ymax - box.ymin, box.zmax - box.zmin});
  const double limit = farthest * longest;  // infinite for a domain so large that no double is too far
  const auto usable = [&](double value) { return std::isfinite(value) && std::abs(value) <= limit; };
  const auto firstWrong = [&](std::size_t begin, std::size_t end) {
    while (begin < end && usable(sites[begin].x) && usable(sites[begin].y) && usable(sites[begin].z)) ++begin;
    return begin;
  };
  // The same site is reported whatever the number of threads.
  const auto found = byBlocks<std::size_t>(sites.size(), threads, [&](std::size_t begin, std::size_t end) {
    const std::size_t wrong = firstWrong(begin, end);
    return wrong < end ? wrong : sites.size();
  });
  const std::size_t first = *std::ranges::min_element(found);
  if (first == sites.size()) return checkWeights(sites.size(), options.weights, longest, threads);
  const Point3& p = sites[first];
  const bool finite = std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  return refused(Subject::sites,
                 fmt::format("site {} {}: {}, {}, {}", first,
                             finite ? "is too far from the domain" : "is not finite", p.x, p.y, p.z));
}

double volumeSum(const Diagram3& diagram) {
  CarefulSum sum;
  for (const double volume : diagram.volume) sum.add(volume);
  return sum.value();
}

}  // namespace vorpipe

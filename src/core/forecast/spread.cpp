#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <mutex>
#include <numeric>
#include <tuple>
#include <utility>

#include "base/parallel.h"
#include "core/delaunay/triangulation.h"
#include "core/sites/grid.h"

namespace vorpipe {

using namespace core;

namespace {

constexpr std::size_t spread_grain = std::size_t{1} << 16;
/// With fewer sites it hardly matters.
constexpr std::size_t worth_looking = 10'000;
/// Where more stand in a bin, it is a crowd, as core/tiles/dense_regions.h has it for nine bins.
constexpr std::uint32_t crowd = 14;
/// Of the 16 parts of a bin with a crowd, one that fills an area has sites in 10 or more, on average.
constexpr int parts_of_area = 8;
constexpr std::size_t probes = 128;
/// Bins around a probe's, on each side, whose sites are looked at with it.
constexpr std::uint32_t around = 2;
/// Sites of a probe at most. Where more stand in its bins, the nearest few hundred.
constexpr std::size_t most_near = 1 << 14, nearest = 300;
/// Below this part of the sites' distance an edge is a tie.
constexpr double tie = 1e-6;

/// A bin of the grid: how many sites, and in which of its 4 x 4 parts.
struct Occupancy {
  std::uint32_t sites = 0;
  std::uint16_t parts = 0;
};

struct Probe {
  std::uint32_t site, bin;
  std::vector<std::uint32_t> near;
};

/// Ties around some sites: how many of them are beside one, and their edges that are ties.
struct Ties {
  std::size_t looked = 0, tied = 0, edges = 0;
};

Box boxOfSites(const Sites& sites, const Box& domain) {
  const double margin = std::max(domain.xmax - domain.xmin, domain.ymax - domain.ymin);
  const auto [xmin, xmax] = std::ranges::minmax(sites.x);
  const auto [ymin, ymax] = std::ranges::minmax(sites.y);
  const auto in = [margin](double value, double low, double high) {
    return std::clamp(value, low - margin, high + margin);
  };
  return {in(xmin, domain.xmin, domain.xmax), in(ymin, domain.ymin, domain.ymax),
          in(xmax, domain.xmin, domain.xmax), in(ymax, domain.ymin, domain.ymax)};
}

/// The center of the circle through a and two points, seen from a.
Point centerSeenFrom(Point a, Point b, Point c) {
  const Point u{b.x - a.x, b.y - a.y}, v{c.x - a.x, c.y - a.y};
  const double twice = 2 * (u.x * v.y - u.y * v.x), uu = u.x * u.x + u.y * u.y, vv = v.x * v.x + v.y * v.y;
  return {(v.y * uu - u.y * vv) / twice, (u.x * vv - v.x * uu) / twice};
}

class SpreadProbe {
 public:
  SpreadProbe(const Sites& sites, const Box& domain, int threads)
      : sites_(sites),
        domain_(domain),
        threads_(threads),
        grid_(layGrid(boxOfSites(sites, domain), sites.size())) {}

  Spread look() {
    countBins();
    Spread spread;
    noteCrowds(spread);
    const Ties ties = tiesAtProbes();
    if (ties.looked == 0) return spread;
    const auto all = static_cast<double>(ties.looked);
    spread.tied = static_cast<double>(ties.tied) / all;
    // Where they are not everywhere, rows of neighbors are hardly shorter.
    constexpr double nearly_all = 0.95;
    if (spread.tied >= nearly_all && !spread.along_curves) {
      spread.edges = std::max(4.0, 6 - static_cast<double>(ties.edges) / all);
    }
    return spread;
  }

 private:
  void countBins() {
    bins_.resize(std::size_t{grid_.columns} * grid_.rows);
    std::atomic<std::size_t> outside = 0;
    parallelFor(sites_.size(), spread_grain, threads_, [&](std::size_t begin, std::size_t end) {
      std::size_t out = 0;
      for (auto i = begin; i < end; ++i) {
        const double x = sites_.x[i], y = sites_.y[i];
        out += x < domain_.xmin || x > domain_.xmax || y < domain_.ymin || y > domain_.ymax ? 1u : 0u;
        Occupancy& bin = bins_[binOf(grid_, x, y)];
        std::atomic_ref(bin.sites).fetch_add(1, std::memory_order_relaxed);
        std::atomic_ref(bin.parts).fetch_or(partOfBin(x, y), std::memory_order_relaxed);
      }
      outside += out;
    });
    outside_ = outside;
  }

  [[nodiscard]] std::uint16_t partOfBin(double x, double y) const {
    const auto along = [&](double value, double low) {
      const double place = (value - low) / grid_.size;
      return static_cast<unsigned>(4 * std::clamp(place - std::floor(place), 0.0, 0.99));
    };
    return static_cast<std::uint16_t>(1u << (4 * along(y, grid_.ymin) + along(x, grid_.xmin)));
  }

  /// The judge takes a tree for more than one cell in 256, and the mesh of all for one in 16, or 64 with
  /// weights. (core/judge/judge.cpp, backend/cpu/cpu.cpp)
  void noteCrowds(Spread& spread) const {
    std::size_t crowded = 0, lined = 0;
    for (const Occupancy& bin : bins_) {
      if (bin.sites <= crowd) continue;
      crowded += bin.sites;
      if (std::popcount(bin.parts) < parts_of_area) lined += bin.sites;
    }
    const auto many = sites_.size() / (sites_.weight.empty() ? 16 : 64), some = sites_.size() / 256;
    spread.along_curves = lined + outside_ > many;
    spread.uneven = crowded + outside_ + atGaps() > some;
  }

  /// Sites along the sides of the domain from which they keep a distance: their cells are long, and many are
  /// left to the judge.
  [[nodiscard]] std::size_t atGaps() const {
    const Box box = boxOfSites(sites_, domain_);
    const double gap = 2 * grid_.size;
    const auto along_side = static_cast<std::size_t>(2 * std::sqrt(static_cast<double>(sites_.size())));
    std::size_t sides = 0;
    for (const double way : {box.xmin - domain_.xmin, domain_.xmax - box.xmax, box.ymin - domain_.ymin,
                             domain_.ymax - box.ymax}) {
      sides += way > gap ? 1u : 0u;
    }
    return sides * along_side;
  }

  Ties tiesAtProbes() {
    std::vector<Probe> all = placeProbes();
    gather(all);
    std::vector<Ties> found(all.size());
    parallelFor(all.size(), 1, threads_, [&](std::size_t begin, std::size_t end) {
      for (auto k = begin; k < end; ++k) found[k] = tiesAt(all[k]);
    });
    Ties sum;
    for (const Ties& each : found) {
      sum = {sum.looked + each.looked, sum.tied + each.tied, sum.edges + each.edges};
    }
    return sum;
  }

  [[nodiscard]] std::vector<Probe> placeProbes() const {
    std::vector<Probe> all;
    for (std::size_t k = 0; k < probes; ++k) {
      const auto site = k * sites_.size() / probes;
      all.push_back({static_cast<std::uint32_t>(site), binOf(grid_, sites_.x[site], sites_.y[site]), {}});
    }
    return all;
  }

  [[nodiscard]] BinBlock blockOf(const Probe& probe) const {
    const auto column = probe.bin % grid_.columns, row = probe.bin / grid_.columns;
    return withMargin(grid_, {column, row, column, row}, around);
  }

  /// Finds the sites in the bins around each probe.
  void gather(std::vector<Probe>& all) const {
    std::vector<std::uint8_t> wanted(bins_.size());
    for (const Probe& probe : all) {
      const BinBlock block = blockOf(probe);
      for (auto row = block.south; row <= block.north; ++row) {
        for (auto column = block.west; column <= block.east; ++column)
          wanted[row * grid_.columns + column] = 1;
      }
    }
    std::mutex mutex;
    parallelFor(sites_.size(), spread_grain, threads_, [&](std::size_t begin, std::size_t end) {
      for (auto i = begin; i < end; ++i) {
        const auto bin = binOf(grid_, sites_.x[i], sites_.y[i]);
        if (wanted[bin] == 0) continue;
        const std::scoped_lock lock(mutex);
        for (Probe& probe : all) {
          const BinBlock block = blockOf(probe);
          const auto column = bin % grid_.columns, row = bin / grid_.columns;
          const bool near =
              column >= block.west && column <= block.east && row >= block.south && row <= block.north;
          if (near && probe.near.size() <= most_near) probe.near.push_back(static_cast<std::uint32_t>(i));
        }
      }
    });
  }

  /// The probe's places, the nearest first and each once; the first is the probe.
  [[nodiscard]] std::vector<Point> placesOf(const Probe& probe) const {
    const double x = sites_.x[probe.site], y = sites_.y[probe.site];
    std::vector<Point> places;
    for (const auto i : probe.near) places.push_back({sites_.x[i] - x, sites_.y[i] - y});
    const auto nearer = [](Point a, Point b) {
      return std::tuple(a.x * a.x + a.y * a.y, a.x, a.y) < std::tuple(b.x * b.x + b.y * b.y, b.x, b.y);
    };
    std::ranges::sort(places, nearer);
    places.erase(std::unique(places.begin(), places.end()), places.end());
    if (places.size() > nearest) places.resize(nearest);
    return places;
  }

  /// Of a probe with too many sites around it to look at, the worst.
  [[nodiscard]] Ties tiesAt(const Probe& probe) const {
    if (probe.near.size() > most_near) return {1, 1, 0};
    const std::vector<Point> places = placesOf(probe);
    const Mesh mesh = delaunay(places);
    // Those farther away may lack some that are their neighbors.
    const std::size_t looked = std::max<std::size_t>(1, places.size() / 32);
    if (mesh.triangles.empty()) return {looked, 0, 0};
    std::vector<std::uint8_t> tied(places.size());
    Ties ties{looked, 0, 0};
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) noteTie(mesh, places, t, k, tied, ties);
    }
    ties.tied = static_cast<std::size_t>(
        std::count(tied.begin(), tied.begin() + static_cast<std::ptrdiff_t>(looked), 1));
    return ties;
  }

  /// Looks at the edge of triangle t that faces its corner k, once for both of its triangles.
  static void noteTie(const Mesh& mesh, const std::vector<Point>& places, std::size_t t, std::size_t k,
                      std::vector<std::uint8_t>& tied, Ties& ties) {
    const auto& here = mesh.triangles[t];
    const auto other = static_cast<std::size_t>(here.neighbor[k]);
    const auto& there = mesh.triangles[other];
    const auto isWhole = [](const MeshTriangle& each) {
      return std::ranges::find(each.corner, ghost) == each.corner.end();
    };
    if (other < t || !isWhole(here) || !isWhole(there)) return;
    const auto p = here.corner[(k + 1) % 3], q = here.corner[(k + 2) % 3], a = here.corner[k];
    const auto b =
        *std::ranges::find_if(there.corner, [&](auto corner) { return corner != p && corner != q; });
    const auto at = [&](std::int32_t corner) { return places[static_cast<std::size_t>(corner)]; };
    const Point from = centerSeenFrom(at(p), at(q), at(a)), to = centerSeenFrom(at(p), at(q), at(b));
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    if (!(length <= tie * std::hypot(at(q).x - at(p).x, at(q).y - at(p).y))) return;
    for (const auto corner : {a, b, p, q}) tied[static_cast<std::size_t>(corner)] = 1;
    for (const auto corner : {p, q}) ties.edges += static_cast<std::size_t>(corner) < ties.looked ? 1u : 0u;
  }

  const Sites& sites_;
  const Box& domain_;
  int threads_;
  Grid grid_;
  std::vector<Occupancy> bins_;
  std::size_t outside_ = 0;
};

}  // namespace

Spread spreadOf(const Sites& sites, const Box& domain, int threads) {
  if (sites.size() < worth_looking) return {};
  return SpreadProbe(sites, domain, threads).look();
}

}  // namespace vorpipe

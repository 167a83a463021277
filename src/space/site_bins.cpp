#include "space/site_bins.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numeric>

#include "base/parallel.h"

namespace vorpipe::space {
namespace {

constexpr double sites_per_bin = 3;
/// How many bins lanes step away along an axis.
constexpr int steps_reach = 5;
constexpr std::size_t grain = 1 << 14;
/// Lanes load a whole vector from any site on.
constexpr std::size_t room_behind = 16;

/// The power of two that brings the longest side of a box into [1, 2).
double scaleOf(const Box3& box) {
  const double side = std::max({box.xmax - box.xmin, box.ymax - box.ymin, box.zmax - box.zmin});
  return std::ldexp(1.0, -std::ilogb(side));
}

Box3 boxAround(std::span<const Point3> sites) {
  Box3 box{sites[0].x, sites[0].y, sites[0].z, sites[0].x, sites[0].y, sites[0].z};
  for (const Point3& p : sites) {
    box = {std::min(box.xmin, p.x), std::min(box.ymin, p.y), std::min(box.zmin, p.z),
           std::max(box.xmax, p.x), std::max(box.ymax, p.y), std::max(box.zmax, p.z)};
  }
  return box;
}

/// Chooses cubes over the sites' box: about sites_per_bin sites in each, if they are even. Along an axis on
/// which the box is thinner than a cube there is one.
void layBins(SiteBins& bins, const Box3& around, std::size_t sites) {
  const double extent[3] = {around.xmax - around.xmin, around.ymax - around.ymin, around.zmax - around.zmin};
  const double wanted = std::max(1.0, static_cast<double>(sites) / sites_per_bin);
  // Of the domain's longest side, which is 1 to 2: the product of three such extents is still a number.
  constexpr double thinnest = 0x1p-300;
  bool thin[3] = {extent[0] < thinnest, extent[1] < thinnest, extent[2] < thinnest};
  double side = 1;
  for (int tries = 0; tries < 3; ++tries) {
    double content = 1;
    int axes = 0;
    for (int a = 0; a < 3; ++a) {
      if (thin[a]) continue;
      content *= extent[a];
      ++axes;
    }
    if (axes == 0) break;
    side = std::pow(content / wanted, 1.0 / axes);
    for (int a = 0; a < 3; ++a) thin[a] = thin[a] || extent[a] < side;
  }
  bins.side = side;
  bins.corner = {around.xmin, around.ymin, around.zmin};
  for (int a = 0; a < 3; ++a) bins.count[a] = std::max(1, static_cast<int>(std::ceil(extent[a] / side)));
}

/// The bins around a part of a bin, by ascending distance, then by that of their centers.
std::vector<BinStep> stepsAround(const std::array<int, 3>& part) {
  constexpr int reach = steps_reach;
  struct Step {
    std::array<int, 3> by;
    double least = 0, of_centers = 0;
  };
  std::vector<Step> all;
  for (int z = -reach; z <= reach; ++z) {
    for (int y = -reach; y <= reach; ++y) {
      for (int x = -reach; x <= reach; ++x) {
        Step step{{x, y, z}};
        for (std::size_t a = 0; a < 3; ++a) {
          const double low = static_cast<double>(part[a]) / parts_of_bin;
          const double high = static_cast<double>(part[a] + 1) / parts_of_bin;
          const double gap = std::max({step.by[a] - high, low - (step.by[a] + 1), 0.0});
          const double between = step.by[a] + 0.5 - (low + high) / 2;
          step.least += gap * gap;
          step.of_centers += between * between;
        }
        all.push_back(step);
      }
    }
  }
  std::ranges::stable_sort(all, [](const Step& a, const Step& b) {
    return a.least != b.least ? a.least < b.least : a.of_centers < b.of_centers;
  });
  std::vector<BinStep> steps;
  steps.reserve(all.size());
  for (const Step& step : all) {
    steps.push_back({static_cast<std::int8_t>(step.by[0]), static_cast<std::int8_t>(step.by[1]),
                     static_cast<std::int8_t>(step.by[2]),
                     static_cast<std::int8_t>(
                         std::max({std::abs(step.by[0]), std::abs(step.by[1]), std::abs(step.by[2])})),
                     0, static_cast<float>(step.least)});
  }
  return steps;
}

/// The same for all parts, x first. Those of the upper half along an axis are mirrored. `count` is that of
/// bins.
std::vector<BinStep> orderOfSteps(const int (&count)[3]) {
  constexpr int half = parts_of_bin / 2;
  std::array<std::vector<BinStep>, std::size_t{half} * half * half> lower;
  for (int k = 0; k < half * half * half; ++k) {
    lower[static_cast<std::size_t>(k)] = stepsAround({k % half, k / half % half, k / half / half});
  }
  std::vector<BinStep> steps;
  for (int part = 0; part < parts_of_bin * parts_of_bin * parts_of_bin; ++part) {
    int of_lower = 0;
    std::array<std::int8_t, 3> sign{};
    for (int a = 2, left = part; a >= 0; --a) {
      const int size = a == 2 ? parts_of_bin * parts_of_bin : a == 1 ? parts_of_bin : 1;
      const int at = left / size;
      left %= size;
      sign[static_cast<std::size_t>(a)] = at < half ? 1 : -1;
      of_lower = of_lower * half + (at < half ? at : parts_of_bin - 1 - at);
    }
    for (const BinStep& step : lower[static_cast<std::size_t>(of_lower)]) {
      const int x = sign[0] * step.x, y = sign[1] * step.y, z = sign[2] * step.z;
      steps.push_back({static_cast<std::int8_t>(x), static_cast<std::int8_t>(y), static_cast<std::int8_t>(z),
                       step.far, (z * count[1] + y) * count[0] + x, step.squared_distance});
    }
  }
  return steps;
}

/// Places may be farther from the bins than an int has sides.
int binAlong(const SiteBins& bins, int axis, double from_corner) {
  return static_cast<int>(
      std::clamp(from_corner / bins.side, 0.0, static_cast<double>(bins.count[axis] - 1)));
}

/// Sorts sites into bins: `order` has their indices, by bin, ascending in each.
std::vector<std::uint32_t> sortByBin(SiteBins& bins, std::span<const Point3> sites, int threads) {
  const std::size_t bin_count = static_cast<std::size_t>(bins.count[0]) *
                                static_cast<std::size_t>(bins.count[1]) *
                                static_cast<std::size_t>(bins.count[2]);
  BigVector<std::uint32_t> bin_of(sites.size());
  parallelEach(sites.size(), grain, threads, [&](std::size_t i) { bin_of[i] = bins.indexOfBin(sites[i]); });
  bins.begin.assign(bin_count + 1, 0);
  for (const std::uint32_t bin : bin_of) ++bins.begin[bin + 1];
  std::partial_sum(bins.begin.begin(), bins.begin.end(), bins.begin.begin());
  std::vector<std::uint32_t> next(bins.begin.begin(), bins.begin.end() - 1), order(sites.size());
  for (std::uint32_t i = 0; i < sites.size(); ++i) order[next[bin_of[i]]++] = i;
  return order;
}

/// Leaves the heaviest and then the first of equal positions in each bin, and names it the owner of the
/// others. Returns the number that leave.
std::size_t leaveDuplicates(SiteBins& bins, std::span<const Point3> sites, std::span<const double> weights,
                            std::vector<std::uint32_t>& order, int threads) {
  constexpr std::size_t few = 12;
  std::atomic<std::size_t> leave{0};
  parallelFor(bins.bins(), 1 << 12, threads, [&](std::size_t begin, std::size_t end) {
    std::size_t here = 0;
    std::vector<std::uint32_t> sorted;
    for (std::size_t bin = begin; bin < end; ++bin) {
      const std::span in(order.data() + bins.begin[bin], bins.begin[bin + 1] - bins.begin[bin]);
      if (in.size() <= few && weights.empty()) {
        for (std::size_t k = 1; k < in.size(); ++k) {
          for (std::size_t e = 0; e < k; ++e) {
            if (sites[in[e]] != sites[in[k]]) continue;
            bins.owner[in[k]] = bins.owner[in[e]];
            ++here;
            break;
          }
        }
        continue;
      }
      sorted.assign(in.begin(), in.end());
      std::ranges::sort(sorted, [&](std::uint32_t a, std::uint32_t b) {
        if (sites[a] != sites[b]) return sites[a] < sites[b];
        return !weights.empty() && weights[a] != weights[b] ? weights[a] > weights[b] : a < b;
      });
      for (std::size_t k = 1; k < sorted.size(); ++k) {
        if (sites[sorted[k]] != sites[sorted[k - 1]]) continue;
        bins.owner[sorted[k]] = bins.owner[sorted[k - 1]];
        ++here;
      }
    }
    leave += here;
  });
  if (leave == 0) return 0;
  std::size_t kept = 0;
  for (std::size_t bin = 0; bin < bins.bins(); ++bin) {
    const std::uint32_t from = bins.begin[bin], to = bins.begin[bin + 1];
    bins.begin[bin] = static_cast<std::uint32_t>(kept);
    for (std::uint32_t k = from; k < to; ++k) {
      if (bins.owner[order[k]] == order[k]) order[kept++] = order[k];
    }
  }
  bins.begin.back() = static_cast<std::uint32_t>(kept);
  order.resize(kept);
  return leave;
}

/// The weights of the sites that are left, in their order; unless all are equal.
void giveWeights(SiteBins& bins, std::span<const double> callers, int threads) {
  if (callers.empty()) return;
  constexpr double least = 0x1p-600;
  const int exponent = 2 * std::ilogb(bins.scale);
  const std::size_t count = bins.input.size();
  BigVector<double> weights(count);
  parallelEach(count, grain, threads, [&](std::size_t k) {
    const double weight = std::ldexp(callers[bins.input[k]], exponent);
    weights[k] = std::abs(weight) < least ? 0 : weight;
  });
  const auto [low, high] = std::ranges::minmax_element(weights);
  if (*low == *high) return;
  bins.least_weight = *low;
  bins.weights = std::move(weights);
  bins.heaviest = HeaviestOfBlocks(bins.count, bins.begin, bins.weights);
  bins.heavy = heavySites(bins.weights, bins.side);
  bins.weight.resize(count + room_behind);
  std::fill_n(bins.weight.end() - static_cast<std::ptrdiff_t>(room_behind), room_behind, 0.0F);
  parallelEach(count, grain, threads, [&](std::size_t k) {
    bins.weight[k] = static_cast<float>(bins.weights[k] - bins.least_weight);
  });
  // All others are lighter than the heavy ones.
  for (const std::uint32_t heavy : bins.heavy) bins.weight[heavy] = -HUGE_VALF;
  bins.heaviest_of_bin.assign(bins.bins(), -HUGE_VALF);
  for (std::size_t bin = 0; bin < bins.bins(); ++bin) {
    float& most = bins.heaviest_of_bin[bin];
    for (std::uint32_t k = bins.begin[bin]; k < bins.begin[bin + 1]; ++k)
      most = std::max(most, bins.weight[k]);
    bins.most_weight = std::max(bins.most_weight, most);
  }
  bins.heaviest_around = largestAround(bins.count, bins.heaviest_of_bin, steps_reach);
}

}  // namespace

std::array<int, 3> SiteBins::binOf(const Point3& site) const {
  return {binAlong(*this, 0, site.x - corner.x), binAlong(*this, 1, site.y - corner.y),
          binAlong(*this, 2, site.z - corner.z)};
}

std::vector<BinLine> SiteBins::linesOfCubes() const {
  constexpr int edge = 8;
  std::vector<BinLine> lines;
  for (int cube_z = 0; cube_z < count[2]; cube_z += edge) {
    for (int cube_y = 0; cube_y < count[1]; cube_y += edge) {
      for (int cube_x = 0; cube_x < count[0]; cube_x += edge) {
        for (int layer = cube_z; layer < std::min(cube_z + edge, count[2]); ++layer) {
          for (int row = cube_y; row < std::min(cube_y + edge, count[1]); ++row) {
            const int line = (layer * count[1] + row) * count[0], end = std::min(cube_x + edge, count[0]);
            lines.push_back(
                {static_cast<std::uint32_t>(line + cube_x), static_cast<std::uint32_t>(line + end)});
          }
        }
      }
    }
  }
  return lines;
}

LaneBins SiteBins::lanes() const {
  LaneBins bins{};
  for (int a = 0; a < 3; ++a) bins.count[a] = count[a];
  bins.side = static_cast<float>(side);
  bins.begin = begin.data();
  bins.x = x.data();
  bins.y = y.data();
  bins.z = z.data();
  bins.places = &sites.data()->x;
  const double low[3] = {box.xmin, box.ymin, box.zmin}, high[3] = {box.xmax, box.ymax, box.zmax};
  std::copy(low, low + 3, bins.low);
  std::copy(high, high + 3, bins.high);
  bins.corner[0] = static_cast<float>(corner.x - box.xmin);
  bins.corner[1] = static_cast<float>(corner.y - box.ymin);
  bins.corner[2] = static_cast<float>(corner.z - box.zmin);
  bins.extent[0] = static_cast<float>(box.xmax - box.xmin);
  bins.extent[1] = static_cast<float>(box.ymax - box.ymin);
  bins.extent[2] = static_cast<float>(box.zmax - box.zmin);
  bins.steps = steps.data();
  bins.step_count = steps.size() / (std::size_t{parts_of_bin} * parts_of_bin * parts_of_bin);
  if (!hasWeights()) return bins;
  bins.least_weight = least_weight;
  bins.weight = weight.data();
  bins.weights = weights.data();
  bins.heaviest = heaviest_of_bin.data();
  bins.heaviest_around = heaviest_around.data();
  bins.most_weight = most_weight;
  bins.heavy = heavy.data();
  bins.heavy_count = heavy.size();
  return bins;
}

SiteBins binSites(std::span<const Point3> callers, const Box3& domain, int threads,
                  std::span<const double> weights) {
  SiteBins bins;
  bins.scale = scaleOf(domain);
  bins.box = {domain.xmin * bins.scale, domain.ymin * bins.scale, domain.zmin * bins.scale,
              domain.xmax * bins.scale, domain.ymax * bins.scale, domain.zmax * bins.scale};
  BigVector<Point3> sites(callers.size());
  parallelEach(callers.size(), grain, threads, [&](std::size_t i) {
    sites[i] = {callers[i].x * bins.scale, callers[i].y * bins.scale, callers[i].z * bins.scale};
  });
  layBins(bins, boxAround(sites), sites.size());
  bins.owner.resize(sites.size());
  std::iota(bins.owner.begin(), bins.owner.end(), 0U);
  bins.input = sortByBin(bins, sites, threads);
  leaveDuplicates(bins, sites, weights, bins.input, threads);
  const std::size_t count = bins.input.size();
  bins.sites.resize(count);
  for (auto* const axis : {&bins.x, &bins.y, &bins.z}) {
    axis->resize(count + room_behind);
    std::fill_n(axis->end() - static_cast<std::ptrdiff_t>(room_behind), room_behind, 0.0F);
  }
  parallelEach(count, grain, threads, [&](std::size_t k) {
    const Point3& p = sites[bins.input[k]];
    const auto [x, y, z] = bins.binOf(p);
    bins.sites[k] = p;
    bins.x[k] = static_cast<float>(p.x - bins.corner.x - x * bins.side);
    bins.y[k] = static_cast<float>(p.y - bins.corner.y - y * bins.side);
    bins.z[k] = static_cast<float>(p.z - bins.corner.z - z * bins.side);
  });
  bins.steps = orderOfSteps(bins.count);
  giveWeights(bins, weights, threads);
  return bins;
}

}  // namespace vorpipe::space

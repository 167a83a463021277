#include "sites/images.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nanoflann.hpp>
#include <numeric>

#include "backend/site_set.h"
#include "base/parallel.h"

namespace vorpipe::core {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
/// In mean distances of sites: the width of the first strip searched, and the spacing of samples on its line.
constexpr double first_strip = 5, samples_apart = 0.5;
/// Relative to a period: a wider band costs nearly as much as the widest.
constexpr double nearly_whole = 0.4;
/// A cell reaches beyond the domain, and the circles around its vertices as far again; a little more, because
/// vertices are farther from sites than most points.
constexpr double cells_to_places = 2.5;
constexpr std::size_t nearest_asked = 8;
constexpr std::size_t band_grain = 256;

struct Strip {
  std::vector<std::array<double, 2>> point;  ///< across the line, along it
  std::vector<double> deficit;               ///< by how much its weight is less than the heaviest

  [[nodiscard]] std::size_t kdtree_get_point_count() const { return point.size(); }
  [[nodiscard]] double kdtree_get_pt(std::uint32_t i, std::size_t axis) const { return point[i][axis]; }
  template <class Bounds>
  bool kdtree_get_bbox(Bounds&) const {
    return false;
  }
};

using Metric = nanoflann::L2_Simple_Adaptor<double, Strip, double, std::uint32_t>;
using KdTree = nanoflann::KDTreeSingleIndexAdaptor<Metric, Strip, 2, std::uint32_t>;

double spacingOf(const PeriodicSites& placed) {
  const auto& [x, y] = placed.axis;
  return std::sqrt(x.length / static_cast<double>(placed.sites.size()) * y.length);
}

/// The sites, except the heavy ones, within `width` of the line where the domain begins along an axis.
Strip stripOf(const PeriodicSites& placed, const Band& band, std::size_t a, double width) {
  const PeriodicAxis& axis = placed.axis[a];
  const auto& across = a == 0 ? placed.sites.x : placed.sites.y;
  const auto& along = a == 0 ? placed.sites.y : placed.sites.x;
  const auto& weight = placed.sites.weight;
  Strip strip;
  for (std::uint32_t i = 0; i < across.size(); ++i) {
    const double after = across[i] - axis.low, before = axis.high - across[i];
    if (std::min(after, before) > width) continue;
    const double deficit = weight.empty() ? 0 : band.heaviest - weight[i];
    if (deficit < 0) continue;
    strip.point.push_back({after < before ? after : -before, along[i]});
    strip.deficit.push_back(deficit);
  }
  return strip;
}

/// An upper bound, over all points of the line where the domain begins along an axis, of the distance within
/// which a site of the largest weight, except heavy ones, can be nearest. For one point it is the least
/// distance to the sites, each lifted out of the plane by its missing weight. It is 1-Lipschitz, so samples
/// bound it everywhere.
double reachOnLine(const PeriodicSites& placed, const Strip& strip, std::size_t a, int threads) {
  const PeriodicAxis& other = placed.axis[1 - a];
  const auto samples =
      static_cast<std::size_t>(std::ceil(other.length / (samples_apart * spacingOf(placed))));
  const double step = other.length / static_cast<double>(samples);
  constexpr std::size_t leaf_size = 16;
  const KdTree tree(2, strip, {leaf_size});
  const auto asked = placed.sites.weight.empty() ? 1 : std::min(nearest_asked, strip.point.size());
  const auto reachAt = [&](double place) {
    const double query[2] = {0, place};
    std::array<std::uint32_t, nearest_asked> found{};
    std::array<double, nearest_asked> squared{};
    const auto count = tree.knnSearch(query, asked, found.data(), squared.data());
    double least = infinite;
    for (std::size_t k = 0; k < count; ++k) least = std::min(least, squared[k] + strip.deficit[found[k]]);
    return std::sqrt(least);
  };
  std::vector<double> most((samples + band_grain - 1) / band_grain);
  parallelFor(samples, band_grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto k = begin; k < end; ++k) {
      const double place = other.low + (static_cast<double>(k) + 0.5) * step;
      double reach = reachAt(place);
      if (other.periodic) {
        if (place - reach < other.low) reach = std::min(reach, reachAt(place + other.length));
        if (place + reach > other.high) reach = std::min(reach, reachAt(place - other.length));
      }
      most[begin / band_grain] = std::max(most[begin / band_grain], reach);
    }
  });
  return *std::ranges::max_element(most) + 0.5 * step;
}

double bandForPlaces(const PeriodicSites& placed, const Band& band, std::size_t a, int threads) {
  const PeriodicAxis& axis = placed.axis[a];
  if (!axis.periodic) return 0;
  double width = first_strip * spacingOf(placed);
  while (width < nearly_whole * axis.length) {
    const Strip strip = stripOf(placed, band, a, width);
    const double reach = strip.point.empty() ? infinite : reachOnLine(placed, strip, a, threads);
    if (reach <= width) return reach;
    width *= 2;
  }
  return axis.length;
}

/// Separates the heaviest sites if the others are light enough for this to make a difference.
void findHeavy(const PeriodicSites& placed, Band& band) {
  const auto& weight = placed.sites.weight;
  if (weight.empty()) return;
  std::vector<std::uint32_t> order(weight.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto heavier = [&](std::uint32_t a, std::uint32_t b) { return weight[a] > weight[b]; };
  const auto least = std::ranges::min(weight);
  const auto split = std::min(most_heavy, order.size() - 1);
  std::ranges::nth_element(order, order.begin() + static_cast<std::ptrdiff_t>(split), heavier);
  const double others = weight[order[split]];
  const double heaviest = std::ranges::max(weight);
  const bool matters =
      std::sqrt(heaviest - least) > std::sqrt(others - least) + samples_apart * spacingOf(placed);
  band.heaviest = matters ? others : heaviest;
  if (!matters) return;
  for (std::size_t k = 0; k < split; ++k) {
    if (weight[order[k]] > others) band.heavy.push_back(order[k]);
  }
  std::ranges::sort(band.heavy);
}

}  // namespace

double cappedBand(const PeriodicAxis& axis, double width) {
  if (!axis.periodic) return 0;
  return width < nearly_whole * axis.length ? width : axis.length;
}

Band bandForPlaces(const PeriodicSites& placed, int threads) {
  Band band;
  findHeavy(placed, band);
  for (const std::size_t a : {0u, 1u}) {
    // Slightly more than computed: covers rounding.
    band.width[a] = cappedBand(placed.axis[a], 1.001 * bandForPlaces(placed, band, a, threads));
  }
  return band;
}

Band likelyBandForCells(const PeriodicSites& placed, int threads) {
  Band band = bandForPlaces(placed, threads);
  for (const std::size_t a : {0u, 1u}) {
    band.width[a] = cappedBand(placed.axis[a], cells_to_places * band.width[a]);
  }
  return band;
}

}  // namespace vorpipe::core

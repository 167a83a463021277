#include "sites/images.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/double_double.h"
#include "base/parallel.h"
#include "base/refusal.h"
#include "base/try.h"
#include "sites/bin_sort.h"
#include "sites/site_set.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t images_grain = 1 << 16;
/// Beyond this many periods a double is too coarse to hold a position in the domain.
constexpr double most_periods = 0x1p50;

/// The quantum of coordinates: sums of three lengths, and all coordinates in the domain, have at most 53
/// bits.
double quantumOf(double low, double high) {
  const double largest = std::max(0.75 * (high - low), 0.5 * std::max(std::abs(low), std::abs(high)));
  int exponent = 0;
  std::frexp(largest, &exponent);
  return std::ldexp(1.0, exponent - 52);
}

double rounded(double value, double quantum) { return std::nearbyint(value / quantum) * quantum; }

bool repeatsX(Periodic periodic) { return periodic == Periodic::x || periodic == Periodic::xy; }
bool repeatsY(Periodic periodic) { return periodic == Periodic::y || periodic == Periodic::xy; }

/// Puts the coordinates of one axis into the domain; returns the first site that is too far away, or none.
class SiteWrapper {
 public:
  SiteWrapper(const Sites& sites, int exponent, PeriodicSites& out)
      : sites_(sites), scale_(exponent), out_(out) {}

  void put(std::size_t begin, std::size_t end, std::uint8_t& outside, std::size_t& too_far) {
    for (auto i = begin; i < end; ++i) {
      const bool x = put(i, 0, sites_.x[i], out_.sites.x[i], outside);
      const bool y = put(i, 1, sites_.y[i], out_.sites.y[i], outside);
      if (!x || !y) too_far = std::min(too_far, i);
    }
  }

 private:
  bool put(std::size_t i, std::size_t a, double from, double& to, std::uint8_t& outside) const {
    const PeriodicAxis& axis = out_.axis[a];
    const double scaled = usableCoordinate(scale_(from));
    const bool inside = axis.contains(scaled);
    if (!axis.periodic) {
      to = scaled;
      if (!inside) outside = 1;
      return true;
    }
    const auto placed = axis.put(scaled);
    to = placed.place;
    out_.home[i][a] = inside ? static_cast<std::int8_t>(placed.periods) : std::int8_t{0};
    return std::abs(placed.periods) <= most_periods;
  }

  const Sites& sites_;
  PowerOfTwo scale_;
  PeriodicSites& out_;
};

/// Whether a coordinate lies in the box along its axis, both ends included.
bool isCovered(double place, double low, double high) { return place >= low && place <= high; }

/// The domain, wider by `by_x` on the left and right and by `by_y` below and above.
Box widened(const PeriodicSites& placed, double by_x, double by_y) {
  const Box box = placed.domain();
  return {box.xmin - by_x, box.ymin - by_y, box.xmax + by_x, box.ymax + by_y};
}

Box coveredBy(const PeriodicSites& placed, const Band& band) {
  return widened(placed, band.width[0], band.width[1]);
}

/// The sites with an image, within a period, that lies in the band or is needed anyway.
std::vector<std::uint32_t> sitesWithImages(const PeriodicSites& placed, const Band& band) {
  const auto inBand = [&](double place, std::size_t a) {
    const PeriodicAxis& axis = placed.axis[a];
    return axis.periodic && (place <= axis.low + band.width[a] || place >= axis.high - band.width[a]);
  };
  std::vector<std::uint32_t> near;
  for (std::uint32_t i = 0; i < placed.sites.size(); ++i) {
    if (inBand(placed.sites.x[i], 0) || inBand(placed.sites.y[i], 1)) near.push_back(i);
  }
  std::vector<std::uint32_t> wanted;
  std::ranges::set_union(near, band.heavy, std::back_inserter(wanted));
  return wanted;
}

/// The position of an image.
Point placeOf(const PeriodicSites& placed, const SiteImage& image) {
  return {placed.sites.x[image.site] + image.shift[0] * placed.axis[0].length,
          placed.sites.y[image.site] + image.shift[1] * placed.axis[1].length};
}

}  // namespace

PeriodicAxis::PeriodicAxis(double low_end, double high_end, bool repeats)
    : periodic(repeats),
      low(low_end),
      high(high_end),
      length(high_end - low_end),
      low_(low_end),
      high_(high_end) {
  if (!periodic) return;
  quantum_ = quantumOf(low_, high_);
  // Positions are relative to the middle of the domain, where doubles are finest.
  offset_ = rounded(low_ + 0.5 * length, quantum_);
  low = rounded(low_, quantum_) - offset_;
  // Not the rounded length: sites at both ends must coincide.
  length = rounded(high_, quantum_) - rounded(low_, quantum_);
  high = low + length;
}

PeriodicAxis::Placed PeriodicAxis::put(double scaled) const {
  if (!periodic) return {scaled, 0};
  const DoubleDouble from_middle = DoubleDouble::sum(rounded(scaled, quantum_), -offset_);
  double periods = std::floor((from_middle.high - low) / length);
  if (!(std::abs(periods) <= most_periods)) return {low, 2 * most_periods};
  const DoubleDouble whole = DoubleDouble::product(periods, length);
  // All of these are multiples of the quantum, and none of the sums needs more than 53 bits of it.
  const DoubleDouble near = DoubleDouble::sum(from_middle.high, -whole.high);
  double place = near.high + (near.low + (from_middle.low - whole.low));
  if (place < low) {
    place += length;
    periods -= 1;
  } else if (place >= high) {
    place -= length;
    periods += 1;
  }
  return {place, periods};
}

Result<PeriodicSites> placeSites(const Sites& sites, const Box& domain, Periodic periodic, int threads) {
  // Without this, prepare would refuse sites by naming the positions of images.
  VORPIPE_TRY(checkSites(sites, domain, threads));
  const int exponent = scaleExponent(domain);
  const PowerOfTwo scale(exponent);
  const Box box = scaledDomain(domain, exponent);
  PeriodicSites placed{{PeriodicAxis(box.xmin, box.xmax, repeatsX(periodic)),
                        PeriodicAxis(box.ymin, box.ymax, repeatsY(periodic))},
                       exponent,
                       {},
                       {}};
  placed.sites.x.resize(sites.size());
  placed.sites.y.resize(sites.size());
  placed.home.resize(sites.size(), {0, 0});
  const auto parts = (sites.size() + images_grain - 1) / images_grain;
  std::vector<std::uint8_t> outside(parts);
  std::vector<std::size_t> too_far(parts, sites.size());
  SiteWrapper wrapper(sites, exponent, placed);
  parallelFor(sites.size(), images_grain, threads, [&](std::size_t begin, std::size_t end) {
    wrapper.put(begin, end, outside[begin / images_grain], too_far[begin / images_grain]);
  });
  if (const auto i = *std::ranges::min_element(too_far); i < sites.size()) {
    return tl::unexpected(refusal(
        Subject::sites, fmt::format("site {} is too far from the domain to be wrapped into it: {}, {}", i,
                                    sites.x[i], sites.y[i])));
  }
  placed.all_inside = std::ranges::find(outside, 1) == outside.end();
  placed.sites.weight = sites.weight;
  for (double& weight : placed.sites.weight) weight = scale(scale(weight));
  return placed;
}

void eachImage(const PeriodicSites& placed, const Band& band,
               const std::function<void(const SiteImage&)>& take) {
  const PeriodicAxis &x = placed.axis[0], &y = placed.axis[1];
  const Box covered = coveredBy(placed, band);
  const auto wanted = sitesWithImages(placed, band);
  const std::int8_t most_x = x.periodic ? 1 : 0, most_y = y.periodic ? 1 : 0;
  // Shift by shift, so that images of one position are in the order of their sites.
  for (auto sy = static_cast<std::int8_t>(-most_y); sy <= most_y; ++sy) {
    for (auto sx = static_cast<std::int8_t>(-most_x); sx <= most_x; ++sx) {
      if (sx == 0 && sy == 0) continue;
      for (const auto i : wanted) {
        const SiteImage image{i, {sx, sy}};
        const Point place = placeOf(placed, image);
        const bool in_band = (!x.periodic || isCovered(place.x, covered.xmin, covered.xmax)) &&
                             (!y.periodic || isCovered(place.y, covered.ymin, covered.ymax));
        if (in_band || std::ranges::binary_search(band.heavy, i)) take(image);
      }
    }
  }
}

ImagedSites withImages(const PeriodicSites& placed, const Band& band) {
  ImagedSites out;
  out.sites = placed.sites;
  out.count = placed.sites.size();
  out.covered = out.box = coveredBy(placed, band);
  const PeriodicAxis &x = placed.axis[0], &y = placed.axis[1];
  if (!band.heavy.empty()) out.box = widened(placed, x.periodic ? x.length : 0, y.periodic ? y.length : 0);
  eachImage(placed, band, [&](const SiteImage& image) {
    const Point place = placeOf(placed, image);
    out.sites.x.push_back(place.x);
    out.sites.y.push_back(place.y);
    if (!placed.sites.weight.empty()) out.sites.weight.push_back(placed.sites.weight[image.site]);
    out.images.push_back(image);
  });
  return out;
}

Scene plainScene(const Sites& sites, const Box& domain) {
  Scene scene{{}, domain, domain};
  scene.imaged.count = sites.size();
  return scene;
}

Result<Scene> sceneOf(const Sites& sites, const RenderOptions& options, int threads) {
  if (options.periodic == Periodic::none) return plainScene(sites, options.domain);
  VORPIPE_VAR(placed, placeSites(sites, options.domain, options.periodic, threads));
  auto imaged = withImages(placed, bandForPlaces(placed, threads));
  const Box picture = placed.domain();
  // A device finds cells clipped to the domain faster. But cells clipped to more than the picture do not show
  // which sites have a cell in it, unless every site does.
  const Box clip = placed.all_inside ? imaged.box : picture;
  return Scene{std::move(imaged), clip, picture};
}

void nameSites(const Scene& scene, std::span<std::uint32_t> ids) {
  if (scene.imaged.images.empty()) return;
  for (auto& id : ids) {
    if (id != no_site) id = scene.siteOf(id);
  }
}

}  // namespace vorpipe::core

namespace vorpipe {

Result<Sites> wrapped(const Sites& sites, const Box& domain, Periodic periodic, int threads) {
  if (periodic == Periodic::none) return sites;
  VORPIPE_LET(placed, core::placeSites(sites, domain, periodic, threads));
  const core::PowerOfTwo unscale(-placed.exponent);
  Sites out{{}, {}, sites.weight};
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const auto [x, y] = placed.home[i];
    out.x.push_back(unscale(placed.axis[0].number(placed.sites.x[i], x)));
    out.y.push_back(unscale(placed.axis[1].number(placed.sites.y[i], y)));
  }
  return out;
}

}  // namespace vorpipe

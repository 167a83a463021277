#include "check/images.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vorpipe::core::checks {

Result<InsideSites> insideOf(const Sites& sites, const Box& domain, Periodic periodic, int threads) {
  if (periodic == Periodic::none) return InsideSites{};
  auto inside = wrapped(sites, domain, periodic, threads);
  if (!inside) return tl::unexpected(inside.error());
  return InsideSites{std::move(*inside)};
}

Result<std::array<Point, 2>> placedCorners(const Box& domain, Periodic periodic) {
  const auto corners =
      wrapped({{domain.xmin, domain.xmax}, {domain.ymin, domain.ymax}, {}}, domain, periodic);
  if (!corners) return tl::unexpected(corners.error());
  return std::array{Point{corners->x[0], corners->y[0]}, Point{corners->x[1], corners->y[1]}};
}

Point SitePlaces::at(std::size_t i) const {
  const auto placed = [&](double at) { return countedCoordinate(at * run_.scale) == 0 ? 0 : at; };
  Point p{placed(run_.sites.x[i]), placed(run_.sites.y[i])};
  const auto& [low, high] = run_.corners;
  if (run_.repeats_x && p.x == high.x) p.x = low.x;
  if (run_.repeats_y && p.y == high.y) p.y = low.y;
  return p;
}

namespace {

/// A place at which to search instead of p: p minus `shift` periods. The result's image, moved by `shift`, is
/// equally far from p.
struct Frame {
  Point from;
  Shift shift;
};

/// A whole number of periods; 0 for NaN and for a place so far away that it is wrong.
std::int32_t whole(double periods) {
  constexpr double most = 0x1p30;
  return std::abs(periods) < most ? static_cast<std::int32_t>(periods) : 0;
}

/// The frames in which an image nearest to p may appear as a site; the one in the domain comes first.
std::vector<Frame> framesOf(const CheckedSites& run, Point p) {
  const auto periods = [](bool repeats, double from_low, double period) {
    return repeats ? whole(std::floor(from_low / period)) : 0;
  };
  const Shift of_p{periods(run.repeats_x, p.x - run.domain.xmin, run.period.x),
                   periods(run.repeats_y, p.y - run.domain.ymin, run.period.y)};
  const int most_x = run.repeats_x ? 1 : 0, most_y = run.repeats_y ? 1 : 0;
  std::vector<Frame> frames;
  for (int y = -most_y; y <= most_y; ++y) {
    for (int x = -most_x; x <= most_x; ++x) {
      const Shift shift{of_p[0] - x, of_p[1] - y};
      frames.push_back({run.moved(p, {-shift[0], -shift[1]}), shift});
    }
  }
  std::swap(frames.front(), frames[frames.size() / 2]);
  return frames;
}

NearImage imageOf(const CheckedSites& run, std::uint32_t site, Shift shift) {
  return {site, shift, run.moved(run.site(site), shift)};
}

double squaredTo(const NearImage& image, Point p) { return dot(p - image.place, p - image.place); }

/// How much nearer image a is to p than b, in squared distance.
double nearerBy(const CheckedSites& run, const NearImage& a, const NearImage& b, Point p) {
  return squaredTo(b, p) - squaredTo(a, p) + run.weightDifference(a.site, b.site);
}

/// The rounding error of nearerBy(), also for places a period away.
double nearerRounding(const CheckedSites& run, const NearImage& a, const NearImage& b, Point p) {
  const double of_squares =
      squaredTo(a, p) + squaredTo(b, p) + std::abs(run.weightDifference(a.site, b.site));
  const double of_places = run.largest * (length(p - a.place) + length(p - b.place));
  return squared_rounding * (of_squares + of_places);
}

/// Whether a frame may contain an image as near to p as `near`: all sites are in the domain, and most frames
/// are farther from it.
bool maySeeAsNear(const CheckedSites& run, const NearestSite& nearest, const Frame& frame,
                  const NearImage& near, Point p) {
  const auto outside = [](double at, double low, double high) {
    return std::max({low - at, 0.0, at - high});
  };
  const Point to_domain{run.repeats_x ? outside(frame.from.x, run.domain.xmin, run.domain.xmax) : 0,
                        run.repeats_y ? outside(frame.from.y, run.domain.ymin, run.domain.ymax) : 0};
  const double farther = dot(to_domain, to_domain), squared = squaredTo(near, p);
  const double heavier = run.weightDifference(nearest.heaviest(), near.site);
  const double rounding =
      farther + squared + std::abs(heavier) + run.largest * (length(to_domain) + std::sqrt(squared));
  return !(farther - squared - heavier > 4 * squared_rounding * rounding);
}

}  // namespace

NearImage nearestImage(const CheckedSites& run, const NearestSite& nearest, Point p) {
  if (!run.repeats()) {
    const std::uint32_t site = nearest.at(p);
    return imageOf(run, site, {0, 0});
  }
  NearImage best{no_site, {}, {}};
  for (const Frame& frame : framesOf(run, p)) {
    if (best.site != no_site && !maySeeAsNear(run, nearest, frame, best, p)) continue;
    const NearImage image = imageOf(run, nearest.at(frame.from), frame.shift);
    if (best.site == no_site || nearerBy(run, image, best, p) > 0) best = image;
  }
  return best;
}

std::vector<NearImage> nearestImages(const CheckedSites& run, const NearestSite& nearest, Point p) {
  std::vector<NearImage> images;
  for (const Frame& frame : framesOf(run, p)) {
    if (!images.empty() && !maySeeAsNear(run, nearest, frame, images.front(), p)) continue;
    for (const auto site : nearest.allAt(frame.from)) images.push_back(imageOf(run, site, frame.shift));
  }
  if (!run.repeats()) return images;
  const auto best = std::ranges::max_element(
      images, [&](const NearImage& a, const NearImage& b) { return nearerBy(run, b, a, p) > 0; });
  std::iter_swap(images.begin(), best);
  std::erase_if(images, [&, first = images.front()](const NearImage& image) {
    return nearerBy(run, first, image, p) > nearerRounding(run, first, image, p);
  });
  return images;
}

NearImage imageNear(const CheckedSites& run, std::uint32_t i, Point p) {
  const auto periods = [](bool repeats, double way, double period) {
    return repeats ? whole(std::round(way / period)) : 0;
  };
  const Point way = p - run.site(i);
  return imageOf(run, i,
                 {periods(run.repeats_x, way.x, run.period.x), periods(run.repeats_y, way.y, run.period.y)});
}

}  // namespace vorpipe::core::checks

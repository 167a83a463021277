#include "core/check/images.h"

#include <algorithm>
#include <cmath>

namespace vorpipe::checks {

Result<InsideSites> insideOf(const Sites& sites, const Box& domain, Periodic periodic, int threads) {
  if (periodic == Periodic::none) return InsideSites{};
  auto inside = wrapped(sites, domain, periodic, threads);
  if (!inside) return tl::unexpected(inside.error());
  return InsideSites{std::move(*inside)};
}

SitePlaces::SitePlaces(const CheckedSites& run) : run_(run) {
  if (!run.repeats()) return;
  const Box& box = run.caller_domain;
  const auto periodic = !run.repeats_x ? Periodic::y : !run.repeats_y ? Periodic::x : Periodic::xy;
  const auto corners = wrapped({{box.xmin, box.xmax}, {box.ymin, box.ymax}, {}}, box, periodic);
  if (!corners) return;
  low_ = {corners->x[0], corners->y[0]};
  high_ = {corners->x[1], corners->y[1]};
}

Point SitePlaces::at(std::size_t i) const {
  // As near to an axis, in scaled units, a coordinate counts as 0.
  constexpr double least = 0x1p-200;
  const auto placed = [&](double at) { return std::abs(at * run_.scale) < least ? 0 : at; };
  Point p{placed(run_.sites.x[i]), placed(run_.sites.y[i])};
  if (run_.repeats_x && p.x == high_.x) p.x = low_.x;
  if (run_.repeats_y && p.y == high_.y) p.y = low_.y;
  return p;
}

namespace {

/// A place from where sites are looked for, so many widths and heights before p.
struct Frame {
  Point from;
  double widths, heights;
};

/// Those from which an image nearest to p may be seen as a site.
std::vector<Frame> framesOf(const CheckedSites& run, Point p) {
  const Box& box = run.domain;
  const double widths = run.repeats_x ? std::floor((p.x - box.xmin) / (box.xmax - box.xmin)) : 0;
  const double heights = run.repeats_y ? std::floor((p.y - box.ymin) / (box.ymax - box.ymin)) : 0;
  const int most_x = run.repeats_x ? 1 : 0, most_y = run.repeats_y ? 1 : 0;
  std::vector<Frame> frames;
  for (int y = -most_y; y <= most_y; ++y) {
    for (int x = -most_x; x <= most_x; ++x) {
      frames.push_back({run.moved(p, x - widths, y - heights), widths - x, heights - y});
    }
  }
  return frames;
}

NearImage imageIn(const CheckedSites& run, const Frame& frame, std::uint32_t site) {
  return {site, run.moved(run.site(site), frame.widths, frame.heights)};
}

double squaredTo(const NearImage& image, Point p) { return dot(p - image.place, p - image.place); }

/// By how much an image is nearer to p than another, squared.
double leadOf(const CheckedSites& run, const NearImage& a, const NearImage& b, Point p) {
  return squaredTo(b, p) - squaredTo(a, p) + run.lead(a.site, b.site);
}

/// What that may have lost to rounding, of places a period away as well.
double leadRounding(const CheckedSites& run, const NearImage& a, const NearImage& b, Point p) {
  const double of_squares = squaredTo(a, p) + squaredTo(b, p) + std::abs(run.lead(a.site, b.site));
  const double of_places = run.largest * (length(p - a.place) + length(p - b.place));
  return squared_rounding * (of_squares + of_places);
}

}  // namespace

NearImage nearestImage(const CheckedSites& run, const NearestSite& nearest, Point p) {
  if (!run.repeats()) {
    const std::uint32_t site = nearest.at(p);
    return {site, run.site(site)};
  }
  NearImage best{no_site, {}};
  for (const Frame& frame : framesOf(run, p)) {
    const NearImage image = imageIn(run, frame, nearest.at(frame.from));
    if (best.site == no_site || leadOf(run, image, best, p) > 0) best = image;
  }
  return best;
}

std::vector<NearImage> nearestImages(const CheckedSites& run, const NearestSite& nearest, Point p) {
  std::vector<NearImage> images;
  for (const Frame& frame : framesOf(run, p)) {
    for (const auto site : nearest.allAt(frame.from)) images.push_back(imageIn(run, frame, site));
  }
  if (!run.repeats()) return images;
  const auto best = std::ranges::max_element(
      images, [&](const NearImage& a, const NearImage& b) { return leadOf(run, b, a, p) > 0; });
  std::iter_swap(images.begin(), best);
  std::erase_if(images, [&, first = images.front()](const NearImage& image) {
    return leadOf(run, first, image, p) > leadRounding(run, first, image, p);
  });
  return images;
}

Point imageNear(const CheckedSites& run, std::size_t i, Point p) {
  const Box& box = run.domain;
  const Point site = run.site(i), way = p - site;
  return run.moved(site, run.repeats_x ? std::round(way.x / (box.xmax - box.xmin)) : 0,
                   run.repeats_y ? std::round(way.y / (box.ymax - box.ymin)) : 0);
}

}  // namespace vorpipe::checks

#include "core/check/images.h"

namespace vorpipe::checks {

Result<InsideSites> insideOf(const Sites& sites, const Box& domain, Periodic periodic) {
  if (periodic == Periodic::none) return InsideSites{};
  auto inside = wrapped(sites, domain, periodic);
  if (!inside) return tl::unexpected(inside.error());
  return InsideSites{std::move(*inside)};
}

SitePlaces::SitePlaces(const CheckedSites& run) : run_(run) {
  if (!run.repeats()) return;
  const Box& box = run.caller_domain;
  const auto periodic = !run.repeats_x ? Periodic::y : !run.repeats_y ? Periodic::x : Periodic::xy;
  const auto corners = wrapped({{box.xmin, box.xmax}, {box.ymin, box.ymax}, {}}, box, periodic);
  if (!corners) return;
  low_ = {corners->x[0] * run.scale, corners->y[0] * run.scale};
  high_ = {corners->x[1] * run.scale, corners->y[1] * run.scale};
}

Point SitePlaces::at(std::size_t i) const {
  Point p = run_.site(i);
  if (run_.repeats_x && p.x == high_.x) p.x = low_.x;
  if (run_.repeats_y && p.y == high_.y) p.y = low_.y;
  return p;
}

NearImage nearestImage(const CheckedSites& run, const NearestSite& nearest, Point p) {
  const Box& box = run.domain;
  const double widths = run.repeats_x ? std::floor((p.x - box.xmin) / (box.xmax - box.xmin)) : 0;
  const double heights = run.repeats_y ? std::floor((p.y - box.ymin) / (box.ymax - box.ymin)) : 0;
  NearImage best{no_site, {}};
  double least = 0;
  const int most_x = run.repeats_x ? 1 : 0, most_y = run.repeats_y ? 1 : 0;
  for (int y = -most_y; y <= most_y; ++y) {
    for (int x = -most_x; x <= most_x; ++x) {
      const std::uint32_t site = nearest.at(run.moved(p, x - widths, y - heights));
      const Point place = run.moved(run.site(site), widths - x, heights - y);
      const double squared = dot(p - place, p - place);
      if (best.site != no_site && !(squared - least < run.lead(site, best.site))) continue;
      least = squared;
      best = {site, place};
    }
  }
  return best;
}

Point imageNear(const CheckedSites& run, std::size_t i, Point p) {
  const Box& box = run.domain;
  const Point site = run.site(i), way = p - site;
  return run.moved(site, run.repeats_x ? std::round(way.x / (box.xmax - box.xmin)) : 0,
                   run.repeats_y ? std::round(way.y / (box.ymax - box.ymin)) : 0);
}

}  // namespace vorpipe::checks

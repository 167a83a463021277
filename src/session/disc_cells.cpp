#include "session/disc_cells.h"

#include <fmt/core.h>

#include <algorithm>

#include "base/parallel.h"
#include "base/refusal.h"
#include "cells/cell_walk.h"
#include "geometry/disc_cut.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t disc_cells_grain = 4096;

/// Cuts cells, for one thread.
class CellCutter {
 public:
  CellCutter(const FoundBox& found, const Sites& sites, CellMoments& moments, FreeSurface& surface)
      : discs_(found, surface.weight),
        set_(found.run->prepared.set),
        unscale_(found.run->prepared.exponent),
        sites_(sites),
        moments_(moments),
        arc_(surface.arc) {}

  void cut(std::uint32_t cell, std::span<const std::int32_t> row, std::span<const AnchoredPoint> corners) {
    const Point site = discs_.siteOf(cell);
    const double squared_radius = discs_.squaredRadius(cell);
    placeAround(site, corners);
    if (!DiscCut::isFar(corners_, squared_radius)) {
      lines_.clear();
      for (const auto neighbor : row) lines_.push_back(discs_.lineOf(cell, neighbor));
      take(cell, cut_.cut(corners_, lines_, squared_radius), site);
      return;
    }
    // Relative to the first corner; a position's second part is the finer one.
    const Point center{-corners_[0].x, -corners_[0].y};
    for (std::size_t e = 0; e < corners.size(); ++e) corners_[e] = wayBetween(corners[0], corners[e]);
    take(cell, cut_.cutFar(corners_, center, squared_radius), positionOf(corners[0]));
  }

 private:
  void placeAround(Point origin, std::span<const AnchoredPoint> corners) {
    corners_.clear();
    for (const auto& corner : corners) corners_.push_back(relativeTo(origin, corner));
  }

  void take(std::uint32_t cell, DiscShape shape, Point origin) {
    const auto i = set_.id[cell];
    if (shape == DiscShape::polygon) return;
    if (shape == DiscShape::nothing) {
      dropMoments(i);
      return;
    }
    moments_.area[i] = moments_.mass[i] = unscale_(cut_.area(), 2);
    const Point centroid = cut_.centroid();
    moments_.centroid[i] = unscale_(Point{origin.x + centroid.x, origin.y + centroid.y});
    moments_.spread[i] = unscale_(cut_.spread(), 4);
    arc_[i] = cut_.arcAngle();
  }

  void dropMoments(std::uint32_t i) {
    moments_.status[i] = Status::empty;
    moments_.area[i] = moments_.mass[i] = moments_.spread[i] = 0;
    moments_.centroid[i] = {sites_.x[i], sites_.y[i]};
  }

  Discs discs_;
  const SiteSet& set_;
  Unscale unscale_;
  const Sites& sites_;
  CellMoments& moments_;
  std::vector<double>& arc_;
  DiscCut cut_;
  std::vector<Point> corners_;
  std::vector<EdgeLine> lines_;
};

}  // namespace

Result<void> checkFreeSurface(const CellsOptions& options, const Density& density) {
  const auto refused = [](Subject subject, const char* what) {
    return tl::unexpected(
        refusal(subject, fmt::format("a free surface takes no {} yet: only a box without one", what)));
  };
  if (!density.values.empty()) return refused(Subject::density, "density");
  if (!options.outline.empty()) return refused(Subject::outline, "outline");
  if (options.periodic != Periodic::none) return refused(Subject::period, "period");
  return {};
}

void cutByDiscs(const FoundBox& found, const Sites& sites, int threads, CellMoments& moments, Report& report,
                FreeSurface& surface) {
  surface.weight = sites.weight;
  surface.arc.assign(sites.size(), 0);
  const SiteSet& set = found.run->prepared.set;
  parallelFor(
      set.size(), grainFor(set.size(), disc_cells_grain), threads, [&](std::size_t begin, std::size_t end) {
        CellCutter cutter(found, sites, moments, surface);
        CellWalk walk(set, found.cells->rows);
        walk(begin, end, [&](std::uint32_t cell, auto row, auto corners) { cutter.cut(cell, row, corners); });
      });
  report.ok = static_cast<std::uint64_t>(std::ranges::count(moments.status, Status::ok));
  report.empty = static_cast<std::uint64_t>(std::ranges::count(moments.status, Status::empty));
}

}  // namespace vorpipe::core

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/progress_steps.h"
#include "base/stopwatch.h"
#include "base/try.h"
#include "cells/neighbor_rows.h"
#include "cells/vertex_batch.h"
#include "picture/cell_drawing.h"
#include "picture/pixel_polygon.h"

namespace vorpipe::core {
namespace {

/// Number of cells whose triangles are made at a time, and by one thread.
constexpr std::size_t most_at_once = std::size_t{1} << 16, polygon_drawing_grain = 4096;

/// Triangles of some cells; indices are into `corners`.
struct Triangles {
  std::vector<DrawMark> corners;
  std::vector<std::uint32_t> corner_of;  ///< an index, three for each triangle
};

/// Makes triangles of cells.
class TriangleWriter {
 public:
  TriangleWriter(const SiteSet& sites, std::span<const std::uint8_t> palette_index, const View& view,
                 const PixelFrame& frame, Triangles& out)
      : sites_(sites), palette_index_(palette_index), view_(view), frame_(frame), out_(out), batch_(sites) {}

  void add(std::uint32_t site, std::span<const std::int32_t> row) {
    if (batch_.add(site, row, [&] { finish(); }) != CornerBatch::Added::other) return;
    placeCorners(sites_, site, row, places_);
    polygon_.clear();
    for (const AnchoredPoint& place : places_) addCorner(place);
    write(site);
  }

  /// Writes the cells in the batch.
  void finish() {
    batch_.place();
    for (std::size_t k = 0; k < batch_.size(); ++k) {
      polygon_.clear();
      for (std::size_t e = 0; e < batch_.row(k).size(); ++e) addCorner(batch_.placeOf(k, e));
      write(batch_.cell(k));
    }
    batch_.clear();
  }

 private:
  /// A corner that rounding moved out of the domain is put on its wall. Omits a corner that is not a number.
  void addCorner(const AnchoredPoint& place) {
    const Point p = relativeTo(view_.corner, place);
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) return;
    const Box& domain = sites_.domain;
    polygon_.push_back(
        frame_.pixelOf({std::clamp(p.x, domain.xmin - view_.corner.x, domain.xmax - view_.corner.x),
                        std::clamp(p.y, domain.ymin - view_.corner.y, domain.ymax - view_.corner.y)}));
  }

  /// A cell that holds the center of one pixel is drawn as a triangle around that, without corners of the
  /// cell.
  void write(std::uint32_t site) {
    if (polygon_.size() < 3) return;
    cutToView(frame_, polygon_);
    const CoveredPixels covered = coveredPixels(polygon_, frame_);
    if (covered.count == CoveredPixels::Count::none) return;
    if (covered.count == CoveredPixels::Count::one) {
      const auto [x, y] = covered.center;
      polygon_ = {{x - 0.25, y - 0.25}, {x + 0.25, y - 0.25}, {x, y + 0.25}};
    } else if (frame_.erosion() > 0 && !shrink(frame_.erosion(), polygon_)) {
      return;
    }
    const auto first = static_cast<std::uint32_t>(out_.corners.size());
    for (const Point corner : polygon_) {
      const Point at = frame_.deviceOf(corner);
      out_.corners.push_back(
          {static_cast<float>(at.x), static_cast<float>(at.y), sites_.id[site], palette_index_[site]});
    }
    for (std::uint32_t k = 2; k < polygon_.size(); ++k) {
      for (const auto corner : {0u, k - 1, k}) out_.corner_of.push_back(first + corner);
    }
  }

  const SiteSet& sites_;
  std::span<const std::uint8_t> palette_index_;
  const View& view_;
  const PixelFrame& frame_;
  Triangles& out_;
  CornerBatch batch_;
  std::vector<AnchoredPoint> places_;
  std::vector<Point> polygon_;
};

/// Sends triangles in as few calls as the device's limits allow.
Result<void> send(Backend& backend, const std::vector<Triangles>& parts, double& seconds) {
  const std::size_t most = backend.info().max_lines;
  Triangles joined;
  std::size_t corners = 0, triangles = 0;
  for (const Triangles& part : parts) {
    corners += part.corners.size();
    triangles += part.corner_of.size() / 3;
  }
  joined.corners.reserve(std::min(corners, most));
  joined.corner_of.reserve(3 * std::min(triangles, most));
  const auto flush = [&]() -> Result<void> {
    if (joined.corner_of.empty()) return {};
    const Stopwatch watch;
    VORPIPE_TRY(backend.drawTriangles(joined.corners, joined.corner_of));
    seconds += watch.seconds();
    joined.corners.clear();
    joined.corner_of.clear();
    return {};
  };
  for (const Triangles& part : parts) {
    if (part.corners.size() > most || part.corner_of.size() > 3 * most) {
      // Too many: each triangle gets its own corners.
      for (const auto corner : part.corner_of) {
        if (joined.corners.size() + 3 > most && joined.corner_of.size() % 3 == 0) {
          VORPIPE_TRY(flush());
        }
        joined.corner_of.push_back(static_cast<std::uint32_t>(joined.corners.size()));
        joined.corners.push_back(part.corners[corner]);
      }
      continue;
    }
    if (joined.corners.size() + part.corners.size() > most ||
        joined.corner_of.size() + part.corner_of.size() > 3 * most) {
      VORPIPE_TRY(flush());
    }
    const auto first = static_cast<std::uint32_t>(joined.corners.size());
    joined.corners.insert(joined.corners.end(), part.corners.begin(), part.corners.end());
    for (const auto corner : part.corner_of) joined.corner_of.push_back(first + corner);
  }
  return flush();
}

}  // namespace

Result<void> drawPolygons(const SearchInput& input, std::span<const std::uint8_t> palette_index,
                          const View& view, std::span<const std::uint32_t> which, const NeighborRows& cells,
                          double& seconds) {
  const auto& info = input.backend.info();
  if (!info.has_vertices) return {};  // Every pixel is found when the picture is read.
  const PixelFrame frame(view, info.subpixel_bits);
  const auto draw_some = [&](std::size_t first, std::size_t count) {
    std::vector<Triangles> parts((count + polygon_drawing_grain - 1) / polygon_drawing_grain);
    parallelFor(count, polygon_drawing_grain, input.threads, [&](std::size_t begin, std::size_t end) {
      TriangleWriter writer(input.sites, palette_index, view, frame, parts[begin / polygon_drawing_grain]);
      const auto site_at = [&](std::size_t k) { return which[first + k]; };
      forCellsBySize(cells, begin, end, site_at, [&](std::uint32_t site) {
        if (cells.status(site) == CellStatus::certified) writer.add(site, cells.edges(site));
      });
      writer.finish();
    });
    return send(input.backend, parts, seconds);
  };
  return runInSteps(input.progress, "drawing", which.size(), most_at_once, draw_some);
}

}  // namespace vorpipe::core

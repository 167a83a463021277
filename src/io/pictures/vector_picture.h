/// Pictures of cells as shapes: SVG and PDF, and the part common to both.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <vector>

#include "io/base/byte_sink.h"
#include "io/base/error.h"
#include "io/base/print.h"
#include "vorpipe.h"
#include "vorpipe/free_surface.h"
#include "vorpipe/globe.h"
#include "vorpipe/shapes.h"

namespace vorpipe {

/// A part of an ellipse, in pixels; angles are those in the circle before stretching, and grow from the right
/// downward.
struct PixelArc {
  Point center, radii;
  double begin, angle;

  [[nodiscard]] Point at(double part) const {
    const double a = begin + part * angle;
    return {center.x + radii.x * std::cos(a), center.y + radii.y * std::sin(a)};
  }
  /// Returns the inner two control points of a cubic Bezier curve with the arc's ends and directions (Riskus
  /// 2006, "Approximation of a cubic Bezier curve by circular arcs and vice versa").
  [[nodiscard]] std::array<Point, 2> handles() const {
    const double length = 4.0 / 3 * std::tan(angle / 4), end = begin + angle;
    const Point first = at(0), last = at(1);
    return {Point{first.x - length * radii.x * std::sin(begin), first.y + length * radii.y * std::cos(begin)},
            Point{last.x + length * radii.x * std::sin(end), last.y - length * radii.y * std::cos(end)}};
  }
};

/// Lines through points, in pixels from the picture's upper left corner, y downward. Points are joined by
/// straight segments or arcs.
class Lines {
 public:
  void clear() {
    points_.clear();
    begins_.clear();
    arcs_.clear();
  }
  /// Begins another line, without points so far.
  void begin() { begins_.push_back(points_.size()); }
  void add(Point point) { points_.push_back(point); }
  /// Adds the end of an arc that begins at the previous point.
  void addArc(const PixelArc& arc, Point end) {
    arcs_.push_back({points_.size(), arc});
    points_.push_back(end);
  }

  [[nodiscard]] std::size_t size() const { return begins_.size(); }
  [[nodiscard]] bool empty() const { return begins_.empty(); }
  /// Returns the arc that ends at point i of line k; null if the line is straight there.
  [[nodiscard]] const PixelArc* arcTo(std::size_t k, std::size_t i) const {
    const auto found = std::ranges::lower_bound(arcs_, begins_[k] + i, {}, &ArcTo::point);
    return found != arcs_.end() && found->point == begins_[k] + i ? &found->arc : nullptr;
  }
  [[nodiscard]] std::span<const Point> operator[](std::size_t k) const {
    const std::size_t end = k + 1 < begins_.size() ? begins_[k + 1] : points_.size();
    return std::span(points_).subspan(begins_[k], end - begins_[k]);
  }

 private:
  struct ArcTo {
    std::size_t point;
    PixelArc arc;
  };
  std::vector<Point> points_;
  std::vector<std::size_t> begins_;
  std::vector<ArcTo> arcs_;  ///< by point, ascending
};

/// A picture with the same colors, edges, dual, dots, frame, labels and legend as one in pixels, in the order
/// in which it is painted: cells, edges, borders, the dual, dots, the graticule, labels, the legend. Makes
/// shapes one at a time, on request.
class VectorPicture {
 public:
  /// Width of a line around each cell, in the cell's color. It closes a gap: renderers smooth the two sides
  /// of an edge separately, so that the background shines through.
  static constexpr double seam_width = 0.5;
  static constexpr std::uint32_t rim_color = black;

  /// Makes the picture that `options` describe of `diagram`, the cells of `sites` with Detail::polygons, or
  /// those with a free surface, drawn as arcs, or those of the globe, on its map. All must outlive it.
  /// Errors: those of siteColors and wrapped(); an invalid size (input); out of memory (device).
  static Result<VectorPicture> make(const Sites& sites, const Diagram& diagram, const RenderOptions& options,
                                    int threads = 0);

  [[nodiscard]] const RenderOptions& options() const { return *options_; }
  /// Of the picture with what stands around it.
  [[nodiscard]] int width() const { return sheet_.left + options_->width + sheet_.right; }
  [[nodiscard]] int height() const { return sheet_.top + options_->height + sheet_.bottom; }
  /// The size of all of it on paper, if it has one.
  [[nodiscard]] std::optional<PaperSize> paper() const { return paperOf(*options_, sheet_); }
  [[nodiscard]] const Sheet& sheet() const { return sheet_; }
  /// Pixels that show the domain: everything except the legend is clipped to them.
  [[nodiscard]] Box clip() const { return places_.pixels(); }
  [[nodiscard]] bool hasEdges() const { return options_->edges; }
  [[nodiscard]] std::uint32_t color(std::size_t site) const {
    return options_->fill ? colors_.rgba[site] : unfilledColor(*options_);
  }
  [[nodiscard]] std::uint32_t dotColor() const { return vorpipe::dotColor(*options_); }
  [[nodiscard]] std::uint32_t edgeColor() const { return vorpipe::edgeColor(*options_); }
  /// Below everything, over the whole picture.
  [[nodiscard]] std::optional<Color> background() const { return options_->background; }
  /// Whether cells are not painted.
  [[nodiscard]] bool cellsShowBackground() const { return vorpipe::cellsShowBackground(*options_); }
  /// Rings that bound the cells, and clip edges and dots by the even-odd rule; none without an outline.
  [[nodiscard]] Lines outline() const;
  /// Rings of RenderOptions::borders.
  [[nodiscard]] Lines borders() const;
  /// Open lines over all cells, in graticule_color.
  [[nodiscard]] Lines graticule() const;
  [[nodiscard]] const DotSize& dot() const { return dot_; }
  /// Width of edges between cells, and of the dual.
  [[nodiscard]] double edgeWidth() const { return options_->edge_width; }
  /// Width of edges along the outline, whose outer half is clipped away. As in pixel pictures, they cover the
  /// border pixels of the cells, and as many beside them as other edges do.
  [[nodiscard]] double outlineWidth() const { return options_->edge_width + 1; }
  [[nodiscard]] const std::optional<Legend>& legend() const { return legend_; }

  /// Calls `use` with the rings of each cell, to be filled by the even-odd rule; in a periodic domain once
  /// for each visible copy of the cell. Errors: those of `use`.
  using UseCell = std::function<Result<void>(std::size_t site, const Lines& rings)>;
  Result<void> eachCell(const UseCell& use) const;

  /// Calls `use` with the open lines that are edges between cells, each once.
  using UseLines = std::function<Result<void>(const Lines& lines)>;
  Result<void> eachEdge(const UseLines& use) const;

  /// Centers of dots.
  [[nodiscard]] std::span<const Point> dots() const { return dots_; }

  /// Lines between sites whose cells have a common edge.
  [[nodiscard]] std::span<const Line> dual() const { return dual_; }

  [[nodiscard]] std::span<const SiteLabel> labels() const { return labels_.labels; }
  /// Whether dots belong to names, and are drawn after all else, without an end at the rim.
  [[nodiscard]] bool hasNamedDots() const { return options_->show_sites && hasNames(*options_); }
  [[nodiscard]] LegendText textOf(const SiteLabel& label) const;
  /// Background box of a label, in the color of its cell: dual lines end at sites, where the labels are. None
  /// without a dual.
  [[nodiscard]] std::optional<LegendBox> boxBelow(const SiteLabel& label) const;

 private:
  VectorPicture(const Sites& sites, const Diagram& diagram, const RenderOptions& options);
  [[nodiscard]] Point pixelOf(Point point) const { return places_.pixelOf(point); }
  /// The caller's sites and options.
  [[nodiscard]] Lines ringsOf(const Outline& outline) const;
  Result<void> placeDots(const Sites& given, const RenderOptions& wanted, int threads);
  /// Keeps only the sites, by index, whose positions `at` have a cell.
  static Result<void> keepInOutline(const RenderOptions& wanted, const Sites& at,
                                    std::vector<std::uint32_t>& sites, int threads);
  [[nodiscard]] double spacingOf(std::span<const std::uint32_t> sites) const;

  void addRing(const Cell& cell, Lines& lines) const;
  void addSurface(const Cell& cell, Lines& lines) const;
  void addArc(const BorderPart& part, Point site, Lines& lines) const;

  /// Cells of the globe on its map: what is drawn in place of the caller's.
  struct OnMap {
    MapCells cells;
    MapLines edges, graticule;
  };
  std::unique_ptr<OnMap> map_;  ///< none in a plane
  const Sites* sites_;
  const Diagram* diagram_;
  const RenderOptions* options_;
  bool free_surface_;
  PicturePlaces places_;
  SiteColors colors_;
  std::optional<Legend> legend_;
  Sheet sheet_;
  std::vector<Point> dots_;
  DotSize dot_{};
  std::vector<Line> dual_;
  SiteLabels labels_;
};

/// Appends a length in pixels to the nearest 1e-4, in as few characters as possible.
void printPixels(Bytes& bytes, double pixels);

/// Appends x and y, with a space between them.
void printPoint(Bytes& bytes, Point point);

/// Returns the size of a font like Helvetica whose capital letters have the given height.
double fontSize(double capital_height);

/// Makes a picture and calls `write(picture)`. Errors: those of VectorPicture::make and `write`; memory ran
/// out (device).
template <class Write>
Result<void> writeShapes(ByteSink& sink, const Sites& sites, const Diagram& diagram,
                         const RenderOptions& options, int threads, const Write& write) {
  try {
    const auto picture = VectorPicture::make(sites, diagram, options, threads);
    return picture ? write(*picture) : tl::unexpected(picture.error());
  } catch (const std::bad_alloc&) {
    return deviceError(sink.name() + ": there is not enough memory to write its shapes");
  }
}

/// Draws `diagram`, the cells of `sites` with Detail::polygons, by `options`, and writes the picture as
/// SVG 1.1 of options.width x options.height pixels, or as one page of PDF 1.4. A cell of SVG is a path with
/// its site and area as title. Without a size on paper, a pixel of PDF is 0.75 points, as in browsers, or
/// less if the page would exceed 14400 points, the most that readers accept. Equal cells give equal bytes.
/// Errors: those of writeShapes; writing failed (device).
Result<void> writeSvgPicture(ByteSink& sink, const Sites& sites, const Diagram& diagram,
                             const RenderOptions& options, int threads = 0);
Result<void> writePdfPicture(ByteSink& sink, const Sites& sites, const Diagram& diagram,
                             const RenderOptions& options, int threads = 0);

}  // namespace vorpipe

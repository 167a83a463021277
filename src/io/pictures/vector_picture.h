/// What a picture of cells shows, as shapes: all that its writers have in common.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "vorpipe.h"
#include "vorpipe/free_surface.h"
#include "vorpipe/shapes.h"

namespace vorpipe {

/// A part of an ellipse, in pixels; angles are those of its circle before that was stretched, and grow from
/// the right downward.
struct PixelArc {
  Point center, radii;
  double begin, angle;

  [[nodiscard]] Point at(double part) const {
    const double a = begin + part * angle;
    return {center.x + radii.x * std::cos(a), center.y + radii.y * std::sin(a)};
  }
  /// The inner two of the four points of a cubic Bezier curve that has the arc's ends, and its directions
  /// there (Riskus 2006, "Approximation of a cubic Bezier curve by circular arcs and vice versa").
  [[nodiscard]] std::array<Point, 2> handles() const {
    const double length = 4.0 / 3 * std::tan(angle / 4), end = begin + angle;
    const Point first = at(0), last = at(1);
    return {Point{first.x - length * radii.x * std::sin(begin), first.y + length * radii.y * std::cos(begin)},
            Point{last.x + length * radii.x * std::sin(end), last.y - length * radii.y * std::cos(end)}};
  }
};

/// Lines through points, in pixels from the picture's upper left corner, y downward. From a point to the next
/// they are straight, or arcs.
class Lines {
 public:
  void clear() {
    points_.clear();
    begins_.clear();
    arcs_.clear();
  }
  /// Begins another line, which has no point yet.
  void begin() { begins_.push_back(points_.size()); }
  void add(Point point) { points_.push_back(point); }
  /// Adds the end of an arc that begins at the point before.
  void addArc(const PixelArc& arc, Point end) {
    arcs_.push_back({points_.size(), arc});
    points_.push_back(end);
  }

  [[nodiscard]] std::size_t size() const { return begins_.size(); }
  [[nodiscard]] bool empty() const { return begins_.empty(); }
  /// The arc that ends at point i of line k; null where the line is straight.
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
/// in which it is painted: cells, edges, the dual, dots, labels, the legend. Shapes are made one after the
/// other, when they are asked for.
class VectorPicture {
 public:
  /// Renderers smooth the two sides of an edge apart, so that what is below shines through. A line so wide
  /// around each cell, in its own color, closes the gap.
  static constexpr double seam_width = 0.5;
  static constexpr std::uint32_t rim_color = black;

  /// The picture that `options` draw of `diagram`, the cells of `sites` with Detail::polygons, or those with
  /// a free surface, which is drawn as arcs. They all outlive it. Errors: those of siteColors and wrapped();
  /// a size that is none (input); out of memory (device).
  static Result<VectorPicture> make(const Sites& sites, const Diagram& diagram, const RenderOptions& options,
                                    int threads = 0);

  [[nodiscard]] int width() const { return options_->width; }
  [[nodiscard]] int height() const { return options_->height; }
  /// Where it shows the domain: all but the legend is clipped to that.
  [[nodiscard]] Box clip() const { return places_.pixels(); }
  [[nodiscard]] bool hasEdges() const { return options_->edges; }
  [[nodiscard]] std::uint32_t color(std::size_t site) const {
    return options_->fill ? colors_.rgba[site] : white;
  }
  /// Of dots: on white cells white ones would not show.
  [[nodiscard]] std::uint32_t dotColor() const { return options_->fill ? white : black; }
  /// The rings that cells end at, and that edges and dots are clipped to, by the rule of even and odd; none
  /// without an outline.
  [[nodiscard]] Lines outline() const;
  [[nodiscard]] const DotSize& dot() const { return dot_; }
  /// Of edges between cells, and of the dual.
  [[nodiscard]] double edgeWidth() const { return options_->edge_width; }
  /// Of edges along the outline, the outer half of which is clipped away. In pixels they are those of the
  /// cells that it bounds, and as many beside them as beside other edges.
  [[nodiscard]] double outlineWidth() const { return options_->edge_width + 1; }
  [[nodiscard]] const std::optional<Legend>& legend() const { return legend_; }

  /// Calls `use` with the rings of each cell, to be filled by the rule of even and odd: in a periodic domain
  /// once for each place where the cell shows. Errors: those of `use`.
  using UseCell = std::function<Result<void>(std::size_t site, const Lines& rings)>;
  Result<void> eachCell(const UseCell& use) const;

  /// Calls `use` with the open lines that are edges between cells, each once.
  using UseLines = std::function<Result<void>(const Lines& lines)>;
  Result<void> eachEdge(const UseLines& use) const;

  /// Centers.
  [[nodiscard]] std::span<const Point> dots() const { return dots_; }

  /// Lines between sites whose cells have a common edge.
  [[nodiscard]] std::span<const Line> dual() const { return dual_; }

  [[nodiscard]] std::span<const SiteLabel> labels() const { return labels_; }
  /// Their height.
  [[nodiscard]] double labelSize() const { return options_->label_size; }
  [[nodiscard]] LegendText textOf(const SiteLabel& label) const;
  /// What is below a label, in the color of its cell: lines of the dual end at sites, where labels are. None
  /// without a dual.
  [[nodiscard]] std::optional<LegendBox> boxBelow(const SiteLabel& label) const;

 private:
  VectorPicture(const Sites& sites, const Diagram& diagram, const RenderOptions& options);
  [[nodiscard]] Point pixelOf(Point place) const { return places_.pixelOf(place); }
  Result<void> placeDots(const Sites& sites, int threads);
  /// Keeps the sites, by index, whose places `at` have a cell.
  Result<void> keepInOutline(const Sites& at, std::vector<std::uint32_t>& sites, int threads) const;
  [[nodiscard]] double spacingOf(std::span<const std::uint32_t> sites) const;

  void addRing(const Cell& cell, Lines& lines) const;
  void addSurface(const Cell& cell, Lines& lines) const;
  void addArc(const BorderPart& part, Point site, Lines& lines) const;

  const Sites* sites_;
  const Diagram* diagram_;
  const RenderOptions* options_;
  bool free_surface_;
  PicturePlaces places_;
  SiteColors colors_;
  std::optional<Legend> legend_;
  std::vector<Point> dots_;
  DotSize dot_{};
  std::vector<Line> dual_;
  std::vector<SiteLabel> labels_;
};

}  // namespace vorpipe

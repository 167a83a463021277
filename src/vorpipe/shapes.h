/// Lines and labels of a picture, and where they stand: what pictures in pixels and those of shapes have in
/// common.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "vorpipe/cell.h"
#include "vorpipe/cells.h"
#include "vorpipe/forecast.h"
#include "vorpipe/picture.h"
#include "vorpipe/result.h"
#include "vorpipe/sites.h"

namespace vorpipe {

/// Where places stand in a picture, in pixels from its upper left corner, y downward.
class PicturePlaces {
 public:
  /// Of the view, or of the domain where there is none.
  explicit PicturePlaces(const RenderOptions& options);

  [[nodiscard]] Point pixelOf(Point place) const;
  /// What shows of the domain: that, or what the view leaves of it; its ymin is below ymax as in the domain.
  [[nodiscard]] const Box& shown() const { return shown_; }
  /// Where that is in the picture; its ymin is the upper end.
  [[nodiscard]] Box pixels() const;
  /// Where the whole view is.
  [[nodiscard]] const PictureFrame& frame() const { return frame_; }
  /// Of a part of the view with this area, in units of the domain's.
  [[nodiscard]] double pixelsOf(double area) const;

 private:
  Box view_, shown_;
  PictureFrame frame_;
};

/// How far the copies of what stands in a box are from it, of those that show: itself alone where no axis is
/// periodic, and copies of it in a periodic domain.
std::vector<Point> shownCopies(const Box& box, const RenderOptions& options, const PicturePlaces& places);

/// Both cells of an edge between sites have it: whether it is this one that draws it.
bool drawsEdge(const Cell& cell, std::size_t edge);

/// A straight line, in pixels.
struct Line {
  Point from, to;
};

/// The index of a site, in its cell.
struct SiteLabel {
  std::uint32_t site;
  Point middle;  ///< of the digits, which are RenderOptions::label_size high, in pixels
  double width;  ///< of the digits
  std::string text;
};

/// What is drawn over cells that needs their measures or polygons.
struct Marks {
  std::vector<Line> edges;    ///< between cells
  std::vector<Line> outline;  ///< of the domain, closed
  std::vector<Line> dual;     ///< between sites whose cells have a common edge
  std::vector<SiteLabel> labels;
};

/// Whether a picture in pixels needs cells for its marks, and how much of them.
inline bool marksNeedCells(const RenderOptions& options) {
  return options.dual || options.labels || (options.edges && options.antialias > 1);
}
inline Detail marksDetail(const RenderOptions& options) {
  const bool polygons = options.labels || (options.edges && options.antialias > 1);
  return polygons ? Detail::polygons : Detail::measures;
}

/// The marks of a picture. `cells` are those of the sites with marksDetail(options). Edges and the outline
/// are there where the picture has several places in a pixel. Error: wrapped()'s.
Result<Marks> marksOf(const Sites& sites, const Diagram& cells, const RenderOptions& options,
                      int threads = 0);

/// The lines of `dual` alone. `cells` have Detail::measures. Each pair of images has one that shows. Error:
/// wrapped()'s.
Result<std::vector<Line>> dualLines(const Sites& sites, const Diagram& cells, const RenderOptions& options,
                                    int threads = 0);

/// The labels alone. `cells` have Detail::polygons. A cell has one where the box of its digits fits into what
/// shows of it, beside the site's dot if there is one. Error: wrapped()'s.
Result<std::vector<SiteLabel>> siteLabels(const Sites& sites, const Diagram& cells,
                                          const RenderOptions& options, int threads = 0);

/// Of black and white the one that stands out from a color.
std::uint32_t inkOn(std::uint32_t rgba);

/// The space around a label's digits that keeps them apart from lines, in pixels.
double labelMargin(const RenderOptions& options);

inline constexpr std::uint32_t edge_color = 0xFF181818u, dual_color = 0xFF1E32E6u, white = 0xFFFFFFFFu,
                               black = 0xFF000000u;

/// Rows of pixels whose places are looked at together, where each pixel has several.
inline int rowsAtOnce(int width, int antialias) {
  constexpr std::uint64_t places_at_once = std::uint64_t{1} << 22;
  const auto places = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(antialias * antialias);
  return static_cast<int>(std::clamp<std::uint64_t>(places_at_once / places, 1, largest_side));
}

/// As the other planPicture; `options` are the picture's, as far as they are known.
std::vector<MemoryPlan::Array> planPicture(MemoryPlan& plan, const Workload& work,
                                           const RenderOptions& options);

/// Images that a picture's marks and colors need.
ImagesFor imagesFor(const RenderOptions& options);

}  // namespace vorpipe

/// Lines and labels of a picture, and their positions: shared by raster and vector pictures.
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

/// Maps places to a picture, in pixels from its upper left corner, y downward.
class PicturePlaces {
 public:
  /// Shows the view, or the domain if there is none.
  explicit PicturePlaces(const RenderOptions& options);

  [[nodiscard]] Point pixelOf(Point place) const;
  /// The visible part of the domain: all of it, or what the view leaves of it; ymin is below ymax as in the
  /// domain.
  [[nodiscard]] const Box& shown() const { return shown_; }
  /// The position of shown() in the picture; its ymin is the upper end.
  [[nodiscard]] Box pixels() const;
  /// The position of the whole view.
  [[nodiscard]] const PictureFrame& frame() const { return frame_; }
  /// Pixels of a part of the view with this area, in units of the domain's.
  [[nodiscard]] double pixelsOf(double area) const;

 private:
  Box view_, shown_;
  PictureFrame frame_;
};

/// Returns the offsets of the visible copies of something in a box. Without a periodic axis there is at most
/// the original; a periodic domain has copies of it.
std::vector<Point> shownCopies(const Box& box, const RenderOptions& options, const PicturePlaces& places);

/// Whether this cell draws the edge: both cells of an edge between sites have it, and only one draws it.
bool drawsEdge(const Cell& cell, std::size_t edge);

/// A straight line, in pixels.
struct Line {
  Point from, to;
};

/// The index of a site, or a text, as a label in its cell.
struct SiteLabel {
  std::uint32_t site;
  Point middle;  ///< of its capital letters, which are RenderOptions::label_size high, in pixels
  double width;
  std::string text;
  bool beyond = false;  ///< reaches out of its cell, over a halo
};

/// Labels, and the dots that names stand beside: these are whole, also at the rim of the domain and beyond.
struct SiteLabels {
  std::vector<SiteLabel> labels;
  std::vector<Point> dots;  ///< in pixels; none without names or RenderOptions::show_sites
  DotSize dot;
};

/// Whether labels are names, which belong to dots, and not indices.
inline bool hasNames(const RenderOptions& options) { return options.labels && !options.texts.empty(); }

/// Marks drawn over cells that need their measures or polygons.
struct Marks {
  std::vector<Line> edges;    ///< between cells
  std::vector<Line> outline;  ///< of the domain, closed
  std::vector<Line> dual;     ///< between sites whose cells share an edge
  std::vector<Line> borders;  ///< RenderOptions::borders, closed
  std::vector<Line> graticule;
  SiteLabels labels;
};

/// Whether a picture in pixels needs cells for its marks, and with which detail.
inline bool marksNeedCells(const RenderOptions& options) {
  return options.dual || options.labels || (options.edges && options.antialias > 1);
}
inline Detail marksDetail(const RenderOptions& options) {
  const bool polygons = options.labels || (options.edges && options.antialias > 1);
  return polygons ? Detail::polygons : Detail::measures;
}

/// Returns the marks of a picture. `cells` are those of the sites with marksDetail(options). Edges and the
/// outline are included if the picture has several samples in a pixel. Error: that of wrapped().
Result<Marks> marksOf(const Sites& sites, const Diagram& cells, const RenderOptions& options,
                      int threads = 0);

/// Returns only the lines of `dual`. `cells` have Detail::measures. Each pair of images has a visible line.
/// Error: that of wrapped().
Result<std::vector<Line>> dualLines(const Sites& sites, const Diagram& cells, const RenderOptions& options,
                                    int threads = 0);

/// Returns only the labels. `cells` have Detail::polygons. A cell has a label if its box fits into the
/// visible part of the cell, beside the site's dot if that lies in the cell, else in the middle. A name
/// without room there stands beside its dot, if it covers no other name and no other dot so. Error: that of
/// wrapped().
Result<SiteLabels> siteLabels(const Sites& sites, const Diagram& cells, const RenderOptions& options,
                              int threads = 0);

/// The color of a label, and of the halo around it.
struct LabelColors {
  std::uint32_t ink;
  std::optional<std::uint32_t> halo;
};
LabelColors colorsOf(const SiteLabel& label, const RenderOptions& options, std::uint32_t cell);

/// How wide the halo is on every side of a stroke, as a part of the label's height.
inline constexpr double halo_part = 0.2;

/// Black or white, whichever stands out from a color; black from one that is mostly transparent.
std::uint32_t inkOn(std::uint32_t rgba);

/// The margin around a label's digits that separates them from lines, in pixels.
double labelMargin(const RenderOptions& options);

/// The width of lines along borders, in pixels.
inline double borderWidth(const RenderOptions& options) { return 2 * options.edge_width + 1; }

/// Seen on white as on dark cells.
inline constexpr std::uint32_t graticule_color = 0xB3808080u;
inline constexpr std::uint32_t dual_color = 0xFF1E32E6u, white = 0xFFFFFFFFu, black = 0xFF000000u;

inline std::uint32_t edgeColor(const RenderOptions& options) {
  constexpr Color usual{0xFF181818u};
  return options.edge_color.value_or(usual).rgba;
}

/// Whether the background shows through the cells.
inline bool cellsShowBackground(const RenderOptions& options) { return !options.fill && options.background; }

/// Whether cells are painted in colors of their sites' own.
inline bool hasOwnColors(const RenderOptions& options) {
  return options.fill && !options.site_colors.empty();
}

/// The color behind marks in cells without fill.
inline std::uint32_t unfilledColor(const RenderOptions& options) {
  return options.background ? options.background->rgba : white;
}

/// Color of dots: white, or what stands out from cells without fill.
inline std::uint32_t dotColor(const RenderOptions& options) {
  return options.fill ? white : inkOn(unfilledColor(options));
}

/// Number of pixel rows whose samples are processed together, if each pixel has several.
inline int rowsAtOnce(int width, int antialias) {
  constexpr std::uint64_t places_at_once = std::uint64_t{1} << 22;
  const auto places = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(antialias * antialias);
  return static_cast<int>(std::clamp<std::uint64_t>(places_at_once / places, 1, largest_side));
}

/// Images that a picture's marks and colors need.
ImagesFor imagesFor(const RenderOptions& options);

}  // namespace vorpipe

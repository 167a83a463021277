/// Pictures of cells, how to compare them and how to check them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "vorpipe/cells.h"
#include "vorpipe/color.h"
#include "vorpipe/result.h"
#include "vorpipe/run.h"
#include "vorpipe/sites.h"

namespace vorpipe {

/// In pixels.
struct PictureSize {
  int width = 0, height = 0;
};

/// Of a picture on paper, in millimeters.
struct PaperSize {
  double width = 0, height = 0;
};

/// Maximum number of pixels of a side.
inline constexpr int largest_side = 32768;

/// The default size of a picture of `domain`: the longer side 1000 pixels, the other at least 1.
PictureSize defaultSize(const Box& domain);

/// The same with another longer side, in pixels.
PictureSize sizeFor(const Box& domain, int longer_side);

enum class ColorBy : std::uint8_t {
  site,
  area,
  neighbors,
  weight,
  distinct,  ///< cells with a common edge differ, with few colors
  value,     ///< RenderOptions::values
};

/// What is known of each site, for colors: a number, or one of several names.
struct SiteValues {
  std::string title{};                   ///< the legend's
  std::vector<double> numbers{};         ///< by site, NaN where there is none; empty if there are names
  std::vector<std::uint32_t> name_of{};  ///< by site: which of `names`, no_site where there is none
  std::vector<std::string> names{};      ///< UTF-8, in the legend's order
  friend bool operator==(const SiteValues&, const SiteValues&) = default;
};

/// Most names that have a color of their own, unless RenderOptions::colors has others: the most frequent.
inline constexpr std::size_t most_names = 20;

/// How values become colors. Values that differ by at most 1e-7 of their size are equal.
enum class ColorScale : std::uint8_t {
  automatic,  ///< quantile by area and by weight, linear by neighbors and values
  linear,
  log,       ///< of values above 0; all others have the first color
  quantile,  ///< by rank: each color gets equally many cells; equal values share their middle rank
};

/// The values of the first and the last color; values beyond get these colors, too. Quantiles are computed
/// from the values inside the range: the least and the greatest of these get the first and the last color.
struct ColorRange {
  double low = 0, high = 0;  ///< low is below high
};

/// How a domain fits into a picture of another aspect ratio.
enum class Fit : std::uint8_t {
  stretch,    ///< the domain fills the picture
  letterbox,  ///< the domain keeps its aspect, in the middle; pixels beside it have no site
};

/// Flat maps of the whole Earth, from 180 degrees west to 180 degrees east.
enum class GlobeMap : std::uint8_t {
  plate_carree,  ///< longitude and latitude, in degrees
  equal_earth,   ///< areas are true (Savric, Patterson and Jenny 2018); meters, as EPSG:8857
};

/// Most own colors of a picture.
inline constexpr std::size_t most_colors = 254;

struct RenderOptions {
  Box domain;         ///< the region drawn; also clips cells
  Outline outline{};  ///< also clips cells, inside the domain; pixels beyond it have no site
  Outline borders{};  ///< drawn over cells and edges as wider lines, inside the outline; clips nothing
  Periodic periodic = Periodic::none;
  int width, height;  ///< pixels, 1 to largest_side each
  ColorBy color = ColorBy::site;
  /// One of colormaps(). Empty: viridis, or for names and distinct cells colors that color-blind people tell
  /// apart.
  std::string colormap{};
  bool edges = false;       ///< darkens pixels that are next to another cell
  bool show_sites = false;  ///< a dot at each site
  SearchOptions search;
  Progress progress;  ///< may be empty
  ColorScale color_scale = ColorScale::automatic;
  std::optional<ColorRange> color_range{};  ///< none: the least and the greatest value of the cells
  /// Draws a legend of the colors in a corner; the picture must be at least least_with_legend pixels.
  bool legend = false;
  double edge_width = 1;  ///< pixels, 1 to 100
  double dot_size =
      0;  ///< diameter of a site's dot, in pixels, up to 100; 0: from the spacing of the visible sites
  Fit fit = Fit::stretch;
  /// The region drawn, if it is not the domain: a part of it, or more than it. It clips no cell and changes
  /// no color; pixels beyond the domain have no site. `fit` then applies to the view.
  std::optional<Box> view{};
  bool fill = true;     ///< cells have colors; else they are white, or show the background
  int antialias = 1;    ///< rows and columns of samples in each pixel, 1 to 8; a pixel gets their mean color
  bool dual = false;    ///< draws lines between sites whose cells share an edge in the domain
  bool labels = false;  ///< draws the index of each site, where there is room for it
  double label_size = 10;             ///< the height of digits, in pixels, 5 to 200
  std::optional<Color> edge_color{};  ///< opaque; none: nearly black
  /// Below everything: shows where no cell is, and through cells without fill. None: pixels without a site
  /// are transparent.
  std::optional<Color> background{};
  /// Own colors of the sites, by input order, R in the lowest byte, opaque; `color` must be ColorBy::site
  /// then. Empty: there are none.
  std::vector<std::uint32_t> site_colors{};
  /// Its size on paper, which files have; None: a pixel is 1/96 inch.
  std::optional<PaperSize> paper{};
  SiteValues values{};               ///< for ColorBy::value
  std::vector<Color> colors{};       ///< own colors instead of a color map, 2 to most_colors
  std::vector<std::string> texts{};  ///< of labels, by site, UTF-8; empty: the sites' indices
  std::string title{};               ///< above the picture, which is higher for it; UTF-8
  std::string legend_title{};        ///< instead of what the colors show; UTF-8
  double legend_factor = 1;          ///< of the numbers in the legend, as 1e-6 for km2 of areas in m2
  bool legend_beside = false;        ///< the legend is right of the picture, which is wider for it
  /// Sites are degrees of longitude and latitude, and cells are those on the sphere (globe.md). The picture
  /// shows all of a map, or a view in the map's unit, in the middle: domain, period, search and fit are not
  /// used.
  bool globe = false;
  GlobeMap map = GlobeMap::plate_carree;
  /// In degrees: the globe as it is seen from far above this place (orthographic), in place of a map.
  std::optional<Point> view_from{};
  /// Degrees between meridians, and between parallels, that are drawn on the map, with its border; 0: none.
  double graticule = 0;
};

/// What the colors of a picture mean: numbers in a range, or names.
struct ColorKey {
  ColorBy color = ColorBy::area;
  ColorScale scale = ColorScale::linear;  ///< never automatic
  ColorRange range{};                     ///< low equals high if all values are equal
  /// Positions along the colors in [0, 1], ascending, with their values; no value twice. Only one tick if all
  /// values are equal.
  std::vector<std::pair<double, double>> ticks{};
  std::string title{};               ///< of values; else empty
  std::vector<std::string> names{};  ///< by color, of those that cells have
  std::uint64_t other_names = 0;     ///< how many further names share one color
  bool has_missing = false;          ///< whether cells have no value
};

/// The colors of cells, as in render.
struct SiteColors {
  std::vector<std::uint32_t> rgba;  ///< by site, in input order
  std::optional<ColorKey> key;      ///< none with ColorBy::site and distinct
};

/// Colors sites as in a picture with these options; sites without a cell do not count. `cells` are those of
/// the same sites. Colors by site do not read them; colors by weight read only their statuses, if there are
/// any. Errors (input): a color map or a scale that is unavailable for these sites; a scale, a range or a
/// legend with colors by site.
Result<SiteColors> siteColors(const Sites& sites, const Diagram& cells, const RenderOptions& options);

/// Refuses (input) a size, an edge width or a dot size out of range, and a legend without room.
Result<void> checkPicture(const RenderOptions& options);

/// The part of a picture that shows the domain.
struct PictureFrame {
  int left = 0, top = 0, width = 0, height = 0;
};

/// Returns the frame of the domain in a picture of width x height pixels. It is the whole picture if the
/// domain is stretched, or if its own aspect would leave at most one pixel.
PictureFrame frameOf(const Box& domain, int width, int height, Fit fit);

/// Size of a site's dot, in pixels.
struct DotSize {
  double radius = 0;
  double rim = 0;  ///< width of a dark inner rim; 0: none
};

/// Returns the dot size for a picture whose frame has this width and height. `size` is
/// RenderOptions::dot_size. If that is 0, dots are about a quarter of `spacing` across. `spacing` is the
/// square root of the median number of pixels in the cells of visible sites.
DotSize dotSizeOf(double size, double spacing, PictureSize picture);

/// Returns the options that compute the same cells as data, with Detail::measures.
CellsOptions cellsOptions(const RenderOptions& picture);

std::vector<std::string> colormaps();

/// The name of the color map of values in a range.
inline std::string colormapOf(const RenderOptions& options) {
  return options.colormap.empty() ? "viridis" : options.colormap;
}

/// Whether colors show values in a range or names, so that a legend can say what they mean.
inline bool colorsHaveKey(ColorBy color) { return color != ColorBy::site && color != ColorBy::distinct; }

/// Whether colors need the cells' measures.
inline bool colorsNeedCells(ColorBy color) {
  return color == ColorBy::area || color == ColorBy::neighbors || color == ColorBy::distinct;
}

/// Row 0 is the top (largest y). The center of pixel (row, column) is
/// x = xmin + (column + 0.5) / width (xmax - xmin), y = ymax - (row + 0.5) / height (ymax - ymin), counted in
/// the frame if the domain does not fill the picture.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint32_t> rgba;  ///< R in the lowest byte
  std::vector<std::uint32_t> ids;   ///< index of the site in the input, or no_site
};

struct Rendering {
  Image image;
  std::vector<Status> status;        ///< by site, in input order
  std::vector<std::uint32_t> owner;  ///< the site that owns the cell: itself unless a duplicate
  std::optional<ColorKey> key;       ///< meaning of the colors; none with ColorBy::site and distinct
  Report report;
};

/// Result of comparing one pixel of two id images.
enum class PixelMatch : std::uint8_t { equal, tie, wrong };

/// A pixel whose center is at most this far, in pixels, from the bisector of two sites may belong to either:
/// backends snap vertices to 1/256 pixel, and draw cells widened by half of that.
inline constexpr double tie_distance = 1.0 / 128;

/// One pixel that two id images give to different sites.
struct IdDifference {
  int row = 0, column = 0;
  std::uint32_t a = no_site, b = no_site;
  double distance =
      0;  ///< from the pixel's center to the bisector of a and b, in pixels; infinite without one
};

struct IdDiff {
  std::uint64_t equal = 0, ties = 0, wrong = 0;
  std::uint64_t ties_allowed = 0;   ///< length of the cell boundaries in pixel sides, frame included
  double widest_tie = 0;            ///< largest distance of a tie
  std::vector<IdDifference> first;  ///< the first 10 wrong pixels in reading order
  IdDifference worst;               ///< the wrong pixel farthest from the bisector; meaningless if wrong is 0
  std::vector<PixelMatch> pixels;
  /// Whether rounding explains every difference.
  [[nodiscard]] bool agree() const { return wrong == 0 && ties <= ties_allowed; }
};

/// Compares two id images of width x height pixels without knowing the sites: every difference is wrong.
IdDiff diffIds(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b, int width, int height);

/// Compares two id images of the same sites and domain, laid out as Image::ids.
///
/// A differing pixel is a tie if its center lies within tie_distance of the bisector of its two sites, and a
/// cell ends at one of its four sides in one of the images. Else it is wrong. It is also wrong if an id names
/// no site or both sites have one position (the lower index owns that cell). This misses no legal difference:
/// a center within the distance of both drawn cells lies on one side of their bisector. The cell on the other
/// side is no nearer than the bisector itself.
///
/// The number of ties is also limited by the length of the cell boundaries, frame included, in the image
/// where it is shorter. If a row of pixel centers lies on a boundary (on a lattice, all may), it gives one
/// tie for each pixel side of that boundary; no legal case gives more.
///
/// In a periodic domain the bisector is that of the images nearest to the center. If the domain does not fill
/// the pictures because of `fit`, a difference outside it is wrong.
///
/// Errors (input): no valid domain; those of wrapped().
Result<IdDiff> diffIds(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b, int width,
                       int height, const Sites& sites, const Box& domain, Periodic periodic = Periodic::none,
                       Fit fit = Fit::stretch);

/// The same for pictures drawn with these options, which give their size, domain, period, fit and view.
///
/// Errors (input): the same; a view that checkView() refuses.
Result<IdDiff> diffIds(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b, const Sites& sites,
                       const RenderOptions& options);

/// One pixel that has different colors in two pictures.
struct ColorDifference {
  int row = 0, column = 0;
  std::uint32_t a = 0, b = 0;  ///< as in Image::rgba
};

/// Where and how much two pictures differ; rows and columns are inclusive and only set when different > 0.
struct ImageDiff {
  std::uint64_t different = 0;  ///< pixels that differ by more than is tolerated
  std::uint64_t close = 0;      ///< pixels that differ, by what is tolerated or less
  int largest = 0;              ///< largest difference of a channel in any pixel, 0 to 255
  int first_row = 0, first_column = 0;
  int top = 0, left = 0, bottom = 0, right = 0;  ///< box of the differing pixels
  std::vector<ColorDifference> first;            ///< the first 10 differing pixels in reading order
  std::vector<PixelMatch> pixels;                ///< `tie` where they are close
};

/// Compares two pictures of width x height RGBA pixels, laid out as Image::rgba. Pixels of which no channel
/// differs by more than `tolerated`, 0 to 255, are close.
ImageDiff diffImages(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b, int width,
                     int height, int tolerated = 0);

/// The same as the other check(), for a picture: statuses and owners, no uncovered pixel, and the nearest
/// site of each pixel in double (of 4 million sampled pixels in larger pictures).
Result<std::vector<std::string>> check(const Sites& sites, const RenderOptions& options,
                                       const Rendering& rendering, int threads = 0);

}  // namespace vorpipe

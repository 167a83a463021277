#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/try.h"
#include "picture/font.h"
#include "picture/text_room.h"
#include "vorpipe.h"
#include "vorpipe/shapes.h"

namespace vorpipe {

using namespace core;

namespace {

/// Returns the size of the dots, about the same in pixel and vector pictures; 0 without dots.
DotSize dotOf(const Diagram& cells, const RenderOptions& options, const PicturePlaces& places) {
  if (!options.show_sites) return {};
  constexpr double least_pixels = 0.5;
  std::vector<double> pixels;
  for (const double area : cells.area) {
    if (const double of_cell = places.pixelsOf(area); of_cell >= least_pixels) pixels.push_back(of_cell);
  }
  double spacing = 0;
  if (!pixels.empty()) {
    const auto middle = pixels.begin() + static_cast<std::ptrdiff_t>(pixels.size() / 2);
    std::ranges::nth_element(pixels, middle);
    spacing = std::sqrt(*middle);
  }
  const PictureFrame& frame = places.frame();
  return dotSizeOf(options.dot_size, spacing, {frame.width, frame.height});
}

/// Returns the rings of a copy of a cell, in pixels.
Room roomOf(const Cell& cell, Point by, const PicturePlaces& places) {
  Room room{{}, {0}, places.pixels()};
  const CellRings rings = cell.rings();
  for (std::size_t r = 0; r < rings.size(); ++r) {
    for (const Point vertex : rings[r]) {
      room.points.push_back(places.pixelOf({vertex.x + by.x, vertex.y + by.y}));
    }
    room.offsets.push_back(rings.end(r) - rings.begin(0));
  }
  return room;
}

/// What names must not cover, by bands of rows.
class Taken {
 public:
  explicit Taken(double band) : band_(band) {}

  void add(const Box& box) {
    const auto [first, last] = bandsOf(box);
    if (last >= bands_.size()) bands_.resize(last + 1);
    for (std::size_t band = first; band <= last; ++band) bands_[band].push_back(box);
  }
  [[nodiscard]] bool meets(const Box& box) const {
    const auto meetsBox = [&box](const Box& other) {
      return box.xmin < other.xmax && other.xmin < box.xmax && box.ymin < other.ymax && other.ymin < box.ymax;
    };
    const auto [first, last] = bandsOf(box);
    for (std::size_t band = first; band <= last && band < bands_.size(); ++band) {
      if (std::ranges::any_of(bands_[band], meetsBox)) return true;
    }
    return false;
  }

 private:
  struct Bands {
    std::size_t first, last;
  };
  [[nodiscard]] Bands bandsOf(const Box& box) const {
    const auto bandAt = [this](double y) { return static_cast<std::size_t>(std::max(0.0, y) / band_); };
    return {bandAt(box.ymin), bandAt(box.ymax)};
  }

  double band_;
  std::vector<std::vector<Box>> bands_;
};

/// A label that does not fit into its cell.
struct WaitingName {
  SiteLabel label;
  TextBox box;
};

bool isIn(const Box& picture, const Box& box) {
  return box.xmin >= picture.xmin && box.xmax <= picture.xmax && box.ymin >= picture.ymin &&
         box.ymax <= picture.ymax;
}

/// Returns how much of a box lies in cells beside its own, of 24 places.
int coveredBeside(const Box& box, std::span<const Room> beside) {
  constexpr int columns = 8, rows = 3;
  int covered = 0;
  for (int place = 0; place < columns * rows; ++place) {
    const double x = (place % columns + 0.5) / columns, y = (place / columns + 0.5) / rows;
    const Point at{box.xmin + x * (box.xmax - box.xmin), box.ymin + y * (box.ymax - box.ymin)};
    const auto holds = [&](const Room& room) { return depthOf(room, at, 1).inside; };
    if (std::ranges::any_of(beside, holds)) ++covered;
  }
  return covered;
}

/// Returns the cells beside one, in pixels.
std::vector<Room> roomsBeside(const Cell& cell, const Diagram& cells, const RenderOptions& options,
                              const PicturePlaces& places) {
  const double width = options.domain.xmax - options.domain.xmin;
  const double height = options.domain.ymax - options.domain.ymin;
  std::vector<Room> rooms;
  for (std::size_t k = 0; k < cell.neighbors().size(); ++k) {
    const std::int64_t neighbor = cell.neighbors()[k];
    if (isWall(neighbor)) continue;
    const auto [across, up] = cell.shifts().empty() ? std::array<std::int32_t, 2>{} : cell.shifts()[k];
    rooms.push_back(
        roomOf(cells.cell(static_cast<std::size_t>(neighbor)), {across * width, up * height}, places));
  }
  return rooms;
}

/// Returns the boxes of a name beside its dot, in the order of their worth.
std::array<Box, 8> boxesBeside(const TextBox& box, Point dot, double radius) {
  constexpr double diagonal = 0.7;
  const double x = radius + box.width / 2, y = radius + box.height / 2;
  const double slant_x = diagonal * radius + box.width / 2, slant_y = diagonal * radius + box.height / 2;
  const std::array<Point, 8> ways{{{x, 0},
                                   {-x, 0},
                                   {0, -y},
                                   {0, y},
                                   {slant_x, -slant_y},
                                   {slant_x, slant_y},
                                   {-slant_x, -slant_y},
                                   {-slant_x, slant_y}}};
  std::array<Box, 8> boxes;
  std::ranges::transform(ways, boxes.begin(), [&](Point way) {
    const Point at{dot.x + way.x, dot.y + way.y};
    return Box{at.x - box.width / 2, at.y - box.height / 2, at.x + box.width / 2, at.y + box.height / 2};
  });
  return boxes;
}

/// Places the labels of `waiting`, which do not fit into their cells, beside the dots of their sites: where
/// they cover no other label and no dot, and as little of other cells as possible.
void addBeyond(std::vector<WaitingName>& waiting, const Sites& at, const Diagram& cells,
               const RenderOptions& options, const Box& picture, SiteLabels& found) {
  const PicturePlaces places(options);
  const double radius = found.dot.radius;
  Taken taken(options.label_size + 2 * labelMargin(options));
  for (const Point dot : found.dots)
    taken.add({dot.x - radius, dot.y - radius, dot.x + radius, dot.y + radius});
  const auto takeLabel = [&](const SiteLabel& label) {
    const double x = label.width / 2, y = options.label_size / 2;
    taken.add({label.middle.x - x, label.middle.y - y, label.middle.x + x, label.middle.y + y});
  };
  for (const SiteLabel& label : found.labels) takeLabel(label);
  for (auto& [label, box] : waiting) {
    const Point dot = places.pixelOf({at.x[label.site], at.y[label.site]});
    if (!isIn(picture, {dot.x, dot.y, dot.x, dot.y})) continue;
    std::vector<Box> free;
    std::ranges::copy_if(boxesBeside(box, dot, radius), std::back_inserter(free),
                         [&](const Box& in) { return isIn(picture, in) && !taken.meets(in); });
    if (free.empty()) continue;
    const auto beside = roomsBeside(cells.cell(label.site), cells, options, places);
    const Box best =
        *std::ranges::min_element(free, {}, [&](const Box& in) { return coveredBeside(in, beside); });
    label.middle = {(best.xmin + best.xmax) / 2, (best.ymin + best.ymax) / 2};
    label.beyond = true;
    takeLabel(label);
    found.labels.push_back(std::move(label));
  }
}

/// Returns the dots of sites that have a cell and lie in the picture.
std::vector<Point> dotsOf(const Sites& at, const Diagram& cells, const Box& picture,
                          const PicturePlaces& places) {
  std::vector<Point> dots;
  for (const Cell cell : cells) {
    if (cell.rings().empty()) continue;
    const Point dot = places.pixelOf({at.x[cell.index()], at.y[cell.index()]});
    if (isIn(picture, {dot.x, dot.y, dot.x, dot.y})) dots.push_back(dot);
  }
  return dots;
}

}  // namespace

double labelMargin(const RenderOptions& options) {
  constexpr double part = 0.2;
  return part * options.label_size;
}

std::uint32_t inkOn(std::uint32_t rgba) {
  constexpr std::uint32_t half_opaque = 128;
  if (rgba >> 24 < half_opaque) return black;
  // Luma of ITU-R BT.601, at most 255.
  constexpr double red = 0.299, green = 0.587, blue = 0.114, middle = 140;
  const auto channel = [&](int shift) { return static_cast<double>(rgba >> shift & 0xFF); };
  return red * channel(0) + green * channel(8) + blue * channel(16) < middle ? white : black;
}

LabelColors colorsOf(const SiteLabel& label, const RenderOptions& options, std::uint32_t cell) {
  constexpr std::uint32_t opaque = 0xFF000000u;
  if (label.beyond) {
    const std::uint32_t paper = unfilledColor(options);
    const std::uint32_t halo = paper >= opaque ? paper : white;
    return {inkOn(halo), halo};
  }
  if (!hasNames(options)) return {inkOn(cell), std::nullopt};
  // Black stands out more from a color than white, by the contrast of WCAG 2 with a gamma of 2, if its
  // luminance is above a fifth. Indices have always been black on somewhat lighter colors alone.
  constexpr std::uint32_t red = 2126, green = 7152, blue = 722, fifth = 255 * 255 * 2000;
  const auto square = [&](int shift) { return (cell >> shift & 0xFF) * (cell >> shift & 0xFF); };
  return {red * square(0) + green * square(8) + blue * square(16) > fifth ? black : white, std::nullopt};
}

Result<SiteLabels> siteLabels(const Sites& sites, const Diagram& cells, const RenderOptions& options,
                              int threads) {
  if (!options.texts.empty() && options.texts.size() != sites.size()) {
    return tl::unexpected(Error{ErrorCode::input, fmt::format("labels: {} texts, where there are {} sites",
                                                              options.texts.size(), sites.size())});
  }
  if (options.globe) {
    VORPIPE_LET(map, cellsOnMap(sites, cells, options, threads));
    return siteLabels(map.sites, map.diagram, map.options, threads);
  }
  const bool periodic = options.periodic != Periodic::none;
  VORPIPE_LET(placed, periodic ? wrapped(sites, options.domain, options.periodic, threads) : Sites{});
  const Sites& at = periodic ? placed : sites;
  const PicturePlaces places(options);
  const Box picture{0, 0, static_cast<double>(options.width), static_cast<double>(options.height)};
  SiteLabels found{{}, {}, dotOf(cells, options, places)};
  const double dot = found.dot.radius;
  const bool may_leave = hasNames(options) && options.show_sites;
  if (may_leave) found.dots = dotsOf(at, cells, picture, places);
  const double margin = labelMargin(options), edge = options.edges ? (options.edge_width + 1) / 2 : 0;
  std::vector<WaitingName> waiting;
  for (const Cell cell : cells) {
    const auto site = static_cast<std::uint32_t>(cell.index());
    std::string text = options.texts.empty() ? std::to_string(site) : options.texts[site];
    if (text.empty() || cell.rings().empty()) continue;
    const double width = unitsOf(text) * options.label_size / letter_units;
    const TextBox box{width + 2 * margin, options.label_size + 2 * margin, edge};
    // Most cells of a large diagram are too small for a text.
    const bool has_room = places.pixelsOf(cell.area()) >= box.width * box.height;
    if (!has_room && !may_leave) continue;
    bool is_placed = false;
    for (const Point by :
         has_room ? shownCopies(boxOf(cell.vertices()), options, places) : std::vector<Point>{}) {
      const Point center = places.pixelOf({cell.centroid().x + by.x, cell.centroid().y + by.y});
      const Point own = places.pixelOf({at.x[site] + by.x, at.y[site] + by.y});
      const Room room = roomOf(cell, by, places);
      const bool beside = dot > 0 && depthOf(room, own, 1).inside;
      const auto middle = beside ? placeBeside(room, box, own, dot) : placeNear(room, box, center);
      if (!middle) continue;
      found.labels.push_back({site, *middle, width, text});
      is_placed = true;
    }
    if (!is_placed && may_leave) waiting.push_back({{site, {}, width, std::move(text)}, box});
  }
  addBeyond(waiting, at, cells, options, picture, found);
  return found;
}

}  // namespace vorpipe

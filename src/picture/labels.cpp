#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "picture/font.h"
#include "picture/room.h"
#include "vorpipe/shapes.h"

namespace vorpipe {

using namespace core;

namespace {

/// Returns the radius of the dots, about the same in pixel and vector pictures; 0 without dots.
double dotRadius(const Diagram& cells, const RenderOptions& options, const PicturePlaces& places) {
  if (!options.show_sites) return 0;
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
  return dotSizeOf(options.dot_size, spacing, {frame.width, frame.height}).radius;
}

/// Returns the rings of a copy of a cell, in pixels.
Room roomOf(const Cell& cell, Point by, const PicturePlaces& places) {
  Room room{{}, {0}, places.pixels()};
  const CellRings rings = cell.rings();
  for (std::size_t r = 0; r < rings.size(); ++r) {
    for (const Point vertex : rings[r]) {
      room.points.push_back(places.pixelOf({vertex.x + by.x, vertex.y + by.y}));
    }
    room.offsets.push_back(room.points.size());
  }
  return room;
}

}  // namespace

double labelMargin(const RenderOptions& options) {
  constexpr double part = 0.2;
  return part * options.label_size;
}

std::uint32_t inkOn(std::uint32_t rgba) {
  // Luma of ITU-R BT.601, at most 255.
  constexpr double red = 0.299, green = 0.587, blue = 0.114, middle = 140;
  const auto channel = [&](int shift) { return static_cast<double>(rgba >> shift & 0xFF); };
  return red * channel(0) + green * channel(8) + blue * channel(16) < middle ? white : black;
}

Result<std::vector<SiteLabel>> siteLabels(const Sites& sites, const Diagram& cells,
                                          const RenderOptions& options, int threads) {
  const bool periodic = options.periodic != Periodic::none;
  const auto placed = periodic ? wrapped(sites, options.domain, options.periodic, threads) : Sites{};
  if (!placed) return tl::unexpected(placed.error());
  const Sites& at = periodic ? *placed : sites;
  const PicturePlaces places(options);
  const double dot = dotRadius(cells, options, places);
  const double margin = labelMargin(options), edge = options.edges ? (options.edge_width + 1) / 2 : 0;
  std::vector<SiteLabel> labels;
  for (const Cell cell : cells) {
    const auto site = static_cast<std::uint32_t>(cell.index());
    std::string text = std::to_string(site);
    const double width = unitsOf(text) * options.label_size / letter_units;
    const TextBox box{width + 2 * margin, options.label_size + 2 * margin, edge};
    // Most cells of a large diagram are too small for a text.
    if (cell.rings().empty() || places.pixelsOf(cell.area()) < box.width * box.height) continue;
    for (const Point by : shownCopies(boxOf(cell.vertices()), options, places)) {
      const Point center = places.pixelOf({cell.centroid().x + by.x, cell.centroid().y + by.y});
      const Point own = places.pixelOf({at.x[site] + by.x, at.y[site] + by.y});
      const Room room = roomOf(cell, by, places);
      const auto middle = dot > 0 ? placeBeside(room, box, own, dot) : placeNear(room, box, center);
      if (middle) labels.push_back({site, *middle, width, text});
    }
  }
  return labels;
}

}  // namespace vorpipe

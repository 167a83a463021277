#include "io/pictures/vector_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "base/try.h"

namespace vorpipe {
namespace {

constexpr std::size_t least_vertices = 3;

/// Longest arc: a Bezier curve of this angle is within 1e-6 of the radius of its circle.
constexpr double longest_piece = std::numbers::pi / 6;

/// Adds the edges that a cell draws, joining connected ones into lines.
template <class Place>
void addEdges(const Cell& cell, Lines& lines, const Place& place) {
  const CellRings rings = cell.rings();
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const auto ring = rings[r];
    const std::size_t first = rings.begin(r) - cell.begin();
    bool drawing = false;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      if (!drawsEdge(cell, first + k)) {
        drawing = false;
        continue;
      }
      if (!drawing) {
        lines.begin();
        lines.add(place(ring[k]));
      }
      lines.add(place(ring[(k + 1) % ring.size()]));
      drawing = true;
    }
  }
}

}  // namespace

void printPixels(Bytes& bytes, double pixels) {
  constexpr std::int64_t one = 10000;
  const std::int64_t steps = std::llround(pixels * one);
  if (steps < 0) bytes.push_back('-');
  const std::int64_t size = std::abs(steps);
  print(bytes, FMT_COMPILE("{}"), size / one);
  if (size % one == 0) return;
  print(bytes, FMT_COMPILE(".{:04}"), size % one);
  while (bytes[bytes.size() - 1] == '0') bytes.resize(bytes.size() - 1);
}

void printPoint(Bytes& bytes, Point point) {
  printPixels(bytes, point.x);
  bytes.push_back(' ');
  printPixels(bytes, point.y);
}

double fontSize(double capital_height) {
  constexpr double capital_height_of_font = 0.718;
  return capital_height / capital_height_of_font;
}

VectorPicture::VectorPicture(const Sites& sites, const Diagram& diagram, const RenderOptions& options)
    : sites_(&sites),
      diagram_(&diagram),
      options_(&options),
      free_surface_(!options.globe && hasFreeSurface(diagram, options.outline)),
      places_(options) {}

Result<VectorPicture> VectorPicture::make(const Sites& sites, const Diagram& diagram,
                                          const RenderOptions& options, int threads) {
  VORPIPE_TRY(checkPicture(options));
  VectorPicture picture(sites, diagram, options);
  VORPIPE_VAR(colors, siteColors(sites, diagram, options));
  picture.colors_ = std::move(colors);
  picture.sheet_ = sheetOf(options, picture.colors_.key);
  if (options.legend && !options.legend_beside && picture.colors_.key) {
    picture.legend_ = legendOf(*picture.colors_.key, options);
  }
  if (options.globe) {
    VORPIPE_VAR(cells, cellsOnMap(sites, diagram, options, threads));
    picture.map_ = std::make_unique<OnMap>(OnMap{std::move(cells), {}, {}});
    if (options.graticule > 0) picture.map_->graticule = graticuleOnMap(options);
    if (options.edges) picture.map_->edges = edgesOnMap(sites, diagram, options, threads);
    picture.sites_ = &picture.map_->cells.sites;
    picture.diagram_ = &picture.map_->cells.diagram;
    picture.options_ = &picture.map_->cells.options;
  }
  if (options.show_sites && !hasNames(options)) {
    VORPIPE_TRY(picture.placeDots(sites, options, threads));
  }
  if (options.dual) {
    VORPIPE_VAR(lines, dualLines(sites, diagram, options, threads));
    picture.dual_ = std::move(lines);
  }
  if (options.labels) {
    VORPIPE_VAR(labels, siteLabels(*picture.sites_, *picture.diagram_, *picture.options_, threads));
    picture.labels_ = std::move(labels);
  }
  if (picture.hasNamedDots()) {
    picture.dots_ = picture.labels_.dots;
    picture.dot_ = picture.labels_.dot;
  }
  return picture;
}

LegendText VectorPicture::textOf(const SiteLabel& label) const {
  const double height = options_->label_size;
  const auto [ink, halo] = colorsOf(label, *options_, color(label.site));
  return {label.middle.x, label.middle.y + height / 2, height, Anchor::middle, label.text, ink, halo};
}

std::optional<LegendBox> VectorPicture::boxBelow(const SiteLabel& label) const {
  if (!options_->dual || label.beyond) return std::nullopt;
  const double margin = labelMargin(*options_);
  const double width = label.width + 2 * margin, height = options_->label_size + 2 * margin;
  return LegendBox{label.middle.x - width / 2, label.middle.y - height / 2, width, height, color(label.site)};
}

/// Places one dot at each position of a site that has a cell there.
Result<void> VectorPicture::placeDots(const Sites& given, const RenderOptions& wanted, int threads) {
  const Sites& sites = *sites_;
  const Box& domain = options_->domain;
  const bool periodic = options_->periodic != Periodic::none;
  VORPIPE_VAR(placed, periodic ? wrapped(sites, domain, options_->periodic, threads) : Sites{});
  const Sites& at = periodic ? placed : sites;
  std::vector<std::uint32_t> shown;
  for (std::uint32_t i = 0; i < at.size(); ++i) {
    const double x = at.x[i], y = at.y[i];
    if (!(x >= domain.xmin && x <= domain.xmax && y >= domain.ymin && y <= domain.ymax)) continue;
    if (diagram_->status[i] != Status::duplicate) shown.push_back(i);
  }
  if (!wanted.outline.empty()) {
    VORPIPE_TRY(keepInOutline(wanted, map_ ? given : at, shown, threads));
  }
  dot_ = dotSizeOf(options_->dot_size, spacingOf(shown), {places_.frame().width, places_.frame().height});
  dots_.reserve(shown.size());
  for (const std::uint32_t i : shown) dots_.push_back(pixelOf({at.x[i], at.y[i]}));
  return {};
}

Result<void> VectorPicture::keepInOutline(const RenderOptions& wanted, const Sites& at,
                                          std::vector<std::uint32_t>& sites, int threads) {
  VORPIPE_VAR(locator, Locator::make(at, cellsOptions(wanted), threads));
  std::vector<Point> places(sites.size());
  std::ranges::transform(sites, places.begin(), [&](std::uint32_t i) { return Point{at.x[i], at.y[i]}; });
  std::vector<std::uint32_t> cells(sites.size());
  locator.at(places, cells);
  std::size_t kept = 0;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (cells[k] != no_site) sites[kept++] = sites[k];
  }
  sites.resize(kept);
  return {};
}

/// Returns the square root of the median pixel count of cells, without cells that have hardly any; 0 if all
/// are such.
double VectorPicture::spacingOf(std::span<const std::uint32_t> sites) const {
  constexpr double least_pixels = 0.5;
  std::vector<double> areas;
  for (const std::uint32_t i : sites) {
    const double area = places_.pixelsOf(diagram_->area[i]);
    if (area >= least_pixels) areas.push_back(area);
  }
  if (areas.empty()) return 0;
  const auto middle = areas.begin() + static_cast<std::ptrdiff_t>(areas.size() / 2);
  std::ranges::nth_element(areas, middle);
  return std::sqrt(*middle);
}

Lines VectorPicture::graticule() const {
  Lines lines;
  for (std::size_t k = 0; map_ && k < map_->graticule.size(); ++k) {
    lines.begin();
    for (const Point place : map_->graticule[k]) lines.add(pixelOf(place));
  }
  return lines;
}

Lines VectorPicture::outline() const { return ringsOf(options_->outline); }
Lines VectorPicture::borders() const { return ringsOf(options_->borders); }

Lines VectorPicture::ringsOf(const Outline& outline) const {
  Lines lines;
  for (std::size_t r = 0; r + 1 < outline.ring_offsets.size(); ++r) {
    lines.begin();
    for (auto k = outline.ring_offsets[r]; k < outline.ring_offsets[r + 1]; ++k) {
      lines.add(pixelOf(outline.points[k]));
    }
  }
  return lines;
}

/// Adds an arc that begins at the last point, in pieces short enough for both formats.
void VectorPicture::addArc(const BorderPart& part, Point site, Lines& lines) const {
  const double radius = std::hypot(part.from.x - site.x, part.from.y - site.y);
  const Point center = pixelOf(site), corner = pixelOf({site.x + radius, site.y + radius});
  const double begin = std::atan2(part.from.y - site.y, part.from.x - site.x);
  const int pieces = std::max(1, static_cast<int>(std::ceil(part.angle / longest_piece)));
  const double step = part.angle / pieces;
  for (int k = 0; k < pieces; ++k) {
    // In pixels, y goes downward.
    const PixelArc arc{center, {corner.x - center.x, center.y - corner.y}, -(begin + k * step), -step};
    lines.addArc(arc, k + 1 < pieces ? arc.at(1) : pixelOf(part.to));
  }
}

void VectorPicture::addRing(const Cell& cell, Lines& lines) const {
  const Point site{sites_->x[cell.index()], sites_->y[cell.index()]};
  const std::vector<BorderPart> border = borderOf(cell, site);
  if (border.empty()) return;
  lines.begin();
  lines.add(pixelOf(border[0].from));
  for (const BorderPart& part : border) {
    if (part.angle > 0) {
      addArc(part, site, lines);
    } else {
      lines.add(pixelOf(part.to));
    }
  }
}

/// Adds the arcs of a cell, each as a line.
void VectorPicture::addSurface(const Cell& cell, Lines& lines) const {
  const Point site{sites_->x[cell.index()], sites_->y[cell.index()]};
  for (const BorderPart& part : borderOf(cell, site)) {
    if (!(part.angle > 0)) continue;
    lines.begin();
    lines.add(pixelOf(part.from));
    addArc(part, site, lines);
  }
}

Result<void> VectorPicture::eachCell(const UseCell& use) const {
  Lines rings;
  for (const Cell cell : *diagram_) {
    const CellRings all = cell.rings();
    if (all.empty()) continue;
    if (free_surface_) {
      rings.clear();
      addRing(cell, rings);
      if (rings.empty()) continue;
      VORPIPE_TRY(use(cell.index(), rings));
      continue;
    }
    for (const Point by : shownCopies(boxOf(cell.vertices()), *options_, places_)) {
      rings.clear();
      for (std::size_t r = 0; r < all.size(); ++r) {
        if (all[r].size() < least_vertices) continue;
        rings.begin();
        for (const Point& vertex : all[r]) rings.add(pixelOf({vertex.x + by.x, vertex.y + by.y}));
      }
      if (rings.empty()) continue;
      VORPIPE_TRY(use(cell.index(), rings));
    }
  }
  return {};
}

Result<void> VectorPicture::eachEdge(const UseLines& use) const {
  Lines lines;
  for (std::size_t k = 0; map_ && k < map_->edges.size(); ++k) {
    lines.clear();
    lines.begin();
    for (const Point place : map_->edges[k]) lines.add(pixelOf(place));
    VORPIPE_TRY(use(lines));
  }
  for (const Cell cell : *diagram_) {
    if (cell.rings().empty() || map_) continue;
    for (const Point by : shownCopies(boxOf(cell.vertices()), *options_, places_)) {
      lines.clear();
      addEdges(cell, lines, [&](Point vertex) { return pixelOf({vertex.x + by.x, vertex.y + by.y}); });
      if (free_surface_) addSurface(cell, lines);
      if (lines.empty()) continue;
      VORPIPE_TRY(use(lines));
    }
  }
  return {};
}

}  // namespace vorpipe

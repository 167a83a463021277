#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <queue>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/inside.h"
#include "base/try.h"
#include "picture/font.h"
#include "vorpipe/shapes.h"

namespace vorpipe {

using namespace core;

namespace {

/// The visible part of a cell, in pixels, y downward: the intersection of its rings, by the even-odd rule,
/// and `shown`.
struct Room {
  std::vector<Point> points;
  std::vector<std::size_t> offsets;  ///< start of each ring in `points`, then the end of the last
  Box shown;
};

/// The box to fit.
struct TextBox {
  double width, height;
  double gap;  ///< to the rings
};

double distance(Point a, Point b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// Returns twice the signed area of a ring; the sign gives its orientation.
double turnOf(std::span<const Point> ring) {
  double sum = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point a = ring[k], b = ring[(k + 1) % ring.size()];
    sum += (a.x - ring[0].x) * (b.y - ring[0].y) - (b.x - ring[0].x) * (a.y - ring[0].y);
  }
  return sum;
}

bool isConvex(const Room& room) {
  if (room.offsets.size() != 2) return false;
  const std::span<const Point> ring(room.points);
  const double turn = turnOf(ring);
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point a = ring[k], b = ring[(k + 1) % ring.size()], c = ring[(k + 2) % ring.size()];
    const double corner = (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x);
    // Rounding may bend straight parts.
    constexpr double straight = 1e-6;
    if (corner * turn < 0 && std::abs(corner) > straight * distance(a, b) * distance(b, c)) return false;
  }
  return true;
}

/// Keeps the part of a convex polygon where (nx, ny) p >= least.
void cut(std::vector<Point>& polygon, double nx, double ny, double least) {
  std::vector<Point> kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point a = polygon[k], b = polygon[(k + 1) % polygon.size()];
    const double over_a = nx * a.x + ny * a.y - least, over_b = nx * b.x + ny * b.y - least;
    if (over_a >= 0) kept.push_back(a);
    if ((over_a > 0 && over_b < 0) || (over_a < 0 && over_b > 0)) {
      const double t = over_a / (over_a - over_b);
      kept.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
    }
  }
  polygon = std::move(kept);
}

/// Returns the region of centers of boxes in `area`.
std::vector<Point> middlesIn(const Box& area, const TextBox& box) {
  const double x = box.width / 2, y = box.height / 2;
  if (area.xmax - area.xmin < box.width || area.ymax - area.ymin < box.height) return {};
  return {{area.xmin + x, area.ymin + y},
          {area.xmax - x, area.ymin + y},
          {area.xmax - x, area.ymax - y},
          {area.xmin + x, area.ymax - y}};
}

/// Returns the region of centers of boxes that fit into a convex room: again a convex polygon.
std::vector<Point> middlesIn(const Room& room, const TextBox& box, const Box& area) {
  std::vector<Point> middles = middlesIn(area, box);
  const std::span<const Point> ring(room.points);
  const double inward = turnOf(ring) > 0 ? 1 : -1;
  for (std::size_t k = 0; k < ring.size() && !middles.empty(); ++k) {
    const Point a = ring[k], b = ring[(k + 1) % ring.size()];
    const double length = distance(a, b);
    if (length == 0) continue;
    const double nx = -inward * (b.y - a.y) / length, ny = inward * (b.x - a.x) / length;
    const double reach = (std::abs(nx) * box.width + std::abs(ny) * box.height) / 2 + box.gap;
    cut(middles, nx, ny, nx * a.x + ny * a.y + reach);
  }
  return middles;
}

/// Returns the point of a convex polygon, with at least one corner, that is nearest to another point.
Point nearestIn(std::span<const Point> polygon, Point p) {
  const double turn = turnOf(polygon);
  bool inside = turn != 0;
  Point nearest = polygon[0];
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point a = polygon[k], b = polygon[(k + 1) % polygon.size()];
    if (((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)) * turn < 0) inside = false;
    const Point here = nearestOnLine(a, b, p);
    if (distance(here, p) < distance(nearest, p)) nearest = here;
  }
  return inside ? p : nearest;
}

Box around(Point middle, const TextBox& box, double gap) {
  const double x = box.width / 2 + gap, y = box.height / 2 + gap;
  return {middle.x - x, middle.y - y, middle.x + x, middle.y + y};
}

/// Whether a line meets a box, by clipping it to the box's sides.
bool meets(Point a, Point b, const Box& box) {
  double from = 0, to = 1;
  const auto keep = [&](double start, double way, double low, double high) {
    if (way == 0) return start > low && start < high;
    const double s = (low - start) / way, t = (high - start) / way;
    from = std::max(from, std::min(s, t));
    to = std::min(to, std::max(s, t));
    return from < to;
  };
  return keep(a.x, b.x - a.x, box.xmin, box.xmax) && keep(a.y, b.y - a.y, box.ymin, box.ymax);
}

/// Whether a box in `area` lies in the room: its center does, and no ring meets it.
bool fits(const Room& room, const TextBox& box, const Box& area, Point middle) {
  const Box own = around(middle, box, 0), wide = around(middle, box, box.gap);
  if (own.xmin < area.xmin || own.ymin < area.ymin || own.xmax > area.xmax || own.ymax > area.ymax)
    return false;
  bool inside = false;
  for (std::size_t r = 0; r + 1 < room.offsets.size(); ++r) {
    const std::size_t begin = room.offsets[r], end = room.offsets[r + 1];
    for (std::size_t k = begin; k < end; ++k) {
      const Point a = room.points[k], b = room.points[k + 1 < end ? k + 1 : begin];
      if (meets(a, b, wide)) return false;
      if ((a.y > middle.y) == (b.y > middle.y)) continue;
      if (middle.x < a.x + (middle.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
    }
  }
  return inside;
}

/// Whether a point lies in the room, and its distance to the nearest ring.
struct Depth {
  bool inside;
  double distance;
};

Depth depthOf(const Room& room, Point p, double down) {
  Depth depth{false, std::numeric_limits<double>::infinity()};
  for (std::size_t r = 0; r + 1 < room.offsets.size(); ++r) {
    const std::size_t begin = room.offsets[r], end = room.offsets[r + 1];
    for (std::size_t k = begin; k < end; ++k) {
      const Point a = room.points[k], b = room.points[k + 1 < end ? k + 1 : begin];
      const Point near = nearestOnLine({a.x, a.y * down}, {b.x, b.y * down}, {p.x, p.y * down});
      depth.distance = std::min(depth.distance, std::hypot(near.x - p.x, near.y - p.y * down));
      if ((a.y > p.y) == (b.y > p.y)) continue;
      if (p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) depth.inside = !depth.inside;
    }
  }
  return depth;
}

/// Returns the place that is farthest from the rings, to a pixel: its pole of inaccessibility. Distances
/// downward count more, as a text is wider than high. Searches squares that may hold a deeper place, the most
/// promising first, and quarters them (as Agafonkin's polylabel does).
Point poleOf(const Room& room, const TextBox& box, const Box& in) {
  const double down = box.width / box.height;
  struct Square {
    Point middle;
    double half, depth, most;
    bool operator<(const Square& other) const { return most < other.most; }
  };
  const auto square = [&](Point middle, double half) {
    const Depth at = depthOf(room, middle, down);
    const double depth = at.inside ? at.distance : -at.distance;
    return Square{middle, half, depth, depth + half * std::numbers::sqrt2};
  };
  const double half = std::max(in.xmax - in.xmin, (in.ymax - in.ymin) * down) / 2;
  const Point middle{(in.xmin + in.xmax) / 2, (in.ymin + in.ymax) / 2};
  Square best = square(middle, half);
  std::priority_queue<Square> squares;
  squares.push(best);
  constexpr double precision = 1;
  while (!squares.empty() && squares.top().most > best.depth + precision) {
    const Square at = squares.top();
    squares.pop();
    const double part = at.half / 2;
    for (const auto& [x, y] :
         {Point{-part, -part}, Point{part, -part}, Point{-part, part}, Point{part, part}}) {
      const Square quarter = square({at.middle.x + x, at.middle.y + y / down}, part);
      if (quarter.depth > best.depth) best = quarter;
      if (quarter.most > best.depth + precision) squares.push(quarter);
    }
  }
  return best.middle;
}

/// Tries the place itself, then the deepest one, then others in rows and columns over the room.
std::optional<Point> tryPlaces(const Room& room, const TextBox& box, const Box& area, Point near) {
  if (fits(room, box, area, near)) return near;
  constexpr int steps = 24;
  const Box all = boxOf(room.points);
  const Box in{std::max(all.xmin, area.xmin), std::max(all.ymin, area.ymin), std::min(all.xmax, area.xmax),
               std::min(all.ymax, area.ymax)};
  if (!(in.xmin < in.xmax && in.ymin < in.ymax)) return std::nullopt;
  if (const Point pole = poleOf(room, box, in); fits(room, box, area, pole)) return pole;
  std::optional<Point> best;
  for (int row = 0; row < steps; ++row) {
    for (int column = 0; column < steps; ++column) {
      const Point at{in.xmin + (column + 0.5) / steps * (in.xmax - in.xmin),
                     in.ymin + (row + 0.5) / steps * (in.ymax - in.ymin)};
      if (best && distance(at, near) >= distance(*best, near)) continue;
      if (fits(room, box, area, at)) best = at;
    }
  }
  return best;
}

std::optional<Point> placeIn(const Room& room, const TextBox& box, const Box& area, Point near) {
  if (room.points.empty()) return std::nullopt;
  if (!isConvex(room)) return tryPlaces(room, box, area, near);
  const auto middles = middlesIn(room, box, area);
  if (middles.empty()) return std::nullopt;
  return nearestIn(middles, near);
}

/// Returns the center of a box that fits into the room, as near to a place as possible; none if it does not
/// fit. In a nonconvex room it only tries some places, so it may miss others.
std::optional<Point> placeNear(const Room& room, const TextBox& box, Point near) {
  return placeIn(room, box, room.shown, near);
}

/// The same beside a dot with this radius: below, above, right or left of it, whichever is nearest.
std::optional<Point> placeBeside(const Room& room, const TextBox& box, Point dot, double radius) {
  std::array<Box, 4> sides{room.shown, room.shown, room.shown, room.shown};
  sides[0].ymin = std::max(sides[0].ymin, dot.y + radius);
  sides[1].ymax = std::min(sides[1].ymax, dot.y - radius);
  sides[2].xmin = std::max(sides[2].xmin, dot.x + radius);
  sides[3].xmax = std::min(sides[3].xmax, dot.x - radius);
  std::optional<Point> best;
  for (const Box& side : sides) {
    const auto at = placeIn(room, box, side, dot);
    if (at && (!best || distance(*at, dot) < distance(*best, dot))) best = at;
  }
  return best;
}

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
    room.offsets.push_back(rings.end(r) - rings.begin(0));
  }
  return room;
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

Result<std::vector<SiteLabel>> siteLabels(const Sites& sites, const Diagram& cells,
                                          const RenderOptions& options, int threads) {
  if (!options.texts.empty() && options.texts.size() != sites.size()) {
    return tl::unexpected(Error{ErrorCode::input, fmt::format("labels: {} texts, where there are {} sites",
                                                              options.texts.size(), sites.size())});
  }
  const bool periodic = options.periodic != Periodic::none;
  VORPIPE_LET(placed, periodic ? wrapped(sites, options.domain, options.periodic, threads) : Sites{});
  const Sites& at = periodic ? placed : sites;
  const PicturePlaces places(options);
  const double dot = dotRadius(cells, options, places);
  const double margin = labelMargin(options), edge = options.edges ? (options.edge_width + 1) / 2 : 0;
  std::vector<SiteLabel> labels;
  for (const Cell cell : cells) {
    const auto site = static_cast<std::uint32_t>(cell.index());
    const std::string text = options.texts.empty() ? std::to_string(site) : options.texts[site];
    if (text.empty()) continue;
    const double width = unitsOf(text) * options.label_size / letter_units;
    const TextBox box{width + 2 * margin, options.label_size + 2 * margin, edge};
    // Most cells of a large diagram are too small for a text.
    if (cell.rings().empty() || places.pixelsOf(cell.area()) < box.width * box.height) continue;
    for (const Point by : shownCopies(boxOf(cell.vertices()), options, places)) {
      const Point center = places.pixelOf({cell.centroid().x + by.x, cell.centroid().y + by.y});
      const Point own = places.pixelOf({at.x[site] + by.x, at.y[site] + by.y});
      const Room room = roomOf(cell, by, places);
      const bool beside = dot > 0 && depthOf(room, own, 1).inside;
      const auto middle = beside ? placeBeside(room, box, own, dot) : placeNear(room, box, center);
      if (middle) labels.push_back({site, *middle, width, text});
    }
  }
  return labels;
}

}  // namespace vorpipe

#include "support/hard/hard_domains.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "support/hard/stepped_outline.h"

namespace vorpipe::test {
namespace {

double width(const Box& box) { return box.xmax - box.xmin; }
double height(const Box& box) { return box.ymax - box.ymin; }
double longer(const Box& box) { return std::max(width(box), height(box)); }

Box boxAbout(Point center, double half_width, double half_height) {
  return {center.x - half_width, center.y - half_height, center.x + half_width, center.y + half_height};
}

Point someSite(const Sites& sites, Random& random) {
  const auto i = random.below(sites.size());
  return {sites.x[i], sites.y[i]};
}

Box ofFiles(const Sites& sites, const Box&, Random&) { return boxOfFile(sites); }

Box unitSquare(const Sites&, const Box&, Random&) { return {0, 0, 1, 1}; }

/// Smaller than what the sites extend over, in the proportions of 0.25,0.25,0.5,0.75.
Box quarter(const Sites&, const Box& around, Random&) {
  const double x = around.xmin, y = around.ymin, side = longer(around);
  return {x + 0.25 * side, y + 0.25 * side, x + 0.5 * side, y + 0.75 * side};
}

Box quarterOfUnit(const Sites&, const Box&, Random&) { return {0.25, 0.25, 0.5, 0.75}; }

Box part(const Sites&, const Box& around, Random& random) {
  const auto ends = [&](double low, double length) {
    const double a = random.uniform(), b = random.uniform();
    return std::array{low + std::min(a, b) * length, low + std::max(a, b) * length};
  };
  const auto x = ends(around.xmin, longer(around));
  const auto y = ends(around.ymin, longer(around));
  return {x[0], y[0], x[1], y[1]};
}

/// Its walls run through the outermost sites.
Box tight(const Sites&, const Box& around, Random&) { return around; }

/// Its walls run through some sites.
Box throughSites(const Sites& sites, const Box& around, Random& random) {
  const Point low = someSite(sites, random);
  const double side = longer(around) * tenTo(random, -3, 0);
  return {low.x, low.y, low.x + side, low.y + side * oneOf(random, {1.0, 0.5, 0.01})};
}

Box tinyAboutSite(const Sites& sites, const Box& around, Random& random) {
  const double half = longer(around) * tenTo(random, -12, -2);
  return boxAbout(someSite(sites, random), half, half * tenTo(random, -1, 0));
}

/// The place that is as far from three sites, or one of these if they are on a line.
Point someVertex(const Sites& sites, Random& random) {
  const Point a = someSite(sites, random), b = someSite(sites, random), c = someSite(sites, random);
  const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
  const double twice = 2 * (bx * cy - by * cx);
  if (twice == 0) return a;
  const double bb = bx * bx + by * by, cc = cx * cx + cy * cy;
  return {a.x + (cy * bb - by * cc) / twice, a.y + (bx * cc - cx * bb) / twice};
}

Box tinyAboutVertex(const Sites& sites, const Box& around, Random& random) {
  const Point center = someVertex(sites, random);
  const double half = longer(around) * tenTo(random, -12, -2);
  return boxAbout(center, half, half);
}

Box farAway(const Sites&, const Box& around, Random& random) {
  const double away = longer(around) * tenTo(random, 0, 6);
  const Point d = direction(random);
  const double half = longer(around) * tenTo(random, -2, 1);
  return boxAbout({around.xmin + away * d.x, around.ymin + away * d.y}, half, half);
}

Box flat(const Sites& sites, const Box& around, Random& random) {
  const double half = longer(around), thin = half * tenTo(random, -6, -3);
  const Point center = someSite(sites, random);
  return onceIn(random, 2) ? boxAbout(center, half, thin) : boxAbout(center, thin, half);
}

Box wide(const Sites& sites, const Box& around, Random& random) {
  const double half = longer(around) * tenTo(random, 0, 9);
  return boxAbout(someSite(sites, random), half, half * random.uniform());
}

/// A hair from an axis at one end, or at both ends that are near it.
Box besideAxes(const Sites&, const Box& around, Random& random) {
  const double side = longer(around);
  const auto along = [&](double& low, double& high) {
    const double hair = oneOf(random, {1.0, -1.0}) * side * tenTo(random, -320, -9);
    const bool is_low = onceIn(random, 2);
    low = is_low ? hair : -side;
    high = is_low ? side : hair;
  };
  Box box{};
  along(box.xmin, box.xmax);
  along(box.ymin, box.ymax);
  return box;
}

constexpr std::array<HardDomain, 19> domains{{{"file's", ofFiles},
                                              {"file's", ofFiles},
                                              {"file's", ofFiles},
                                              {"file's", ofFiles},
                                              {"unit", unitSquare},
                                              {"unit", unitSquare},
                                              {"unit", unitSquare},
                                              {"quarter", quarter},
                                              {"unit's quarter", quarterOfUnit},
                                              {"unit's quarter", quarterOfUnit},
                                              {"part", part},
                                              {"tight", tight},
                                              {"sites' walls", throughSites},
                                              {"site's tiny", tinyAboutSite},
                                              {"vertex's tiny", tinyAboutVertex},
                                              {"far", farAway},
                                              {"flat", flat},
                                              {"wide", wide},
                                              {"axes", besideAxes}}};

using Ring = std::vector<Point>;

/// Once around a center that sees all of it; some of its points are sites or vertices, or on lines with the
/// center.
Ring starAbout(Point center, double radius, const Sites& sites, Random& random) {
  const std::uint64_t points = 3 + random.below(12);
  const double rough = oneOf(random, {0.0, 0.3, 0.9});
  Ring ring;
  for (std::uint64_t k = 0; k < points; ++k) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(points);
    const double away = radius * (1 - rough * random.uniform());
    ring.push_back({center.x + away * std::cos(angle), center.y + away * std::sin(angle)});
  }
  if (onceIn(random, 3)) ring[random.below(points)] = someSite(sites, random);
  const Point vertex = someVertex(sites, random);
  if (std::hypot(vertex.x - center.x, vertex.y - center.y) < radius && onceIn(random, 2))
    ring[random.below(points)] = vertex;
  return ring;
}

Ring rectangle(const Box& box) {
  return {{box.xmin, box.ymin}, {box.xmax, box.ymin}, {box.xmax, box.ymax}, {box.xmin, box.ymax}};
}

Ring scaledAbout(const Ring& ring, Point center, double by) {
  Ring scaled;
  for (const Point p : ring)
    scaled.push_back({center.x + by * (p.x - center.x), center.y + by * (p.y - center.y)});
  return scaled;
}

/// Ascending, from `low` to `high`: some of the values, and places halfway between two of them.
std::vector<double> linesAmid(const std::vector<double>& values, double low, double high, Random& random) {
  std::vector<double> lines{low, high};
  for (auto n = 1 + random.below(12); n > 0; --n) {
    const double a = values[random.below(values.size())], b = values[random.below(values.size())];
    const double line = onceIn(random, 3) ? a : a + (b - a) / 2;
    if (low < line && line < high) lines.push_back(line);
  }
  std::ranges::sort(lines);
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  return lines;
}

void addRing(Outline& outline, const Ring& ring) {
  outline.points.insert(outline.points.end(), ring.begin(), ring.end());
  outline.ring_offsets.push_back(outline.points.size());
}

}  // namespace

Box boxOfFile(const Sites& sites) {
  const auto [xmin, xmax] = std::ranges::minmax(sites.x);
  const auto [ymin, ymax] = std::ranges::minmax(sites.y);
  const double extent = std::max(xmax - xmin, ymax - ymin);
  const double largest = std::max({std::abs(xmin), std::abs(xmax), std::abs(ymin), std::abs(ymax)});
  // Far from the origin a twentieth may be less than a coordinate can tell.
  const double margin = std::max(extent > 0 ? 0.05 * extent : 0.5, largest * 0x1p-40);
  return {xmin - margin, ymin - margin, xmax + margin, ymax + margin};
}

std::span<const HardDomain> hardDomains() { return domains; }

Outline hardOutline(const Sites& sites, const Box& box, Random& random) {
  // Part of a box may be too narrow for doubles.
  if (onceIn(random, 2) && width(box) > 0 && height(box) > 0) {
    const auto xs = linesAmid(sites.x, box.xmin, box.xmax, random);
    return steppedOutline(xs, linesAmid(sites.y, box.ymin, box.ymax, random), random);
  }
  const Point center{(box.xmin + box.xmax) / 2, (box.ymin + box.ymax) / 2};
  const double radius = 0.5 * std::min(width(box), height(box));
  Outline outline{{}, {0}, {0}};
  const Ring outer = onceIn(random, 3) ? rectangle(box) : starAbout(center, radius, sites, random);
  addRing(outline, outer);
  if (onceIn(random, 2)) {
    const double by = oneOf(random, {0.5, 0.01, 1e-6});
    addRing(outline, scaledAbout(outer, center, by));
    outline.polygon_offsets.push_back(2);
    if (onceIn(random, 2)) {
      addRing(outline, scaledAbout(outer, center, by / 2));
      outline.polygon_offsets.push_back(3);
    }
    return outline;
  }
  outline.polygon_offsets.push_back(1);
  if (onceIn(random, 2)) {
    const Point beside{center.x + 2.5 * radius, center.y};
    addRing(outline,
            starAbout(beside, radius * oneOf(random, {1.0, 1e-3}), {{beside.x}, {beside.y}, {}}, random));
    outline.polygon_offsets.push_back(2);
  }
  return outline;
}

}  // namespace vorpipe::test

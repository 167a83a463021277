#include "picture/strokes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/parallel.h"
#include "picture/blend.h"

namespace vorpipe::core {
namespace {

/// Rows that one thread draws at a time.
constexpr int band_rows = 64;

struct Interval {
  double low = std::numeric_limits<double>::infinity(), high = -low;

  void add(double from, double to) {
    low = std::min(low, from);
    high = std::max(high, to);
  }
};

/// Returns the interval of x in which `slope` x + `offset` lies in [0, most].
Interval within(double slope, double offset, double most) {
  constexpr double all = std::numeric_limits<double>::infinity();
  if (slope == 0) return offset >= 0 && offset <= most ? Interval{-all, all} : Interval{};
  const double a = -offset / slope, b = (most - offset) / slope;
  return {std::min(a, b), std::max(a, b)};
}

/// Returns the part of the row at height y that a line of width 2 `radius` with round ends covers.
Interval covered(const Line& line, double radius, double y) {
  Interval row;
  for (const Point end : {line.from, line.to}) {
    const double square = radius * radius - (y - end.y) * (y - end.y);
    if (square >= 0) row.add(end.x - std::sqrt(square), end.x + std::sqrt(square));
  }
  const Point way{line.to.x - line.from.x, line.to.y - line.from.y};
  const double length = std::hypot(way.x, way.y);
  if (length == 0) return row;
  const Point along{way.x / length, way.y / length};
  const double down = y - line.from.y;
  // Between the ends, and beside the line: both are linear in x. The line is convex, so that it covers one
  // interval of the row.
  const Interval between = within(along.x, down * along.y - line.from.x * along.x, length);
  const Interval beside = within(-along.y, down * along.x + line.from.x * along.y + radius, 2 * radius);
  const double low = std::max(between.low, beside.low), high = std::min(between.high, beside.high);
  if (low <= high) row.add(low, high);
  return row;
}

/// Returns the first of `count` places at or after a coordinate; the places begin at `begin`.
int firstFrom(double at, double begin, int in_pixel, int count) {
  return static_cast<int>(
      std::clamp(std::ceil((at - begin) * in_pixel - 0.5), 0.0, static_cast<double>(count)));
}

int firstAfter(double at, double begin, int in_pixel, int count) {
  return static_cast<int>(
      std::clamp(std::floor((at - begin) * in_pixel - 0.5) + 1, 0.0, static_cast<double>(count)));
}

/// Rows of an image that a line may cover, from `first` to before `last`.
struct Rows {
  int first, last;
};

Rows rowsOf(const Line& line, double radius, const Places& places, int height) {
  const double top = std::min(line.from.y, line.to.y) - radius;
  const double bottom = std::max(line.from.y, line.to.y) + radius;
  return {firstFrom(top, places.top, places.in_pixel, height),
          firstAfter(bottom, places.top, places.in_pixel, height)};
}

/// For each band of rows, the lines that may cover part of it.
struct Bands {
  std::vector<std::size_t> offsets;
  std::vector<std::uint32_t> lines;
};

Bands bandsOf(std::span<const Line> lines, double radius, const Places& places, int height) {
  const auto count = static_cast<std::size_t>((height + band_rows - 1) / band_rows);
  const auto each = [&](std::size_t k, const auto& take) {
    const Rows rows = rowsOf(lines[k], radius, places, height);
    if (rows.first >= rows.last) return;
    for (int band = rows.first / band_rows; band <= (rows.last - 1) / band_rows; ++band) {
      take(static_cast<std::size_t>(band));
    }
  };
  Bands bands;
  bands.offsets.assign(count + 2, 0);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    each(k, [&](std::size_t band) { ++bands.offsets[band + 2]; });
  }
  for (std::size_t b = 2; b < bands.offsets.size(); ++b) bands.offsets[b] += bands.offsets[b - 1];
  bands.lines.resize(bands.offsets.back());
  for (std::size_t k = 0; k < lines.size(); ++k) {
    each(k,
         [&](std::size_t band) { bands.lines[bands.offsets[band + 1]++] = static_cast<std::uint32_t>(k); });
  }
  bands.offsets.pop_back();
  return bands;
}

/// The pen, and the part of a picture that it draws into.
struct Pen {
  double radius;
  std::uint32_t color;
  const Places& places;
  Image& image;

  void draw(const Line& line, Rows rows) const {
    for (int row = rows.first; row < rows.last; ++row) {
      const Interval in = covered(line, radius, places.y(row));
      if (!(in.low <= in.high)) continue;
      const int end = firstAfter(in.high, places.left, places.in_pixel, image.width);
      for (int column = firstFrom(in.low, places.left, places.in_pixel, image.width); column < end;
           ++column) {
        const auto at = pixelAt(image, row, column);
        if (image.ids[at] != no_site) image.rgba[at] = color;
      }
    }
  }
};

}  // namespace

void drawLines(std::span<const Line> lines, double width, std::uint32_t color, const Places& places,
               int threads, Image& image) {
  if (lines.empty()) return;
  const Pen pen{width / 2, color, places, image};
  const Bands bands = bandsOf(lines, pen.radius, places, image.height);
  parallelFor(bands.offsets.size() - 1, 1, threadsForSteps(image.ids.size(), threads),
              [&](std::size_t begin, std::size_t end) {
                for (std::size_t band = begin; band < end; ++band) {
                  const int top = static_cast<int>(band) * band_rows;
                  for (auto k = bands.offsets[band]; k < bands.offsets[band + 1]; ++k) {
                    const Line& line = lines[bands.lines[k]];
                    const Rows rows = rowsOf(line, pen.radius, places, image.height);
                    pen.draw(line, {std::max(top, rows.first), std::min(top + band_rows, rows.last)});
                  }
                }
              });
}

}  // namespace vorpipe::core

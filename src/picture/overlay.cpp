#include "picture/overlay.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/parallel.h"
#include "picture/pixels.h"

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

double distanceTo(const Line& line, Point at) {
  const Point way{line.to.x - line.from.x, line.to.y - line.from.y};
  const Point off{at.x - line.from.x, at.y - line.from.y};
  const double squared = way.x * way.x + way.y * way.y;
  const double part = squared > 0 ? std::clamp((off.x * way.x + off.y * way.y) / squared, 0.0, 1.0) : 0;
  return std::hypot(off.x - part * way.x, off.y - part * way.y);
}

/// Returns the first of `count` samples at or after a coordinate; the samples begin at `begin`.
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

Rows rowsOf(const Line& line, double radius, const SampleGrid& samples, int height) {
  const double top = std::min(line.from.y, line.to.y) - radius;
  const double bottom = std::max(line.from.y, line.to.y) + radius;
  return {firstFrom(top, samples.top, samples.in_pixel, height),
          firstAfter(bottom, samples.top, samples.in_pixel, height)};
}

/// Returns for each band of rows the lines that may cover part of it, in order.
std::vector<std::vector<std::uint32_t>> bandsOf(std::span<const Line> lines, double radius,
                                                const SampleGrid& samples, int height) {
  std::vector<std::vector<std::uint32_t>> bands(
      static_cast<std::size_t>((height + band_rows - 1) / band_rows));
  for (std::uint32_t k = 0; k < lines.size(); ++k) {
    const Rows rows = rowsOf(lines[k], radius, samples, height);
    if (rows.first >= rows.last) continue;
    for (int band = rows.first / band_rows; band <= (rows.last - 1) / band_rows; ++band) {
      bands[static_cast<std::size_t>(band)].push_back(k);
    }
  }
  return bands;
}

/// The pen, and the part of a picture that it draws into.
struct Pen {
  double radius;
  std::uint32_t color;
  const SampleGrid& samples;
  Image& image;

  void draw(const Line& line, Rows rows) const {
    for (int row = rows.first; row < rows.last; ++row) {
      const Interval in = covered(line, radius, samples.y(row));
      if (!(in.low <= in.high)) continue;
      const int end = firstAfter(in.high, samples.left, samples.in_pixel, image.width);
      for (int column = firstFrom(in.low, samples.left, samples.in_pixel, image.width); column < end;
           ++column) {
        const auto at = pixelAt(image, row, column);
        if (image.ids[at] != no_site) image.rgba[at] = color;
      }
    }
  }
};

/// If the cell ends at the outline on its left or upper side, its own pixel is an edge pixel.
bool isEdge(const Image& image, int row, int column) {
  const auto& ids = image.ids;
  const auto here = pixelAt(image, row, column);
  const auto width = static_cast<std::size_t>(image.width);
  const std::uint32_t id = ids[here];
  if (id == no_site) return false;
  return (column + 1 < image.width && ids[here + 1] != id) ||
         (row + 1 < image.height && ids[here + width] != id) || (column > 0 && ids[here - 1] == no_site) ||
         (row > 0 && ids[here - width] == no_site);
}

/// A disk whose diameter is a whole number of pixels. If it is odd, its center is the center of an edge
/// pixel, and steps to pixels count from 0. If it is even, its center is the lower right corner, where cells
/// meet, and steps count from 1.
class Disk {
 public:
  explicit Disk(int across) : first_(across % 2 == 0 ? 1 : 0) {
    const double radius = (across - 1 + first_) / 2.0, offset = first_ / 2.0;
    for (int rows = 0; rows - offset <= radius; ++rows) {
      const double rest = radius * radius - (rows - offset) * (rows - offset);
      reach_.push_back(static_cast<std::uint8_t>(std::sqrt(rest) + offset));
    }
  }

  /// Steps to the edge pixel itself, and to those on its left and above.
  [[nodiscard]] int first() const { return first_; }
  /// Maximum steps in rows.
  [[nodiscard]] int rows() const { return static_cast<int>(reach_.size()) - 1; }
  /// Steps from the center's row to another.
  [[nodiscard]] int rowsFrom(int center, int row) const {
    return row > center ? row - center : center - row + first_;
  }
  /// Maximum steps in columns, in a row that is `rows` steps from that of the center.
  [[nodiscard]] std::uint8_t columns(int rows) const { return reach_[static_cast<std::size_t>(rows)]; }

 private:
  int first_;
  std::vector<std::uint8_t> reach_;
};

/// Measures the steps of each pixel of a row from the nearest edge pixel of that row, up to the range of a
/// byte.
void measureRow(const Image& image, int row, const Disk& disk, std::uint8_t* steps) {
  constexpr int far = std::numeric_limits<std::uint8_t>::max();
  int reached = far;
  for (int column = 0; column < image.width; ++column) {
    reached = std::min(far, reached + 1);
    steps[column] = static_cast<std::uint8_t>(reached);
    if (isEdge(image, row, column)) reached = 0;
  }
  reached = far;
  for (int column = image.width - 1; column >= 0; --column) {
    reached = isEdge(image, row, column) ? disk.first() : std::min(far, reached + 1);
    steps[column] = static_cast<std::uint8_t>(std::min<int>(steps[column], reached));
  }
}

/// Colors rows begin to end. Rows of distances are kept while the disk reaches them.
void widenRows(Image& image, const Disk& disk, std::uint32_t color, int begin, int end) {
  const int reach = disk.rows(), kept = 2 * reach + 1;
  const auto width = static_cast<std::size_t>(image.width);
  std::vector<std::uint8_t> distances(static_cast<std::size_t>(kept) * width);
  std::vector<std::uint8_t> dark(width);
  const auto rowOf = [&](int row) { return distances.data() + static_cast<std::size_t>(row % kept) * width; };
  int next = std::max(0, begin - reach);
  for (int row = begin; row < end; ++row) {
    const int last = std::min(image.height - 1, row + reach);
    for (; next <= last; ++next) measureRow(image, next, disk, rowOf(next));
    std::ranges::fill(dark, std::uint8_t{0});
    for (int other = std::max(0, row - reach); other <= last; ++other) {
      const int rows = disk.rowsFrom(other, row);
      if (rows > reach) continue;
      const std::uint8_t most = disk.columns(rows);
      const std::uint8_t* distance = rowOf(other);
      for (std::size_t column = 0; column < width; ++column) {
        dark[column] = static_cast<std::uint8_t>(dark[column] | (distance[column] <= most ? 1 : 0));
      }
    }
    const auto first = pixelAt(image, row, 0);
    for (std::size_t column = 0; column < width; ++column) {
      if (dark[column] != 0 && image.ids[first + column] != no_site) image.rgba[first + column] = color;
    }
  }
}

/// Draws a dot around a place, all in pixels of the image.
void drawDot(Image& image, Point at, const DotSize& dot, std::uint32_t color) {
  const int reach = static_cast<int>(std::ceil(dot.radius));
  const int center_column = static_cast<int>(std::floor(at.x)),
            center_row = static_cast<int>(std::floor(at.y));
  const int left = std::max(0, center_column - reach);
  const int right = std::min(image.width - 1, center_column + reach);
  const int bottom = std::min(image.height - 1, center_row + reach);
  for (int row = std::max(0, center_row - reach); row <= bottom; ++row) {
    for (int column = left; column <= right; ++column) {
      const double distance = std::hypot(column + 0.5 - at.x, row + 0.5 - at.y);
      const auto pixel = pixelAt(image, row, column);
      // The smallest dot may contain no pixel center.
      const bool inside = distance <= dot.radius || (row == center_row && column == center_column);
      if (!inside || image.ids[pixel] == no_site) continue;
      image.rgba[pixel] = distance > dot.radius - dot.rim && dot.rim > 0 ? black : color;
    }
  }
}

}  // namespace

void drawLines(std::span<const Line> lines, double width, std::uint32_t color, const SampleGrid& samples,
               int threads, Image& image) {
  if (lines.empty()) return;
  const Pen pen{width / 2, color, samples, image};
  const auto bands = bandsOf(lines, pen.radius, samples, image.height);
  parallelFor(bands.size(), 1, threadsForSteps(image.ids.size(), threads),
              [&](std::size_t begin, std::size_t end) {
                for (std::size_t band = begin; band < end; ++band) {
                  const int top = static_cast<int>(band) * band_rows;
                  for (const auto k : bands[band]) {
                    const Line& line = lines[k];
                    const Rows rows = rowsOf(line, pen.radius, samples, image.height);
                    pen.draw(line, {std::max(top, rows.first), std::min(top + band_rows, rows.last)});
                  }
                }
              });
}

void blendLines(std::span<const Line> lines, double width, std::uint32_t color, int threads, Image& image) {
  const double radius = (width + 1) / 2;
  const auto bands = static_cast<std::size_t>((image.height + band_rows - 1) / band_rows);
  parallelFor(bands, 1, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<double> parts;
    for (auto band = begin; band < end; ++band) {
      const int top = static_cast<int>(band) * band_rows, bottom = std::min(image.height, top + band_rows);
      parts.assign(static_cast<std::size_t>(bottom - top) * static_cast<std::size_t>(image.width), 0);
      for (const Line& line : lines) {
        const Rows rows = rowsOf(line, radius, {}, image.height);
        for (int row = std::max(top, rows.first); row < std::min(bottom, rows.last); ++row) {
          const Interval wide = covered(line, radius, row + 0.5);
          const int last = firstAfter(wide.high, 0, 1, image.width);
          for (int column = firstFrom(wide.low, 0, 1, image.width); column < last; ++column) {
            const double part = radius - distanceTo(line, {column + 0.5, row + 0.5});
            double& most = parts[pixelAt(image, row - top, column)];
            most = std::max(most, std::min(part, 1.0));
          }
        }
      }
      for (int row = top; row < bottom; ++row) {
        for (int column = 0; column < image.width; ++column) {
          const double part = parts[pixelAt(image, row - top, column)];
          if (part > 0) blend(image, row, column, color, part);
        }
      }
    }
  });
}

void drawEdges(Image& image, double width, std::uint32_t color, int threads) {
  constexpr std::size_t rows_at_once = 256;
  const Disk disk(static_cast<int>(std::lround(width)));
  const auto rows = static_cast<std::size_t>(image.height);
  parallelFor(rows, rows_at_once, threadsForSteps(image.ids.size(), threads),
              [&](std::size_t begin, std::size_t end) {
                widenRows(image, disk, color, static_cast<int>(begin), static_cast<int>(end));
              });
}

SiteDots::SiteDots(const Image& image, const Sites& sites, const Box& domain, double size)
    : picture_(image), sites_(sites), domain_(domain) {
  dot_ = dotSizeOf(size, size == 0 ? spacing() : 0, {image.width, image.height});
}

double SiteDots::x(std::size_t i) const {
  return (sites_.x[i] - domain_.xmin) / (domain_.xmax - domain_.xmin) * picture_.width;
}

double SiteDots::y(std::size_t i) const {
  return (domain_.ymax - sites_.y[i]) / (domain_.ymax - domain_.ymin) * picture_.height;
}

bool SiteDots::shows(std::size_t i) const {
  const double column = x(i), row = y(i);
  if (!(column >= 0 && column < picture_.width && row >= 0 && row < picture_.height)) return false;
  return picture_.ids[pixelAt(picture_, static_cast<int>(row), static_cast<int>(column))] != no_site;
}

/// Returns the square root of the median cell size in pixels, over visible sites; 0 if there are none. Of
/// many sites only a sample is used, which suffices for a median.
double SiteDots::spacing() const {
  constexpr std::size_t enough = std::size_t{1} << 20;
  const std::size_t every = (sites_.size() + enough - 1) / enough;
  std::vector<std::uint32_t> pixels((sites_.size() + every - 1) / every);
  for (const std::uint32_t id : picture_.ids) {
    if (id != no_site && id % every == 0) ++pixels[id / every];
  }
  std::vector<std::uint32_t> shown;
  for (std::size_t k = 0; k < pixels.size(); ++k) {
    if (pixels[k] > 0 && shows(k * every)) shown.push_back(pixels[k]);
  }
  if (shown.empty()) return 0;
  const auto middle = shown.begin() + static_cast<std::ptrdiff_t>(shown.size() / 2);
  std::ranges::nth_element(shown, middle);
  return std::sqrt(static_cast<double>(*middle));
}

void SiteDots::draw(const SampleGrid& samples, std::uint32_t color, Image& image) const {
  const double scale = samples.in_pixel;
  const DotSize dot{dot_.radius * scale, dot_.rim * scale};
  for (std::size_t i = 0; i < sites_.size(); ++i) {
    if (!shows(i)) continue;
    const Point at{(x(i) - samples.left) * scale, (y(i) - samples.top) * scale};
    drawDot(image, at, dot, color);
  }
}

}  // namespace vorpipe::core

#include "picture/overlay.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "picture/blend.h"

namespace vorpipe::core {
namespace {

constexpr std::uint32_t dot_color = white, rim_color = black;

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

/// Darkens rows begin to end. Rows of distances are kept while the disk reaches them.
void widenRows(Image& image, const Disk& disk, int begin, int end) {
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
      if (dark[column] != 0 && image.ids[first + column] != no_site) image.rgba[first + column] = edge_color;
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
      image.rgba[pixel] = distance > dot.radius - dot.rim && dot.rim > 0 ? rim_color : color;
    }
  }
}

/// Maps sites to a picture of a domain, y downward.
class SitePixels {
 public:
  SitePixels(const Image& image, const Sites& sites, const Box& domain)
      : image_(image), sites_(sites), domain_(domain) {}
  [[nodiscard]] double x(std::size_t i) const {
    return (sites_.x[i] - domain_.xmin) / (domain_.xmax - domain_.xmin) * image_.width;
  }
  [[nodiscard]] double y(std::size_t i) const {
    return (domain_.ymax - sites_.y[i]) / (domain_.ymax - domain_.ymin) * image_.height;
  }
  [[nodiscard]] bool shows(std::size_t i) const {
    const double column = x(i), row = y(i);
    if (!(column >= 0 && column < image_.width && row >= 0 && row < image_.height)) return false;
    return image_.ids[pixelAt(image_, static_cast<int>(row), static_cast<int>(column))] != no_site;
  }

 private:
  const Image& image_;
  const Sites& sites_;
  Box domain_;
};

/// Returns the square root of the median cell size in pixels, over visible sites; 0 if there are none. Of
/// many sites only a sample is used, which suffices for a median.
double spacingOf(const Image& image, const SitePixels& places, std::size_t sites) {
  constexpr std::size_t enough = std::size_t{1} << 20;
  const std::size_t every = (sites + enough - 1) / enough;
  std::vector<std::uint32_t> pixels((sites + every - 1) / every);
  for (const std::uint32_t id : image.ids) {
    if (id != no_site && id % every == 0) ++pixels[id / every];
  }
  std::vector<std::uint32_t> shown;
  for (std::size_t k = 0; k < pixels.size(); ++k) {
    if (pixels[k] > 0 && places.shows(k * every)) shown.push_back(pixels[k]);
  }
  if (shown.empty()) return 0;
  const auto middle = shown.begin() + static_cast<std::ptrdiff_t>(shown.size() / 2);
  std::ranges::nth_element(shown, middle);
  return std::sqrt(static_cast<double>(*middle));
}

}  // namespace

void drawEdges(Image& image, double width, int threads) {
  constexpr std::size_t rows_at_once = 256;
  const Disk disk(static_cast<int>(std::lround(width)));
  const auto rows = static_cast<std::size_t>(image.height);
  parallelFor(rows, rows_at_once, threadsForSteps(image.ids.size(), threads),
              [&](std::size_t begin, std::size_t end) {
                widenRows(image, disk, static_cast<int>(begin), static_cast<int>(end));
              });
}

SiteDots::SiteDots(const Image& image, const Sites& sites, const Box& domain, double size)
    : picture_(image), sites_(sites), domain_(domain) {
  const SitePixels places(image, sites, domain);
  const double spacing = size == 0 ? spacingOf(image, places, sites.size()) : 0;
  dot_ = dotSizeOf(size, spacing, {image.width, image.height});
}

void SiteDots::draw(const Places& places, bool white_cells, Image& image) const {
  const SitePixels at(picture_, sites_, domain_);
  const double scale = places.in_pixel;
  const DotSize dot{dot_.radius * scale, dot_.rim * scale};
  const std::uint32_t color = white_cells ? black : dot_color;
  for (std::size_t i = 0; i < sites_.size(); ++i) {
    if (!at.shows(i)) continue;
    drawDot(image, {(at.x(i) - places.left) * scale, (at.y(i) - places.top) * scale}, dot, color);
  }
}

}  // namespace vorpipe::core

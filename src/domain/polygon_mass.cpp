#include "domain/polygon_mass.h"

#include <algorithm>
#include <cmath>

namespace vorpipe::core {
namespace {

/// Bits of a height of 1 pixel, or of a lower polygon's: few enough to add 100,000 edges in a row.
constexpr int height_bits = 45;
/// Bits of a whole polygon's height, which must fit into 63 bits, too: a higher polygon has fewer bits per
/// pixel.
constexpr int most_bits = 62;

}  // namespace

void PixelRows::begin(Point offset, double height, Range columns, Range rows) {
  offset_ = offset;
  columns_ = columns;
  rows_ = rows;
  int exponent = 0;
  std::frexp(height, &exponent);
  const int beyond = std::max(exponent - (most_bits - height_bits), std::min(exponent, 0));
  units_ = std::ldexp(1.0, height_bits - beyond);
  unit_ = 1 / units_;
  edges_.clear();
  parts_.resize(std::max(parts_.size(), static_cast<std::size_t>(columns.last - columns.first + 1)));
}

void PixelRows::add(Point a, Point b) {
  const Height from = std::llround(a.y * units_), to = std::llround(b.y * units_);
  if (from < to) edges_.push_back({a.x, b.x, from, to, 1});
  if (from > to) edges_.push_back({b.x, a.x, to, from, -1});
}

std::int64_t PixelRows::columnOf(double x) const {
  const auto column = static_cast<std::int64_t>(std::floor(x + offset_.x));
  return std::clamp(column, columns_.first, columns_.last);
}

double PixelRows::leftOf(std::int64_t column) const {
  return column == columns_.first ? 0 : static_cast<double>(column) - offset_.x;
}

PixelRows::Height PixelRows::lineOf(std::int64_t row) const {
  return std::llround((static_cast<double>(row) - offset_.y) * units_);
}

void PixelRows::beginRows() {
  std::ranges::sort(edges_, {}, &Edge::y0);
  active_.clear();
  next_ = 0;
}

void PixelRows::gatherRow(std::int64_t row) {
  constexpr Height farthest = std::numeric_limits<Height>::max();
  low_ = row == rows_.first ? -farthest : lineOf(row);
  high_ = row == rows_.last ? farthest : lineOf(row + 1);
  touched_ = {columns_.last + 1, columns_.first - 1};
  std::erase_if(active_, [&](const Edge& edge) { return edge.y1 <= low_; });
  for (; next_ < edges_.size() && edges_[next_].y0 < high_; ++next_) {
    if (edges_[next_].y1 > low_) active_.push_back(edges_[next_]);
  }
  for (const Edge& edge : active_) addInRow(edge);
}

/// Cuts the part of an edge in the row at the column lines.
void PixelRows::addInRow(const Edge& edge) {
  const double slope = (edge.x1 - edge.x0) / static_cast<double>(edge.y1 - edge.y0);
  const auto xAt = [&](Height y) {
    const double x = y - edge.y0 < edge.y1 - y ? edge.x0 + slope * static_cast<double>(y - edge.y0)
                                               : edge.x1 - slope * static_cast<double>(edge.y1 - y);
    return std::clamp(x, std::min(edge.x0, edge.x1), std::max(edge.x0, edge.x1));
  };
  const Height begin = std::max(edge.y0, low_), end = std::min(edge.y1, high_);
  const double from = xAt(begin), to = xAt(end);
  auto column = columnOf(from);
  const auto last = columnOf(to);
  double x = from;
  Height y = begin;
  while (column != last) {
    const bool right = last > column;
    const double line = leftOf(right ? column + 1 : column);
    const double along = std::clamp((line - from) / (to - from), 0.0, 1.0);
    const Height at = begin + std::llround(along * static_cast<double>(end - begin));
    const Height next = std::clamp(at, y, end);
    addPiece(column, x, y, line, next, edge.sign);
    x = line;
    y = next;
    column += right ? 1 : -1;
  }
  addPiece(column, x, y, to, end, edge.sign);
}

void PixelRows::addPiece(std::int64_t column, double xa, Height ya, double xb, Height yb, int sign) {
  Part& part = parts_[static_cast<std::size_t>(column - columns_.first)];
  touched_ = {std::min(touched_.first, column), std::max(touched_.last, column)};
  if (ya == yb) return;
  const double left = leftOf(column), a = xa - left, b = xb - left;
  const double height = sign * real(yb - ya), from = real(ya), to = real(yb);
  part.own.area += height * ((a + b) / 2);
  part.own.x += height * (a * a + a * b + b * b + 3 * left * (a + b)) / 6;
  part.own.y += height * (a * (2 * from + to) + b * (from + 2 * to)) / 6;
  part.own.xx += height * (left * left * (a + b) / 2 + left * (a * a + a * b + b * b) / 3 +
                           (a + b) * (a * a + b * b) / 12);
  const double squares = from * from + to * to, product = 2 * from * to;
  part.own.yy +=
      height * (a * (squares + product + 2 * from * from) + b * (squares + product + 2 * to * to)) / 12;
  part.height += sign * (yb - ya);
  part.y_height += height * ((from + to) / 2);
  part.yy_height += height * ((squares + product / 2) / 3);
}

PixelIntegrals PixelRows::pixelOf(std::int64_t column, std::int64_t row, Carry& carry) {
  Part& part = parts_[static_cast<std::size_t>(column - columns_.first)];
  PixelIntegrals pixel = part.own;
  if (carry.height != 0) {
    const double left = leftOf(column), width = leftOf(column + 1) - left;
    const bool whole = row != rows_.first && row != rows_.last && carry.height == high_ - low_;
    const double height = real(carry.height);
    pixel.area += height * width;
    pixel.x += height * width * (left + width / 2);
    pixel.xx += height * width * (left * left + left * width + width * width / 3);
    const double low = real(low_), high = real(high_);
    pixel.y += (whole ? height * ((low + high) / 2) : carry.y_height) * width;
    pixel.yy += (whole ? height * ((low * low + low * high + high * high) / 3) : carry.yy_height) * width;
  }
  carry.height += part.height;
  carry.y_height = carry.height != 0 ? carry.y_height + part.y_height : 0;
  carry.yy_height = carry.height != 0 ? carry.yy_height + part.yy_height : 0;
  part = {};
  return pixel;
}

std::optional<double> PolygonScale::begin(Point origin, const Box& around) {
  const auto &x = pixels_.x, &y = pixels_.y;
  around_ = around;
  const Point offset{x.pixelsTo(origin.x + around.xmin), y.pixelsTo(origin.y + around.ymin)};
  const PixelRows::Range columns{x.at(offset.x), x.at(x.pixelsTo(origin.x + around.xmax))};
  const PixelRows::Range rows{y.at(offset.y), y.at(y.pixelsTo(origin.y + around.ymax))};
  if (columns.first == columns.last && rows.first == rows.last) return pixels_.at(rows.first, columns.first);
  rows_.begin(offset, (around.ymax - around.ymin) / y.size, columns, rows);
  return {};
}

PolygonMass PolygonScale::weigh() {
  PixelIntegrals sum;
  rows_.integrate([&](std::int64_t row, std::int64_t column, const PixelIntegrals& pixel) {
    const double value = pixels_.at(row, column);
    sum.area += value * pixel.area;
    sum.x += value * pixel.x;
    sum.y += value * pixel.y;
    sum.xx += value * pixel.xx;
    sum.yy += value * pixel.yy;
  });
  if (!(sum.area > 0)) return {};
  const double width = pixels_.x.size, height = pixels_.y.size;
  const double across = (sum.xx - sum.x * (sum.x / sum.area)) * width * width;
  const double along = (sum.yy - sum.y * (sum.y / sum.area)) * height * height;
  return {sum.area * width * height,
          {around_.xmin + sum.x / sum.area * width, around_.ymin + sum.y / sum.area * height},
          std::max(0.0, across + along) * width * height};
}

}  // namespace vorpipe::core

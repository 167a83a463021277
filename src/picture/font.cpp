#include "picture/font.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "picture/pixels.h"
#include "vorpipe/shapes.h"

namespace vorpipe::core {
namespace {

/// A character: its width in units including the gap after it, and the strokes of the pen. A stroke is a list
/// of points, each a digit and a letter: x in half units from the left, and y in half units above the
/// baseline from a on, or below it from A on. Strokes are separated by spaces; ~ rounds the corners.
struct Glyph {
  char character;
  int advance;
  std::string_view strokes;
};

constexpr auto glyphs = std::to_array<Glyph>({
    {' ', 4, ""},
    {'0', 6, "~4m8m8a0a0m4m"},
    {'1', 6, "1k4m4a 1a7a"},
    {'2', 6, "~0j0m8m8g0a 0a8a"},
    {'3', 6, "~0k0m8m8g3g ~3g8g8a0a0c"},
    {'4', 6, "6a6m0e8e"},
    {'5', 6, "8m0m0i ~0i8i8a0a0c"},
    {'6', 6, "~8k8m0m0a8a8h0h"},
    {'7', 6, "0m8m2a"},
    {'8', 6, "~4m8m8g0g0m4m ~4g8g8a0a0g4g"},
    {'9', 6, "~0c0a8a8m0m0f8f"},
    {'A', 6, "0a4m8a 2e6e"},
    {'B', 6, "~0m7m7g0g ~0g8g8a0a 0a0m"},
    {'C', 6, "~8k8m0m0a8a8c"},
    {'D', 6, "~0m8m8a0a 0a0m"},
    {'E', 6, "8m0m0a8a 0g6g"},
    {'F', 6, "8m0m0a 0g6g"},
    {'G', 6, "~8k8m0m0a8a8f 8f5f"},
    {'H', 6, "0a0m 8a8m 0g8g"},
    {'I', 4, "0a4a 0m4m 2a2m"},
    {'J', 6, "~8m8a0a0d"},
    {'K', 6, "0a0m 8m0e 2g8a"},
    {'L', 6, "0m0a8a"},
    {'M', 6, "0a0m4e8m8a"},
    {'N', 6, "0a0m8a8m"},
    {'O', 7, "~5m:m:a0a0m5m"},
    {'P', 6, "0a0m ~0m8m8f0f"},
    {'Q', 7, "~5m:m:a0a0m5m 6d:a"},
    {'R', 6, "0a0m ~0m8m8g0g 4g8a"},
    {'S', 6, "~8k8m0m0g8g8a0a0c"},
    {'T', 6, "4a4m 0m8m"},
    {'U', 6, "~0m0a8a8m"},
    {'V', 6, "0m4a8m"},
    {'W', 6, "0m2a4i6a8m"},
    {'X', 6, "0m8a 0a8m"},
    {'Y', 6, "0m4g8m 4g4a"},
    {'Z', 6, "0m8m0a8a"},
    {'a', 6, "~0i8i8a ~8e0e0a8a"},
    {'b', 6, "0m0a ~0i8i8a0a"},
    {'c', 6, "~8g8i0i0a8a8c"},
    {'d', 6, "8m8a ~8i0i0a8a"},
    {'e', 6, "0e8e ~8e8i0i0a8a8b"},
    {'f', 5, "~2a2m6m 0i5i"},
    {'g', 6, "~8i0i0a8a ~8i8D0D"},
    {'h', 6, "0m0a ~0i8i8a"},
    {'i', 2, "0i0a 0l0m"},
    {'j', 4, "~4i4D0D 4l4m"},
    {'k', 6, "0m0a 7i0d 2f8a"},
    {'l', 2, "0m0a"},
    {'m', 6, "0i0a ~0i4i4a ~4i8i8a"},
    {'n', 6, "0i0a ~0i8i8a"},
    {'o', 6, "~4i8i8a0a0i4i"},
    {'p', 6, "0i0D ~0i8i8a0a"},
    {'q', 6, "8i8D ~8i0i0a8a"},
    {'r', 5, "0i0a ~0e0i6i"},
    {'s', 6, "~8h8i0i0e8e8a0a0b"},
    {'t', 5, "~2l2a6a 0i5i"},
    {'u', 6, "8i8a ~0i0a8a"},
    {'v', 6, "0i4a8i"},
    {'w', 6, "0i2a4g6a8i"},
    {'x', 6, "0i8a 0a8i"},
    {'y', 6, "0i4a 8i3D1D"},
    {'z', 6, "0i8i0a8a"},
    {'.', 2, "0a0a"},
    {',', 3, "2a0C"},
    {':', 2, "0b0b 0h0h"},
    {'/', 6, "0a8m"},
    {'=', 6, "0e8e 0i8i"},
    {'_', 6, "0A8A"},
    {'-', 6, "1g7g"},
    {'+', 6, "0g8g 4c4k"},
    {'%', 6, "8m0a ~1m3m3j0j0m1m ~7d8d8a5a5d7d"},
    {'(', 3, "~2n0n0B2B"},
    {')', 3, "~0n2n2B0B"},
});

const Glyph& glyphOf(char character) {
  const auto* found = std::ranges::find(glyphs, character, &Glyph::character);
  return found == glyphs.end() ? glyphs.front() : *found;
}

/// A line of the pen, in units, y upward.
using Stroke = std::vector<Point>;

Point pointOf(char x, char y) {
  const int half_units = y >= 'a' ? y - 'a' : 'A' - 1 - y;
  return {(x - '0') / 2.0, half_units / 2.0};
}

/// Returns the point on the way from one point toward another at distance `reach`, or at most at a part of
/// the way.
Point toward(Point from, Point to, double reach, double most_part) {
  const double part = std::min(reach / std::hypot(to.x - from.x, to.y - from.y), most_part);
  return {from.x + part * (to.x - from.x), from.y + part * (to.y - from.y)};
}

/// Replaces every corner by a curve, which takes half of a side that it shares with another corner.
Stroke rounded(const Stroke& corners) {
  constexpr double reach = 2;
  constexpr int steps = 8;
  const std::size_t last = corners.size() - 1;
  Stroke curve{corners.front()};
  for (std::size_t i = 1; i < last; ++i) {
    const Point at = corners[i];
    const Point from = toward(at, corners[i - 1], reach, i == 1 ? 1 : 0.5);
    const Point to = toward(at, corners[i + 1], reach, i + 1 == last ? 1 : 0.5);
    for (int k = 0; k <= steps; ++k) {
      const double t = static_cast<double>(k) / steps, s = 1 - t;
      curve.push_back({s * s * from.x + 2 * s * t * at.x + t * t * to.x,
                       s * s * from.y + 2 * s * t * at.y + t * t * to.y});
    }
  }
  curve.push_back(corners.back());
  return curve;
}

std::vector<Stroke> strokesOf(const Glyph& glyph) {
  std::vector<Stroke> strokes;
  std::string_view left = glyph.strokes;
  while (!left.empty()) {
    std::string_view word = left.substr(0, left.find(' '));
    left.remove_prefix(std::min(left.size(), word.size() + 1));
    const bool round = word.front() == '~';
    if (round) word.remove_prefix(1);
    Stroke stroke;
    for (std::size_t i = 0; i + 1 < word.size(); i += 2) stroke.push_back(pointOf(word[i], word[i + 1]));
    strokes.push_back(round ? rounded(stroke) : stroke);
  }
  return strokes;
}

double distanceTo(const Stroke& stroke, Point p) {
  double least = std::hypot(p.x - stroke[0].x, p.y - stroke[0].y);
  for (std::size_t i = 1; i < stroke.size(); ++i) {
    const Point a = stroke[i - 1], way{stroke[i].x - a.x, stroke[i].y - a.y};
    const double square = way.x * way.x + way.y * way.y;
    if (square == 0) continue;
    const double along = std::clamp(((p.x - a.x) * way.x + (p.y - a.y) * way.y) / square, 0.0, 1.0);
    least = std::min(least, std::hypot(p.x - a.x - along * way.x, p.y - a.y - along * way.y));
  }
  return least;
}

/// Draws a character from its lower left corner, on the baseline.
void drawGlyph(const Glyph& glyph, Point at, double unit, std::uint32_t color, Image& image) {
  constexpr int above = letter_units + 1, below = 3;
  const auto strokes = strokesOf(glyph);
  const auto first = [](double edge) { return static_cast<int>(std::floor(edge)); };
  const auto last = [](double edge) { return static_cast<int>(std::ceil(edge)); };
  for (int row = first(at.y - above * unit); row < last(at.y + below * unit); ++row) {
    for (int column = first(at.x - unit); column < last(at.x + glyph.advance * unit); ++column) {
      // The pen's center is that of a cell of the letter's grid.
      const Point place{(column - at.x + 0.5) / unit - 0.5, -(row - at.y + 0.5) / unit - 0.5};
      double distance = 1;
      for (const Stroke& stroke : strokes) distance = std::min(distance, distanceTo(stroke, place));
      blend(image, row, column, color, (0.5 - distance) * unit + 0.5);
    }
  }
}

}  // namespace

int unitsOf(std::string_view text) {
  int units = 0;
  for (const char character : text) units += glyphOf(character).advance;
  return std::max(0, units - 1);
}

void drawTextAt(std::string_view text, Point at, double height, std::uint32_t color, Image& image) {
  const double unit = height / letter_units;
  for (const char character : text) {
    const Glyph& glyph = glyphOf(character);
    drawGlyph(glyph, at, unit, color, image);
    at.x += glyph.advance * unit;
  }
}

}  // namespace vorpipe::core

namespace vorpipe {
namespace {

/// Pixels per unit: a whole number, so that vertical and horizontal strokes have sharp edges.
int unitOf(const LegendText& text) {
  return std::max(1, static_cast<int>(std::lround(text.height / core::letter_units)));
}

}  // namespace

double widthOf(const LegendText& text) { return core::unitsOf(text.text) * unitOf(text); }

void drawText(const LegendText& text, Image& image) {
  const int unit = unitOf(text), width = core::unitsOf(text.text) * unit;
  const int before = text.anchor == Anchor::start ? 0 : text.anchor == Anchor::middle ? width / 2 : width;
  const Point at{std::round(text.x) - before, std::round(text.baseline)};
  core::drawTextAt(text.text, at, unit * core::letter_units, black, image);
}

}  // namespace vorpipe

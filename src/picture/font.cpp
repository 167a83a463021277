#include "picture/font.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "picture/glyphs.h"
#include "picture/pixels.h"
#include "vorpipe/shapes.h"

namespace vorpipe::core {
namespace {

int advanceOf(const Letter& letter) {
  // A caron that stands to the right of its letter, as with d and t, makes the character wider.
  const bool beside = letter.mark != nullptr && letter.mark->name == '|';
  return letter.glyph->advance + (beside ? 1 : 0);
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

void addStrokes(std::string_view left, Point by, std::vector<Stroke>& strokes) {
  while (!left.empty()) {
    std::string_view word = left.substr(0, left.find(' '));
    left.remove_prefix(std::min(left.size(), word.size() + 1));
    const bool round = word.front() == '~';
    if (round) word.remove_prefix(1);
    Stroke stroke;
    for (std::size_t i = 0; i + 1 < word.size(); i += 2) {
      const Point at = pointOf(word[i], word[i + 1]);
      stroke.push_back({at.x + by.x, at.y + by.y});
    }
    strokes.push_back(round ? rounded(stroke) : stroke);
  }
}

std::vector<Stroke> strokesOf(const Letter& letter) {
  std::vector<Stroke> strokes;
  addStrokes(letter.glyph->strokes, {0, 0}, strokes);
  if (letter.mark == nullptr) return strokes;
  double top = 0;
  for (const Stroke& stroke : strokes) {
    for (const Point& at : stroke) top = std::max(top, at.y);
  }
  constexpr int usual_advance = 6;
  const double right = (letter.glyph->advance - usual_advance) / 2.0 * (letter.mark->name == '|' ? 2 : 1);
  addStrokes(letter.mark->strokes, {right, letter.mark->above ? top : 0}, strokes);
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
void drawLetter(const Letter& letter, Point at, double unit, std::uint32_t color, double halo, Image& image) {
  // Marks of capital letters reach three units above them.
  const double above = letter_units + (letter.mark == nullptr ? 1 : 4) + halo, below = 3 + halo;
  const auto strokes = strokesOf(letter);
  const auto first = [](double edge) { return static_cast<int>(std::floor(edge)); };
  const auto last = [](double edge) { return static_cast<int>(std::ceil(edge)); };
  for (int row = first(at.y - above * unit); row < last(at.y + below * unit); ++row) {
    for (int column = first(at.x - (1 + halo) * unit);
         column < last(at.x + (advanceOf(letter) + halo) * unit); ++column) {
      // The pen's center is that of a cell of the letter's grid.
      const Point place{(column - at.x + 0.5) / unit - 0.5, -(row - at.y + 0.5) / unit - 0.5};
      double distance = 1 + halo;
      for (const Stroke& stroke : strokes) distance = std::min(distance, distanceTo(stroke, place));
      blend(image, row, column, color, (0.5 + halo - distance) * unit + 0.5);
    }
  }
}

}  // namespace

int unitsOf(std::string_view text) {
  int units = 0;
  eachCharacter(text, [&](char32_t character) { units += advanceOf(drawnLetter(character)); });
  return std::max(0, units - 1);
}

void drawTextAt(std::string_view text, Point at, double height, std::uint32_t color, Image& image,
                double halo) {
  const double unit = height / letter_units;
  eachCharacter(text, [&](char32_t character) {
    const Letter letter = drawnLetter(character);
    drawLetter(letter, at, unit, color, halo, image);
    at.x += advanceOf(letter) * unit;
  });
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
  core::drawTextAt(text.text, at, unit * core::letter_units, text.rgba, image);
}

}  // namespace vorpipe

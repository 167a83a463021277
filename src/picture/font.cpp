#include "picture/font.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "picture/pixels.h"
#include "vorpipe/shapes.h"

namespace vorpipe::core {
namespace {

/// A character: its width in units including the gap after it, and the strokes of the pen. A stroke is a list
/// of points, each a digit and a letter: x in half units from the left, and y in half units above the
/// baseline from a on, or below it from A on. Strokes are separated by spaces; ~ rounds the corners.
struct Glyph {
  char32_t character;
  int advance;
  std::string_view strokes;
};

constexpr auto glyphs = std::to_array<Glyph>({
    {U' ', 4, ""},
    {U'0', 6, "~4m8m8a0a0m4m"},
    {U'1', 6, "1k4m4a 1a7a"},
    {U'2', 6, "~0j0m8m8g0a 0a8a"},
    {U'3', 6, "~0k0m8m8g3g ~3g8g8a0a0c"},
    {U'4', 6, "6a6m0e8e"},
    {U'5', 6, "8m0m0i ~0i8i8a0a0c"},
    {U'6', 6, "~8k8m0m0a8a8h0h"},
    {U'7', 6, "0m8m2a"},
    {U'8', 6, "~4m8m8g0g0m4m ~4g8g8a0a0g4g"},
    {U'9', 6, "~0c0a8a8m0m0f8f"},
    {U'A', 6, "0a4m8a 2e6e"},
    {U'B', 6, "~0m7m7g0g ~0g8g8a0a 0a0m"},
    {U'C', 6, "~8k8m0m0a8a8c"},
    {U'D', 6, "~0m8m8a0a 0a0m"},
    {U'E', 6, "8m0m0a8a 0g6g"},
    {U'F', 6, "8m0m0a 0g6g"},
    {U'G', 6, "~8k8m0m0a8a8f 8f5f"},
    {U'H', 6, "0a0m 8a8m 0g8g"},
    {U'I', 4, "0a4a 0m4m 2a2m"},
    {U'J', 6, "~8m8a0a0d"},
    {U'K', 6, "0a0m 8m0e 2g8a"},
    {U'L', 6, "0m0a8a"},
    {U'M', 6, "0a0m4e8m8a"},
    {U'N', 6, "0a0m8a8m"},
    {U'O', 7, "~5m:m:a0a0m5m"},
    {U'P', 6, "0a0m ~0m8m8f0f"},
    {U'Q', 7, "~5m:m:a0a0m5m 6d:a"},
    {U'R', 6, "0a0m ~0m8m8g0g 4g8a"},
    {U'S', 6, "~8k8m0m0g8g8a0a0c"},
    {U'T', 6, "4a4m 0m8m"},
    {U'U', 6, "~0m0a8a8m"},
    {U'V', 6, "0m4a8m"},
    {U'W', 6, "0m2a4i6a8m"},
    {U'X', 6, "0m8a 0a8m"},
    {U'Y', 6, "0m4g8m 4g4a"},
    {U'Z', 6, "0m8m0a8a"},
    {U'a', 6, "~0i8i8a ~8e0e0a8a"},
    {U'b', 6, "0m0a ~0i8i8a0a"},
    {U'c', 6, "~8g8i0i0a8a8c"},
    {U'd', 6, "8m8a ~8i0i0a8a"},
    {U'e', 6, "0e8e ~8e8i0i0a8a8b"},
    {U'f', 5, "~2a2m6m 0i5i"},
    {U'g', 6, "~8i0i0a8a ~8i8D0D"},
    {U'h', 6, "0m0a ~0i8i8a"},
    {U'i', 2, "0i0a 0l0m"},
    {U'j', 4, "~4i4D0D 4l4m"},
    {U'k', 6, "0m0a 7i0d 2f8a"},
    {U'l', 2, "0m0a"},
    {U'm', 6, "0i0a ~0i4i4a ~4i8i8a"},
    {U'n', 6, "0i0a ~0i8i8a"},
    {U'o', 6, "~4i8i8a0a0i4i"},
    {U'p', 6, "0i0D ~0i8i8a0a"},
    {U'q', 6, "8i8D ~8i0i0a8a"},
    {U'r', 5, "0i0a ~0e0i6i"},
    {U's', 6, "~8h8i0i0e8e8a0a0b"},
    {U't', 5, "~2l2a6a 0i5i"},
    {U'u', 6, "8i8a ~0i0a8a"},
    {U'v', 6, "0i4a8i"},
    {U'w', 6, "0i2a4g6a8i"},
    {U'x', 6, "0i8a 0a8i"},
    {U'y', 6, "0i4a 8i3D1D"},
    {U'z', 6, "0i8i0a8a"},
    {U'.', 2, "0a0a"},
    {U',', 3, "2a0C"},
    {U':', 2, "0b0b 0h0h"},
    {U'/', 6, "0a8m"},
    {U'=', 6, "0e8e 0i8i"},
    {U'_', 6, "0A8A"},
    {U'-', 6, "1g7g"},
    {U'+', 6, "0g8g 4c4k"},
    {U'%', 6, "8m0a ~1m3m3j0j0m1m ~7d8d8a5a5d7d"},
    {U'(', 3, "~2n0n0B2B"},
    {U')', 3, "~0n2n2B0B"},
    {U'!', 2, "0m0e 0a0a"},
    {U'"', 4, "0m0j 3m3j"},
    {U'#', 6, "2a3m 5a6m 0e8e 0i8i"},
    {U'$', 6, "~8k8l0l0g8g8b0b0c 4n4A"},
    {U'&', 6, "~8e5a0a0f6j6m2m2j8a"},
    {U'\'', 2, "0m0j"},
    {U'*', 6, "4d4j 1f7i 1i7f"},
    {U';', 3, "2a0C 2h2h"},
    {U'<', 6, "8j0f8b"},
    {U'>', 6, "0j8f0b"},
    {U'?', 6, "~0k0m8m8g4g4e 4a4a"},
    {U'@', 6, "~8b8a0a0m8m8d5d5i8i"},
    {U'[', 4, "3n0n0B3B"},
    {U'\\', 6, "0m8a"},
    {U']', 4, "0n3n3B0B"},
    {U'^', 6, "1j4m7j"},
    {U'`', 4, "0m3k"},
    {U'{', 4, "4n2n2h0f2d2B4B"},
    {U'|', 2, "0n0B"},
    {U'}', 4, "0n2n2h4f2d2B0B"},
    {U'~', 6, "~0e0h4h4f8f8i"},
    {U'\u00A0', 4, ""},
    {U'\u00A1', 2, "0i0i 0f0D"},
    {U'\u00A3', 6, "~8k8m3m3a 0a8a 0g6g"},
    {U'\u00AB', 6, "4i1e4a 8i5e8a"},
    {U'\u00B0', 4, "~2m4m4i0i0m2m"},
    {U'\u00B1', 6, "0h8h 4d4l 0a8a"},
    {U'\u00B2', 4, "~0l0m4m4j 4j0g4g"},
    {U'\u00B3', 4, "~0m4m4j1j ~1j4j4g0g"},
    {U'\u00B5', 6, "0i0D ~0c0a8a 8i8a"},
    {U'\u00B7', 2, "0f0f"},
    {U'\u00BB', 6, "0i3e0a 4i7e4a"},
    {U'\u00BF', 6, "4i4i ~4f4d0d0D8D8B"},
    {U'\u00C6', 6, "0a4m8m 4m4a8a 4g7g 2e4e"},
    {U'\u00D0', 6, "~0m8m8a0a 0a0m 0g4g"},
    {U'\u00D7', 6, "1c7i 1i7c"},
    {U'\u00D8', 7, "~5m:m:a0a0m5m 1a9m"},
    {U'\u00DE', 6, "0a0m ~0k8k8d0d"},
    {U'\u00DF', 6, "~0a0m6m6h3h ~3h8h8a3a"},
    {U'\u00E6', 6, "~0i4i4a ~4e0e0a4a 4e8e ~4i8i8e 4a8a"},
    {U'\u00F0', 6, "~4h8h8a0a0h4h 8f2m 2j6m"},
    {U'\u00F7', 6, "0f8f 4i4i 4c4c"},
    {U'\u00F8', 6, "~4i8i8a0a0i4i 0a8i"},
    {U'\u00FE', 6, "0m0D ~0i8i8a0a"},
    {U'\u0110', 6, "~0m8m8a0a 0a0m 0g4g"},
    {U'\u0111', 6, "8m8a ~8i0i0a8a 5l9l"},
    {U'\u0126', 6, "0a0m 8a8m 0g8g 0j8j"},
    {U'\u0127', 6, "0m0a ~0i8i8a 0k4k"},
    {U'\u0131', 4, "2i2a"},
    {U'\u0141', 6, "2m2a8a 0e6i"},
    {U'\u0142', 4, "2m2a 0e4i"},
    {U'\u014A', 6, "0a0m ~0m8m8B5B"},
    {U'\u014B', 6, "0i0a ~0i8i8D5D"},
    {U'\u0152', 6, "~4m0m0a4a 4m8m 4m4a 4a8a 4g7g"},
    {U'\u0153', 6, "~4i0i0a4a 4i4a 4e8e ~4i8i8e 4a8a"},
    {U'\u0166', 6, "4a4m 0m8m 2g6g"},
    {U'\u0167', 5, "~2l2a6a 0i5i 0e5e"},
    {U'\u0237', 4, "~4i4D0D"},
    {U'\u2013', 6, "0g8g"},
    {U'\u2014', 6, "0g8g"},
    {U'\u2018', 3, "0m2j"},
    {U'\u2019', 3, "2m0j"},
    {U'\u201C', 5, "0m2j 4m6j"},
    {U'\u201D', 5, "2m0j 6m4j"},
    {U'\u201E', 5, "2a0C 6a4C"},
    {U'\u2026', 6, "0a0a 4a4a 8a8a"},
    {U'\u20AC', 6, "~8l8m2m2a8a8b 0h6h 0e6e"},
});

/// Letters with marks from U+00C0 to U+017F: two characters each, the letter and its mark; blanks where a
/// character has a glyph of its own, or none.
constexpr std::u32string_view first_marked = U"\u00C0";
constexpr std::string_view marked_letters =
    "A`A'A^A~A:Ao  C,E`E'E^E:I`I'I^I:  N~O`O'O^O~O:    U`U'U^U:Y'    "
    "a`a'a^a~a:ao  c,e`e'e^e:i`i'i^i:  n~o`o'o^o~o:    u`u'u^u:y'  y:"
    "A-a-AuauA;a;C'c'C^c^C.c.CvcvDvd|    E-e-EueuE.e.E;e;EvevG^g^Gugu"
    "G.g.G,g'H^h^    I~i~I-i-IuiuI;i;I.      J^j^K,k,  L'l'L,l,L|l|  "
    "      N'n'N,n,Nvnv      O-o-OuouO\"o\"    R'r'R,r,RvrvS's'S^s^S,s,"
    "SvsvT,t,Tvt|    U~u~U-u-UuuuUouoU\"u\"U;u;W^w^Y^y^Y:Z'z'Z.z.Zvzv  ";
static_assert(marked_letters.size() == std::size_t{0x180 - 0xC0} * 2);

/// A mark: its strokes, around x = 4; those above a letter stand on y = a.
struct Mark {
  char name;
  bool above;
  std::string_view strokes;
};
constexpr auto accents = std::to_array<Mark>({
    {'`', true, "2f5c"},
    {'\'', true, "3c6f"},
    {'^', true, "2c4f6c"},
    {'~', true, "1c2e3e5c6c7e"},
    {':', true, "2d2d 6d6d"},
    {'o', true, "~4f6f6c2c2f4f"},
    {'-', true, "2d6d"},
    {'u', true, "~2f2c6c6f"},
    {'.', true, "4d4d"},
    {'v', true, "2f4c6f"},
    {'"', true, "2c3f 5c6f"},
    {',', false, "4B5D3D"},
    {';', false, "5A4D6D"},
    {'|', false, ":m9j"},
});

/// What is drawn for a character.
struct Letter {
  const Glyph* glyph;
  const Mark* mark = nullptr;
};

const Glyph* glyphOf(char32_t character) {
  const auto* found = std::ranges::find(glyphs, character, &Glyph::character);
  return found == glyphs.end() ? nullptr : found;
}

/// Of a character without one, a null glyph.
Letter letterOf(char32_t character) {
  if (const Glyph* glyph = glyphOf(character)) return {glyph};
  constexpr char32_t first_romanian = 0x218, last_romanian = 0x21B;
  std::string_view parts = "  ";
  if (character >= first_marked[0] && character - first_marked[0] < marked_letters.size() / 2) {
    parts = marked_letters.substr(std::size_t{character - first_marked[0]} * 2, 2);
  } else if (character >= first_romanian && character <= last_romanian) {
    parts = std::string_view("S,s,T,t,").substr(std::size_t{character - first_romanian} * 2, 2);
  }
  if (parts == "  ") return {nullptr};
  const auto base = static_cast<unsigned char>(parts[0]);
  const auto* mark = std::ranges::find(accents, parts[1], &Mark::name);
  // Letters lose their dots to marks above them.
  constexpr char32_t dotless_i = 0x131, dotless_j = 0x237;
  const bool loses = mark->above && (base == 'i' || base == 'j');
  return {glyphOf(!loses ? base : base == 'i' ? dotless_i : dotless_j), mark};
}

/// Calls `use` with each character of UTF-8; what is no UTF-8 is one of no glyph.
template <class Use>
void eachCharacter(std::string_view text, const Use& use) {
  constexpr char32_t strange = 0xFFFD;
  while (!text.empty()) {
    const auto lead = static_cast<unsigned char>(text[0]);
    const std::size_t size = lead < 0x80 ? 1 : lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
    char32_t character = size == 1 ? lead : lead & (0x7FU >> size);
    for (std::size_t k = 1; k < size && k < text.size(); ++k) {
      character = character << 6 | (static_cast<unsigned char>(text[k]) & 0x3F);
    }
    use(size <= text.size() ? character : strange);
    text.remove_prefix(std::min(size, text.size()));
  }
}

/// Of a character without a glyph a blank.
Letter drawn(char32_t character) {
  const Letter letter = letterOf(character);
  return letter.glyph != nullptr ? letter : Letter{&glyphs.front()};
}

int advanceOf(const Letter& letter) {
  // A mark beside a letter, as of d with caron, takes room.
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
void drawLetter(const Letter& letter, Point at, double unit, std::uint32_t color, Image& image) {
  // Marks of capital letters reach three units above them.
  const int above = letter_units + (letter.mark == nullptr ? 1 : 4), below = 3;
  const auto strokes = strokesOf(letter);
  const auto first = [](double edge) { return static_cast<int>(std::floor(edge)); };
  const auto last = [](double edge) { return static_cast<int>(std::ceil(edge)); };
  for (int row = first(at.y - above * unit); row < last(at.y + below * unit); ++row) {
    for (int column = first(at.x - unit); column < last(at.x + advanceOf(letter) * unit); ++column) {
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
  eachCharacter(text, [&](char32_t character) { units += advanceOf(drawn(character)); });
  return std::max(0, units - 1);
}

void drawTextAt(std::string_view text, Point at, double height, std::uint32_t color, Image& image) {
  const double unit = height / letter_units;
  eachCharacter(text, [&](char32_t character) {
    const Letter letter = drawn(character);
    drawLetter(letter, at, unit, color, image);
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
Result<void> checkLetters(const RenderOptions& options, std::string_view what,
                          const std::function<bool(std::string_view)>& has) {
  Result<void> checked;
  const auto check = [&](std::string_view name, const std::string& text) {
    if (!checked || has(text)) return;
    checked = tl::unexpected(
        Error{ErrorCode::input,
              fmt::format("{} \"{}\": {} does not have these letters; .svg has all", name, text, what)});
  };
  check("title", options.title);
  if (options.legend)
    check("legend", options.legend_title.empty() ? options.values.title : options.legend_title);
  if (options.legend) {
    for (const std::string& name : options.values.names) check("legend", name);
  }
  if (options.labels) {
    for (const std::string& text : options.texts) check("label", text);
  }
  return checked;
}

bool pixelsHaveLetters(std::string_view text) {
  bool all = true;
  core::eachCharacter(text,
                      [&](char32_t character) { all = all && core::letterOf(character).glyph != nullptr; });
  return all;
}

}  // namespace vorpipe

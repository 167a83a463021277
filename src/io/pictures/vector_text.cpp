#include "io/pictures/vector_text.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace vorpipe {

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

double textWidth(const std::string& text, double font_size) {
  // Adobe's font metrics of Helvetica, in thousandths, from the space to the tilde.
  constexpr std::array<std::uint16_t, 95> widths = {
      278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333,  278, 278, 556, 556, 556,
      556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556, 1015, 667, 667, 722, 722, 667,
      611, 778, 722, 278, 500, 667, 556, 833, 722, 778, 667, 778, 722, 667,  611, 722, 667, 944, 667,
      667, 611, 278, 278, 278, 469, 556, 333, 556, 556, 500, 556, 556, 278,  556, 556, 222, 222, 500,
      222, 833, 556, 556, 556, 556, 333, 500, 278, 556, 500, 722, 500, 500,  500, 334, 260, 334, 584};
  constexpr double thousandth = 1e-3;
  double width = 0;
  for (const char letter : text) {
    const auto index = static_cast<std::size_t>(static_cast<unsigned char>(letter) - ' ');
    if (index < widths.size()) width += widths[index];
  }
  return width * thousandth * font_size;
}

}  // namespace vorpipe

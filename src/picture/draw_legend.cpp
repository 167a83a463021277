#include "picture/draw_legend.h"

#include <cmath>

#include "picture/blend.h"
#include "picture/font.h"

namespace vorpipe::core {

void drawLegend(const Legend& legend, Image& image) {
  const auto pixel = [](double at) { return static_cast<int>(std::lround(at)); };
  for (const LegendBox& box : legend.boxes) {
    for (int row = pixel(box.top); row < pixel(box.top + box.height); ++row) {
      for (int column = pixel(box.left); column < pixel(box.left + box.width); ++column) {
        blend(image, row, column, box.rgba, 1);
      }
    }
  }
  for (const LegendText& text : legend.texts) drawText(text, image);
}

}  // namespace vorpipe::core

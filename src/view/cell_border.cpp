#include "view/cell_border.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace vorpipe::view {
namespace {

/// A step along the sides of pixels, with the cell on its right hand.
struct Step {
  int x, y;
};
constexpr std::array<Step, 4> border_steps{
    {{0, -1}, {1, 0}, {0, 1}, {-1, 0}}};  // each turns right of the one before

/// The pixels ahead of a corner, on the left and on the right hand, from that corner.
constexpr std::array<Step, 4> left_ahead{{{-1, -1}, {0, -1}, {0, 0}, {-1, 0}}};
constexpr std::array<Step, 4> right_ahead{{{0, -1}, {0, 0}, {-1, 0}, {-1, -1}}};

}  // namespace

std::vector<Position> borderAround(const Image& image, int row, int column) {
  const auto id_at = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= image.width || y >= image.height) return no_site;
    return image.ids[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                     static_cast<std::size_t>(x)];
  };
  const std::uint32_t site = id_at(column, row);
  if (site == no_site) return {};
  while (id_at(column - 1, row) == site) --column;
  // From the lower left corner of that pixel upward.
  const int first_x = column, first_y = row + 1;
  int x = first_x, y = first_y;
  std::size_t way = 0, before = border_steps.size();
  bool has_end = false;  // of the straight part
  std::vector<Position> line;
  do {
    const Step step = border_steps[way];
    // Of a straight part only the ends count.
    const bool goes_on = way == before;
    if (goes_on && has_end) line.pop_back();
    line.push_back({x + step.x / 2.0, y + step.y / 2.0});
    has_end = goes_on;
    before = way;
    x += step.x;
    y += step.y;
    const auto ahead = [&](const std::array<Step, 4>& pixels) {
      return id_at(x + pixels[way].x, y + pixels[way].y) == site;
    };
    if (!ahead(right_ahead)) {
      way = (way + 1) % border_steps.size();
    } else if (ahead(left_ahead)) {
      way = (way + border_steps.size() - 1) % border_steps.size();
    }
  } while (x != first_x || y != first_y || way != 0);
  return line;
}

}  // namespace vorpipe::view

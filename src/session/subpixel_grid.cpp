#include "session/subpixel_grid.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/try.h"

namespace vorpipe::core {
namespace {

/// Pixels along a side of the view, pixels from one shape to the next, and shapes in a view.
constexpr int side = 512, pitch = 4, shapes = side / pitch;
/// Number of pixels by which an edge leans to the right from the bottom of the view to the top, 1/1024 per
/// row.
constexpr float lean = 0.5F;
/// Number of pixels by which the edge moves to the right from one shape to the next.
constexpr float shift = lean / side;
/// Number of views of shapes, through which the edge moves by 1/4 pixel each.
constexpr int grid_rounds = 2;

/// Returns the shapes from number `first` on, side by side, about 2 pixels wide and as high as the view. The
/// left side of each is a leaning edge. It passes the pixel centers of the shape's second column near the
/// middle of the view, lower for larger numbers.
CellBatch<float> shapesFrom(int first) {
  CellBatch<float> batch;
  const float slope = lean / side;
  const float length = std::sqrt(1.0F + slope * slope);
  for (int k = 0; k < shapes; k++) {
    const float at = -0.5F + shift * (static_cast<float>(first + k) - 0.5F * shapes * grid_rounds);
    batch.entries.push_back({static_cast<std::uint32_t>(k), 1, -1.75F, -0.5F * side, 1.25F, 0.5F * side,
                             /*reach=*/1e30F, /*shift=*/0});
    batch.lines.push_back({-1.0F / length, slope / length, -at / length, 0});
  }
  return batch;
}

std::vector<DrawMark> marksOf() {
  std::vector<DrawMark> marks;
  for (int k = 0; k < shapes; k++) {
    const float x = (static_cast<float>(pitch * k) + 2.0F) / (0.5F * side) - 1.0F;
    marks.push_back({x, 0, static_cast<std::uint32_t>(k), 0});
  }
  return marks;
}

/// Draws the shapes from number `first` on. Appends to `heights` the number of pixels that each covers in its
/// second column.
Result<void> drawShapes(Backend& backend, int first, std::vector<int>& heights) {
  const View view{{0, 0, side, side}, side, side, {}};
  VORPIPE_TRY(backend.begin(view));
  std::vector<CellStatus> status(shapes);
  VORPIPE_TRY(backend.draw(shapesFrom(first), marksOf(), Effort::fast, status));
  std::vector<std::uint32_t> rgba(std::size_t{side} * side), ids(rgba.size());
  VORPIPE_TRY(backend.read(rgba, ids));
  for (int k = 0; k < shapes; k++) {
    int height = 0;
    for (int row = 0; row < side; row++) {
      const auto pixel = static_cast<std::size_t>(row * side + pitch * k + 1);
      height += ids[pixel] == static_cast<std::uint32_t>(k) ? 1 : 0;
    }
    heights.push_back(height);
  }
  return {};
}

}  // namespace

Result<std::optional<int>> measureSubpixelBits(Backend& backend) {
  if (backend.info().max_view < side) return std::nullopt;
  std::vector<int> heights;
  for (int round = 0; round < grid_rounds; round++) {
    VORPIPE_TRY(drawShapes(backend, round * shapes, heights));
  }
  std::vector<std::size_t> jumps;
  for (std::size_t k = 1; k < heights.size(); k++) {
    if (heights[k] > heights[k - 1]) return 0;
    if (heights[k] < heights[k - 1]) jumps.push_back(k);
  }
  if (jumps.size() < 2) return 0;
  const double step =
      shift * static_cast<double>(jumps.back() - jumps.front()) / static_cast<double>(jumps.size() - 1);
  return std::min(most_subpixel_bits, static_cast<int>(std::lround(-std::log2(step))));
}

}  // namespace vorpipe::core

/// Inputs that are turned, mirrored, scaled or shifted, and what becomes of their results.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "support/hard/hard_inputs.h"

namespace vorpipe::test {

/// (x, y) becomes scale (xx x + xy y, yx x + yy y) + shift; the four are a turn or a mirror of axes.
struct Move {
  std::string_view name;
  int xx = 1, xy = 0, yx = 0, yy = 1;
  double scale = 1;
  Point shift{0, 0};

  [[nodiscard]] Point operator()(Point p) const;
  [[nodiscard]] Box operator()(const Box& box) const;
  [[nodiscard]] bool turns() const { return xx == 0; }
};

/// Everything of an input moved: sites, weights, domain, outline, period and picture.
HardInput moved(const HardInput& input, const Move& move);

/// Some sites of an input, in that order.
HardInput chosen(const HardInput& input, std::span<const std::uint32_t> sites);

/// The cells of a moved input as those of the input would be: statuses, owners, areas, neighbors with their
/// shifts, and lengths of edges.
Diagram movedBack(const Diagram& diagram, const Move& move);

/// Site k of a diagram, which was site sites[k], as that, of `count`; those that were left out are empty.
Diagram renumbered(const Diagram& diagram, std::span<const std::uint32_t> sites, std::size_t count);

/// The ids of the picture of a moved input as those of the input's picture would be.
std::vector<std::uint32_t> movedBack(const Image& image, const Move& move);

}  // namespace vorpipe::test

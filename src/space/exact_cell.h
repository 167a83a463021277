/// The cell of one site by exact signs: no proposal of it is wrong, whatever the sites.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "space/label.h"

namespace vorpipe::space {

/// Cuts a cell of any number of faces. It begins as the whole box. Vertices carry their places in double with
/// error bounds, so that most tests need no predicate; the others are cuts() of predicates.h.
class ExactCell {
 public:
  ExactCell(const Places& places, Label site);
  /// Cuts with the bisector of a site that is not the cell's own. Returns whether anything was cut off.
  bool cut(Label by);
  [[nodiscard]] bool empty() const;
  /// No point of the cell is farther from the site than the root of this: an upper bound, rounding included.
  [[nodiscard]] double squaredRadius() const;
  /// The vertices, as the labels of their three faces: counter-clockwise seen from outside.
  [[nodiscard]] std::span<const std::array<Label, 3>> vertices() const;
};

}  // namespace vorpipe::space

/// The cell of one site by exact signs: no proposal of it is wrong, whatever the sites.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "space/hidden.h"
#include "space/label.h"
#include "space/vertex_blocks.h"

namespace vorpipe::space {

/// Cuts a cell of any number of faces. It begins as the whole box. Vertices carry their places in double with
/// error bounds, so that most tests need no predicate; the others are cuts() of predicates.h. Which vertices
/// there are depends on these signs alone.
///
/// A cut finds the vertices to remove, and puts new ones on the edges from these to others. Few cuts of a
/// large cell remove many: beyond some hundred vertices only those in blocks that the cut may reach are
/// tested.
class ExactCell {
 public:
  ExactCell(const Places& places, Label site);
  /// Begins anew with another site, in the same memory.
  void reset(Label site);
  /// Cuts with the bisector of a site that is not the cell's own. Returns whether anything was cut off. A
  /// second cut by the same site does nothing.
  bool cut(Label by);
  [[nodiscard]] bool empty() const { return label_.empty(); }
  /// Of an empty cell: why.
  [[nodiscard]] const NoCell& emptiedBy() const { return emptied_by_; }
  /// No point of the cell is farther from the site than the root of this: an upper bound, rounding included.
  [[nodiscard]] double squaredRadius() const;
  /// The vertices, as the labels of their three faces: counter-clockwise seen from outside.
  [[nodiscard]] std::span<const std::array<Label, 3>> vertices() const { return label_; }

 private:
  /// Of a removed vertex, between two of its faces: the first in the upper half.
  using Edge = std::uint64_t;

  [[nodiscard]] VertexSpot spotOf(const std::array<Label, 3>& label) const;
  void findRemoved(Label by);
  void findRim();
  void replaceRemoved(Label by);
  void noteEmpty(Label by);

  Places places_;
  Label site_ = 0;
  std::vector<std::array<Label, 3>> label_;
  std::vector<VertexSpot> spot_;  ///< by vertex
  std::optional<VertexBlocks> blocks_;
  NoCell emptied_by_{};
  mutable double squared_radius_ = -1;  ///< negative: to be found
  std::vector<std::uint32_t> removed_, candidates_;
  std::vector<Edge> rim_;    ///< those that no other removed vertex has
  std::vector<Edge> edges_;  ///< of all removed vertices
};

}  // namespace vorpipe::space

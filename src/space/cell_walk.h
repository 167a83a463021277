/// Walks along the rings of one cell when some of its vertices become one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/disjoint_sets.h"
#include "space/ring_walk.h"
#include "space/rows.h"
#include "space/shared_vertices.h"

namespace vorpipe::space {

/// Walks along rings of cells, one cell after another. Vertices that are one have the same name in a cell, a
/// number below names().
class CellWalk {
 public:
  CellWalk(const SharedVertices& vertices, DisjointSets& sets) : vertices_(vertices), sets_(sets) {}

  /// Takes a cell, by its place among those of the vertices. isNone(v): rings go straight on at vertex v,
  /// which others may have become.
  template <class IsNone>
  void take(std::size_t cell, const Row& row, const IsNone& isNone);

  [[nodiscard]] std::size_t names() const { return became_.size(); }
  /// The vertex that those of a name have become.
  [[nodiscard]] std::uint32_t became(std::uint32_t name) const { return became_[name]; }

  /// The steps along the ring of a face between vertices that are not one, from the k-th edge end on. Each
  /// leads to a name.
  [[nodiscard]] std::vector<RingStep>& walk(const Row& row, std::size_t face, std::size_t k);
  /// Whether two of the last steps lead to the same name.
  [[nodiscard]] bool visitsAgain() {
    bool any = false;
    forEachAgain([&any](std::uint32_t) { any = true; });
    return any;
  }
  /// Calls each(name) for steps to a name that one of those before leads to.
  template <class Each>
  void forEachAgain(const Each& each);

 private:
  static constexpr std::uint32_t no_name = 0xffffffff;
  std::uint32_t nameOf(std::uint32_t became);

  const SharedVertices& vertices_;
  DisjointSets& sets_;
  std::vector<std::uint32_t> became_;          ///< by name
  std::vector<std::uint32_t> named_, at_end_;  ///< by vertex of the cell, and by edge end: a name
  std::vector<RingStep> steps_;
  std::vector<std::uint32_t> visited_;  ///< by name: in which walk
  std::uint32_t walks_ = 0;
  // Names by what they stand for. An entry is valid if the name says that it has this slot.
  std::vector<std::uint32_t> table_, slot_;
  std::uint32_t mask_ = 0;
};

template <class IsNone>
void CellWalk::take(std::size_t cell, const Row& row, const IsNone& isNone) {
  const auto vertices = vertices_.of(cell);
  became_.clear();
  named_.resize(vertices.size());
  if (2 * vertices.size() > table_.size()) {
    std::size_t room = 64;
    while (room < 2 * vertices.size()) room *= 2;
    table_.assign(room, 0);
    slot_.assign(room, 0);
    visited_.assign(room, 0);
    walks_ = 0;
    mask_ = static_cast<std::uint32_t>(room - 1);
  }
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const std::uint32_t root = sets_.root(vertices[v]);
    named_[v] = isNone(root) ? no_name : nameOf(root);
  }
  at_end_.resize(row.edge_ends);
  vertices_.forEnds(cell, row.edge_ends,
                    [this](std::size_t end, std::size_t vertex) { at_end_[end] = named_[vertex]; });
}

template <class Each>
void CellWalk::forEachAgain(const Each& each) {
  if (++walks_ == 0) {
    visited_.assign(visited_.size(), 0);
    ++walks_;
  }
  for (const RingStep& step : steps_) {
    if (visited_[step.to] == walks_) each(step.to);
    visited_[step.to] = walks_;
  }
}

}  // namespace vorpipe::space

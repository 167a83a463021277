/// Which short edges are ties.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/big_vector.h"
#include "base/disjoint_sets.h"
#include "space/cell_walk.h"
#include "space/edge_classes.h"
#include "space/shared_vertices.h"
#include "space/short_edges.h"

namespace vorpipe::space {

/// Joins the ends of ties, with the definition of Contraction.
class TiedEdges {
 public:
  /// `vertices` has all cells around the ends of the edges.
  TiedEdges(const Places& places, const Rows& rows, const SharedVertices& vertices,
            std::vector<ShortEdge> edges, int threads);

  /// Returns the number of ties.
  std::uint64_t join(DisjointSets& sets);
  /// The vertices of joined sets that are too wide, ascending.
  [[nodiscard]] std::vector<std::uint32_t> findWide(DisjointSets& sets) const;
  /// Makes ties shorter at the vertices that became these; false if they are as short as rounding errors.
  bool makeFiner(DisjointSets& sets, std::span<const std::uint32_t> became);

 private:
  struct Ends {
    std::uint32_t from, to;
  };
  struct Pair {
    std::uint32_t candidate, other;
  };
  /// Edges that are ties if all that are one with them are.
  struct Candidates;

  /// What ties are multiplied by at an edge.
  [[nodiscard]] double finenessAt(std::size_t edge) const;
  std::vector<std::uint32_t> joinShortest(DisjointSets& sets) const;
  [[nodiscard]] std::vector<Pair> findOnes(DisjointSets& sets, const Candidates& candidates) const;
  void findOnesOf(std::size_t cell, CellWalk& walk, const Candidates& candidates,
                  std::vector<Pair>& pairs) const;
  [[nodiscard]] bool isWide(std::span<const std::uint32_t> edges) const;

  const Places& places_;
  const Rows& rows_;
  const SharedVertices& vertices_;
  std::vector<ShortEdge> edges_;
  BigVector<Ends> ends_;             ///< by edge
  std::vector<std::uint8_t> finer_;  ///< by vertex: steps of 64; empty if there are none
  int threads_;
};

}  // namespace vorpipe::space

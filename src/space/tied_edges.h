/// Which short edges are ties.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "base/disjoint_sets.h"
#include "space/edge_classes.h"
#include "space/shared_vertices.h"
#include "space/short_edges.h"

namespace vorpipe::space {

/// Joins the ends of ties, with the definition of Contraction.
class TiedEdges {
 public:
  /// `vertices` has all cells around the ends of the edges.
  TiedEdges(const Places& places, const Rows& rows, const SharedVertices& vertices,
            std::vector<ShortEdge> edges, int threads)
      : places_(places), rows_(rows), vertices_(vertices), edges_(std::move(edges)), threads_(threads) {}

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
  [[nodiscard]] Ends endsOf(const ShortEdge& edge) const;
  [[nodiscard]] EdgeLabels labelsOf(Label site, std::size_t edge_end) const;
  /// What ties are multiplied by at an edge.
  [[nodiscard]] double finenessAt(const Ends& ends) const;
  void joinOnes(DisjointSets& sets, const std::vector<std::uint32_t>& candidates, EdgeClasses& classes) const;
  [[nodiscard]] bool isWide(std::span<const std::uint32_t> edges) const;

  const Places& places_;
  const Rows& rows_;
  const SharedVertices& vertices_;
  std::vector<ShortEdge> edges_;
  std::unordered_map<std::uint32_t, std::uint8_t> finer_;  ///< by vertex: steps of 64
  int threads_;
};

}  // namespace vorpipe::space

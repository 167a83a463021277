/// A spatial index of the edges of rings.
#pragma once

#include <memory>

#include "domain/rings.h"

namespace vorpipe::core {

/// Thread safe.
class OutlineIndex {
 public:
  /// Keeps a reference to `rings`.
  explicit OutlineIndex(const Rings& rings);
  OutlineIndex(const OutlineIndex&) = delete;
  OutlineIndex& operator=(const OutlineIndex&) = delete;
  ~OutlineIndex();

  [[nodiscard]] const Rings& rings() const { return rings_; }

  /// Replaces `edges` by those whose boxes meet `box`, in ascending order.
  void edgesIn(const Box& box, std::vector<std::uint32_t>& edges) const;

  /// Whether a point lies inside; exact. A point on an edge is decided as in sideOf.
  [[nodiscard]] bool contains(Point p) const { return turnsAround(p) % 2 != 0; }

  /// The winding number of the rings around a point, counter-clockwise; exact likewise; rings may cross.
  [[nodiscard]] int turnsAround(Point p) const;

  /// Whether a point lies on an edge; exact.
  [[nodiscard]] bool isOnEdge(Point p) const;

 private:
  struct Tree;
  const Rings& rings_;
  std::unique_ptr<Tree> tree_;
};

}  // namespace vorpipe::core

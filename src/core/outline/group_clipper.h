/// Clips cells to an outline, group by group.
#pragma once

#include "core/outline/clipped_records.h"
#include "core/outline/contacts.h"

namespace vorpipe::core {

/// For one thread; keeps references. Different cells may be clipped at the same time.
class GroupClipper {
 public:
  GroupClipper(const ClippedRun& run, const ScaledDiagram& cells, const OutlineIndex& index,
               ClippedCells& out);

  /// Clips the cells `first` to `last` - 1 of the set, as if they had no contacts, which it adds to `found`.
  /// Adds those to `near` whose own corners may be on another side of the outline.
  void group(std::size_t first, std::size_t last, std::vector<std::uint32_t>& near, Contacts& found);

  /// Clips a cell that is near again, with the contacts as its vertices: vertices of the diagram have moved,
  /// and the rings of the index have nodes.
  void again(std::uint32_t cell);

 private:
  struct Member {
    std::uint32_t cell, site;
    std::size_t first, count;  ///< of points_ and neighbors_
  };

  void collect(std::size_t first_cell, std::size_t last_cell);
  void findEdges(std::span<const Point> places);
  [[nodiscard]] bool runsAlongOutline(std::span<const Point> cell) const;
  [[nodiscard]] CellSides sidesOf(const Member& member) const;
  [[nodiscard]] Fate fateOf(Point p) const { return index_.contains(p) ? Fate::inside : Fate::outside; }
  Fate clip(std::span<const Point> vertices, std::span<const std::int64_t> neighbors);
  Fate keepPart(std::uint32_t site);

  const ScaledDiagram& cells_;
  const OutlineIndex& index_;
  OutlineClip clip_;
  ClippedCells& out_;
  double margin_;
  ContactFinder finder_;
  std::vector<Member> members_;
  std::vector<Point> points_, vertices_;
  std::vector<std::int64_t> neighbors_, labels_;
  std::vector<std::uint32_t> near_;
  ClippedCell clipped_;
};

}  // namespace vorpipe::core

/// Clips cells to an outline, group by group.
#pragma once

#include "domain/clean_rings.h"
#include "domain/clipped_records.h"
#include "domain/contacts.h"

namespace vorpipe::core {

/// Points at which edges of an outline and sides of cells must meet, because rounding has made them cross
/// elsewhere (decision D123).
struct RoundedNodes {
  std::vector<EdgeNode> on_edges;
  std::vector<SideNode> on_sides;
};

/// For one thread; keeps references. Different cells may be clipped at the same time.
class GroupClipper {
 public:
  GroupClipper(const ClippedRun& run, const ScaledDiagram& cells, const OutlineIndex& index,
               ClippedCells& out);

  /// Clips the cells `first` to `last` - 1 of the set as if they had no contacts, and adds their contacts to
  /// `found`. Adds to `near` cells whose own corners may be on another side of the outline.
  void group(std::size_t first, std::size_t last, std::vector<std::uint32_t>& near, Contacts& found);

  /// Clips a near cell again, with the contacts as its vertices. By now vertices of the diagram have moved,
  /// unless off walls, and the rings of the index and the sides have nodes. Adds to `found` further points at
  /// which rounding makes edges meet.
  void again(std::uint32_t cell, std::span<const MovedVertex> moved, std::span<const SideNode> nodes,
             RoundedNodes& found);

 private:
  struct Member {
    std::uint32_t cell, site;
    std::size_t first, count;  ///< range in points_ and neighbors_
  };

  void collect(std::size_t first_cell, std::size_t last_cell);
  bool leaveWalls(std::span<const MovedVertex> moved);
  void findEdges(std::span<const Point> places);
  [[nodiscard]] bool runsAlongOutline(std::span<const Point> cell) const;
  [[nodiscard]] CellSides sidesOf(const Member& member) const;
  [[nodiscard]] Fate fateOf(Point p) const { return index_.contains(p) ? Fate::inside : Fate::outside; }
  Fate clip(std::span<const Point> vertices, std::span<const std::int64_t> neighbors);
  Fate traceBorder(std::span<const Point> vertices, std::span<const std::int64_t> neighbors);
  Fate keepPart(std::uint32_t site);
  [[nodiscard]] bool hasFaultsAtCrossings();
  void findRounded(const CellSides& sides, RoundedNodes& found);
  void join(const CellSides& sides, Point a, Point b, Point p, RoundedNodes& found) const;
  void addToEdge(std::uint32_t edge, Point p, RoundedNodes& found) const;
  void addToSide(const CellSides& sides, std::size_t part, Point p, RoundedNodes& found) const;

  const ClippedRun& run_;
  const ScaledDiagram& cells_;
  const OutlineIndex& index_;
  OutlineClip clip_;
  ClippedCells& out_;
  double margin_;
  ContactFinder finder_;
  std::vector<Member> members_;
  std::vector<Point> points_, rounded_, off_points_;
  std::vector<std::int64_t> neighbors_, off_neighbors_;
  RefinedSides refined_;
  std::vector<std::uint32_t> near_, asked_;
  std::vector<EdgePair> faults_;
  std::vector<BorderEdge> border_;
  ClippedCell clipped_;
};

}  // namespace vorpipe::core

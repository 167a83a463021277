/// The certificate of a cell in space: conditions C1 to C3 of docs/space-algorithm.md.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "space/corner_lanes.h"
#include "space/measures.h"
#include "space/rows.h"

namespace vorpipe::space {

/// Which condition a cell breaks.
enum class Broken : std::uint8_t {
  nothing,
  row,          ///< C1: it has fewer than four faces, or two of one neighbor
  rings,        ///< C1: its rings do not close around its vertices
  glue,         ///< C1: a neighbor has no such face, or another ring in it
  orientation,  ///< C2
  edge,         ///< C3
};

struct Verdict {
  Broken broken = Broken::nothing;
  /// For glue the neighbor, for orientation and edge the labels of the vertices: sites whose cells are in
  /// dispute, besides the cell itself. Walls and -7 name none.
  std::array<Label, 4> with{-7, -7, -7, -7};
  std::uint32_t nearest = 0;  ///< the neighbor whose site is nearest, and its distance
  double distance = HUGE_VAL;
  bool tied = false;    ///< an edge may be a tie
  bool unsure = false;  ///< a vertex is too badly conditioned for measures
};

/// Which signs of a cell are proved exactly where double does not prove them.
enum class Signs : std::uint8_t {
  of_least,  ///< those of vertices and edges of which the cell is the least: others do so for the rest
  all,       ///< all, of a cell without neighbors: it is not expected to be glued to any
  none,      ///< none: it was made by exact signs, of all sites that can cut it
};

/// Checks cells one after another; one for each thread.
class CellCheck {
 public:
  /// `moments`: whether secondMoments() are wanted.
  CellCheck(const Places& places, const Rows& rows, bool moments = false);

  /// Checks the cell of a site that has a row.
  Verdict check(Label site, Signs signs = Signs::of_least, bool measure = true);

  // Of the last cell, if it was measured, is not broken and not unsure.
  [[nodiscard]] std::size_t vertices() const { return job_.vertices; }
  /// Relative to the site.
  [[nodiscard]] Point3 vertex(std::size_t v) const { return {job_.x[v], job_.y[v], job_.z[v]}; }
  [[nodiscard]] CellMeasures measures() const;
  [[nodiscard]] double faceArea(std::size_t face) const;
  /// About the centroid: xx, yy, zz, yz, xz, xy.
  [[nodiscard]] std::array<double, 6> secondMoments() const;

 private:
  bool takeRow();
  bool takeRings();
  template <class Index, class Begin, class Entry>
  bool takeRingsOf(Index& index, const Begin* begin, const Entry* rings);
  [[nodiscard]] bool isGlued(Verdict& verdict) const;
  bool provedExactly(Verdict& verdict, bool all) const;
  void reserve(std::size_t faces, std::size_t edge_ends);

  const Places& places_;
  const Rows& rows_;
  FindCorners find_corners_;
  double tie_wall_;
  Label site_ = 0;
  Row row_;
  std::vector<double> by_face_, by_vertex_;
  std::vector<std::int32_t> corners_, edges_;
  std::vector<std::uint8_t> turned_, unproved_;
  std::size_t face_room_ = 0, vertex_room_ = 0, edge_room_ = 0;
  double *nx_ = nullptr, *ny_ = nullptr, *nz_ = nullptr, *h_ = nullptr, *distance_ = nullptr,
         *h_size_ = nullptr;
  CornerJob job_{};
};

}  // namespace vorpipe::space

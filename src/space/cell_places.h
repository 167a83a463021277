/// Where the vertices of one cell are.
#pragma once

#include <vector>

#include "space/label.h"
#include "space/relative.h"
#include "space/row_vertices.h"
#include "space/rows.h"

namespace vorpipe::space {

/// A place relative to a site, and how far off it may be at most.
struct VertexPlace {
  double x, y, z, error;
};

/// Computes places of the vertices of cells, one cell after another: in double where they are well
/// conditioned, elsewhere by vertexPlace().
class CellPlaces {
 public:
  explicit CellPlaces(const Places& places) : places_(places) {}

  void take(Label site, const Row& row);
  /// The place of the vertex where these faces turn counter-clockwise.
  [[nodiscard]] VertexPlace at(const std::array<std::uint32_t, 3>& faces) const;
  /// By face: what p . (x, y, z) = lift / 2 there.
  [[nodiscard]] const Relative& face(std::size_t f) const { return face_[f]; }

 private:
  const Places& places_;
  Label site_ = 0;
  Row row_;
  std::vector<Relative> face_;
};

}  // namespace vorpipe::space

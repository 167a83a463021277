#include "io/cells_mesh.h"

#include <fmt/core.h>

#include <bit>
#include <limits>

#include "io/cell_records.h"
#include "io/error.h"

namespace vorpipe {
namespace {

constexpr std::int32_t vacant = -1;

std::size_t hash(const Point& point) {
  // Adding 0 makes -0 and 0, which are equal, one bit pattern.
  const auto x = std::bit_cast<std::uint64_t>(point.x + 0.0);
  const auto y = std::bit_cast<std::uint64_t>(point.y + 0.0);
  std::uint64_t bits = (x ^ std::rotl(y, 32)) * 0x9E3779B97F4A7C15u;
  bits ^= bits >> 32;
  bits *= 0xD6E8FEB86659FD93u;
  return bits ^ bits >> 32;
}

/// Positions by value. A table of open addresses: one allocation where a map of the standard library
/// makes one for each of tens of millions of points.
class PointTable {
 public:
  PointTable(std::size_t most_points, std::vector<Point>& points)
      : slots_(std::bit_ceil(2 * most_points + 1), vacant), points_(points) {}

  std::int32_t indexOf(const Point& point) {
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t slot = hash(point) & mask;; slot = (slot + 1) & mask) {
      std::int32_t& index = slots_[slot];
      if (index == vacant) {
        index = static_cast<std::int32_t>(points_.size());
        points_.push_back(point);
        return index;
      }
      const Point& known = points_[static_cast<std::size_t>(index)];
      if (known.x == point.x && known.y == point.y) {
        return index;
      }
    }
  }

 private:
  std::vector<std::int32_t> slots_;
  std::vector<Point>& points_;
};

}  // namespace

Result<CellsMesh> cellsMesh(const OutputFile& file, const Diagram& diagram) {
  // .vtk counts the corners of all faces and the faces together.
  const std::uint64_t largest = diagram.vertices.size() + diagram.status.size();
  if (largest > std::numeric_limits<std::int32_t>::max()) {
    return inputError(fmt::format("{}: cells with {} vertices are too many for this kind of file; write .npz",
                                  file.name(), diagram.vertices.size()));
  }
  CellsMesh mesh;
  mesh.corners.reserve(diagram.vertices.size());
  PointTable table(diagram.vertices.size(), mesh.points);
  for (const Point& vertex : diagram.vertices) {
    mesh.corners.push_back(table.indexOf(vertex));
  }
  for (std::size_t site = 0; site < diagram.status.size(); ++site) {
    if (hasPolygon(diagram, site)) {
      mesh.faces.push_back(static_cast<std::uint32_t>(site));
      mesh.face_corners += verticesOf(diagram, site).size();
    }
  }
  return mesh;
}

}  // namespace vorpipe

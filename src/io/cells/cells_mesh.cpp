#include "io/cells/cells_mesh.h"

#include <fmt/core.h>

#include <bit>
#include <limits>

#include "io/cells/cell_rings.h"
#include "io/cells/hole_triangles.h"
#include "io/files/error.h"

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

class MeshMaker {
 public:
  MeshMaker(const Diagram& diagram, CellsMesh& mesh)
      : diagram_(diagram), mesh_(mesh), table_(diagram.vertices.size(), mesh.points) {
    mesh_.corners.reserve(diagram.vertices.size());
    mesh_.offsets.push_back(0);
  }

  /// Adds the faces of a site's cell; whether its pieces with holes could be cut into triangles.
  [[nodiscard]] bool add(std::uint32_t site) {
    const auto rings = ringsOf(diagram_, site);
    for (const auto piece : piecesOf(rings)) {
      if (piece.size() == 1) {
        addFace(verticesOf(diagram_, piece.front()), site);
        continue;
      }
      const auto triangles = trianglesOf(diagram_, piece);
      if (!triangles) return false;
      for (const auto& triangle : *triangles) addFace(triangle, site);
    }
    return true;
  }

 private:
  void addFace(std::span<const Point> vertices, std::uint32_t site) {
    for (const Point& vertex : vertices) mesh_.corners.push_back(table_.indexOf(vertex));
    mesh_.offsets.push_back(mesh_.corners.size());
    mesh_.sites.push_back(site);
  }

  const Diagram& diagram_;
  CellsMesh& mesh_;
  PointTable table_;
};

}  // namespace

Result<CellsMesh> cellsMesh(const ByteSink& sink, const Diagram& diagram) {
  const auto tooMany = [&] {
    return inputError(fmt::format("{}: cells with {} vertices are too many for this kind of file; write .npz",
                                  sink.name(), diagram.vertices.size()));
  };
  constexpr std::uint64_t largest = std::numeric_limits<std::int32_t>::max();
  if (diagram.vertices.size() > largest) return tooMany();
  CellsMesh mesh;
  MeshMaker maker(diagram, mesh);
  for (std::size_t site = 0; site < diagram.status.size(); ++site) {
    if (!maker.add(static_cast<std::uint32_t>(site))) {
      return deviceError(fmt::format("{}: the cell of site {} has holes, and could not be cut into triangles",
                                     sink.name(), site));
    }
  }
  // .vtk counts the corners of all faces and the faces together.
  if (mesh.corners.size() + mesh.size() > largest) return tooMany();
  return mesh;
}

}  // namespace vorpipe

#include "io/cells/cells_mesh.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "io/base/error.h"
#include "io/cells/cell_rings.h"
#include "io/cells/hole_triangles.h"

namespace vorpipe {
namespace {

class MeshMaker {
 public:
  MeshMaker(const Diagram& diagram, DistinctPoints vertices, CellsMesh& mesh)
      : diagram_(diagram), vertex_of_(std::move(vertices.index_of)), mesh_(mesh) {
    mesh_.points = std::move(vertices.points);
    mesh_.corners.reserve(diagram.vertices.size());
    mesh_.offsets.push_back(0);
  }

  /// Adds the faces of a site's cell; returns whether its pieces with holes could be cut into triangles.
  [[nodiscard]] bool add(std::uint32_t site) {
    const auto rings = ringsOf(diagram_, site);
    for (const auto piece : piecesOf(rings)) {
      if (piece.size() == 1) {
        for (auto entry = piece.front().begin; entry < piece.front().end; ++entry) addCorner(entry);
        endFace(site);
        continue;
      }
      const auto triangles = trianglesOf(diagram_, piece);
      if (!triangles) return false;
      const auto entries = byPosition(piece);
      for (const auto& triangle : *triangles) {
        for (const Point& corner : triangle) {
          const auto entry = entryAt(entries, corner);
          if (!entry) return false;
          addCorner(*entry);
        }
        endFace(site);
      }
    }
    return true;
  }

  /// Numbers the points in the order of first use by the faces, and drops unused ones.
  void numberPoints() {
    if (in_order_ && met_ == mesh_.points.size()) return;
    std::vector<std::uint32_t>().swap(vertex_of_);
    constexpr std::int32_t not_met = -1;
    std::vector<std::int32_t> number(mesh_.points.size(), not_met);
    std::vector<Point> points;
    points.reserve(mesh_.points.size());
    for (std::int32_t& corner : mesh_.corners) {
      const auto known = static_cast<std::size_t>(corner);
      if (number[known] == not_met) {
        number[known] = static_cast<std::int32_t>(points.size());
        points.push_back(mesh_.points[known]);
      }
      corner = number[known];
    }
    mesh_.points = std::move(points);
  }

 private:
  void addCorner(std::uint64_t entry) {
    const std::uint32_t vertex = vertex_of_[entry];
    if (vertex > met_) in_order_ = false;
    if (vertex == met_) ++met_;
    mesh_.corners.push_back(static_cast<std::int32_t>(vertex));
  }
  void endFace(std::uint32_t site) {
    mesh_.offsets.push_back(mesh_.corners.size());
    mesh_.sites.push_back(site);
  }

  [[nodiscard]] std::vector<std::uint64_t> byPosition(std::span<const Ring> piece) const {
    std::vector<std::uint64_t> entries;
    for (const Ring& ring : piece) {
      for (auto entry = ring.begin; entry < ring.end; ++entry) entries.push_back(entry);
    }
    std::ranges::sort(entries, isBefore, [this](std::uint64_t entry) { return diagram_.vertices[entry]; });
    return entries;
  }
  /// Returns the entry of a triangle's corner: triangles only have vertices of their piece.
  [[nodiscard]] std::optional<std::uint64_t> entryAt(const std::vector<std::uint64_t>& entries,
                                                     const Point& corner) const {
    const auto vertex = [this](std::uint64_t entry) { return diagram_.vertices[entry]; };
    const auto found = std::ranges::lower_bound(entries, corner, isBefore, vertex);
    if (found == entries.end() || isBefore(corner, vertex(*found))) return std::nullopt;
    return *found;
  }
  static bool isBefore(const Point& a, const Point& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

  const Diagram& diagram_;
  std::vector<std::uint32_t> vertex_of_;  ///< by place in Diagram::vertices
  CellsMesh& mesh_;
  std::size_t met_ = 0;  ///< points used by corners so far, while they are in order
  bool in_order_ = true;
};

}  // namespace

Result<CellsMesh> cellsMesh(const ByteSink& sink, const Diagram& diagram) {
  const auto tooMany = [&] {
    return inputError(fmt::format("{}: cells with {} vertices are too many for this kind of file; write .npz",
                                  sink.name(), diagram.vertices.size()));
  };
  constexpr std::uint64_t largest = std::numeric_limits<std::int32_t>::max();
  if (diagram.vertices.size() > largest) return tooMany();
  auto vertices = distinctPoints(diagram.vertices);
  if (!vertices) return tl::unexpected(vertices.error());
  CellsMesh mesh;
  MeshMaker maker(diagram, std::move(*vertices), mesh);
  for (std::size_t site = 0; site < diagram.size(); ++site) {
    if (!maker.add(static_cast<std::uint32_t>(site))) {
      return deviceError(fmt::format("{}: the cell of site {} has holes, and could not be cut into triangles",
                                     sink.name(), site));
    }
  }
  // .vtk stores one count of all faces plus their corners.
  if (mesh.corners.size() + mesh.size() > largest) return tooMany();
  maker.numberPoints();
  return mesh;
}

}  // namespace vorpipe

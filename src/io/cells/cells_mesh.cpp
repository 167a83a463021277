#include "io/cells/cells_mesh.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>

#include "base/geos.h"
#include "base/try.h"
#include "io/base/error.h"
#include "io/cells/cell_polygons.h"

namespace vorpipe {
namespace {

/// Splits `rings` into polygons, each an outer ring and its holes.
std::vector<std::span<const Ring>> piecesOf(std::span<const Ring> rings) {
  std::vector<std::span<const Ring>> pieces;
  while (!rings.empty()) {
    const auto next =
        std::find_if(rings.begin() + 1, rings.end(), [](const Ring& ring) { return !ring.hole; });
    const auto size = static_cast<std::size_t>(next - rings.begin());
    pieces.push_back(rings.first(size));
    rings = rings.subspan(size);
  }
  return pieces;
}

using Triangles = std::vector<std::array<Point, 3>>;

std::array<Point, 3> cornersOf(GEOSContextHandle_t context, const GEOSGeometry* triangle) {
  const auto* const sequence = GEOSGeom_getCoordSeq_r(context, GEOSGetExteriorRing_r(context, triangle));
  std::array<Point, 3> corners{};
  for (unsigned k = 0; k < corners.size(); ++k) {
    GEOSCoordSeq_getXY_r(context, sequence, k, &corners[k].x, &corners[k].y);
  }
  char counter_clockwise = 1;
  GEOSCoordSeq_isCCW_r(context, sequence, &counter_clockwise);
  if (counter_clockwise == 0) std::swap(corners[1], corners[2]);
  return corners;
}

/// Returns counter-clockwise triangles that fill a piece of a cell, using only its vertices; none if GEOS
/// finds that the rings form no polygon.
std::optional<Triangles> trianglesOf(const Diagram& diagram, std::span<const Ring> piece) {
  const Geos geos;
  std::vector<GeosGeometry> rings;
  for (const Ring& ring : piece) rings.push_back(geosRing(geos, verticesOf(diagram, ring)));
  const GeosGeometry polygon = geosPolygon(geos, std::move(rings));
  if (!polygon) return std::nullopt;
  const GeosGeometry found =
      owned(geos, GEOSConstrainedDelaunayTriangulation_r(geos.handle(), polygon.get()));
  if (!found) return std::nullopt;
  const int count = GEOSGetNumGeometries_r(geos.handle(), found.get());
  Triangles triangles;
  for (int k = 0; k < count; ++k) {
    triangles.push_back(cornersOf(geos.handle(), GEOSGetGeometryN_r(geos.handle(), found.get(), k)));
  }
  return triangles;
}

bool isBefore(const Point& a, const Point& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

/// The vertices of a piece, by their places.
class PieceVertices {
 public:
  PieceVertices(const Diagram& diagram, std::span<const Ring> piece) : diagram_(diagram) {
    for (const Ring& ring : piece) {
      for (auto entry = ring.begin; entry < ring.end; ++entry) entries_.push_back(entry);
    }
    std::ranges::sort(entries_, isBefore, [this](std::uint64_t entry) { return diagram_.vertices[entry]; });
  }
  /// Returns the entry of a triangle's corner: triangles only have vertices of their piece.
  [[nodiscard]] std::optional<std::uint64_t> at(const Point& corner) const {
    const auto vertex = [this](std::uint64_t entry) { return diagram_.vertices[entry]; };
    const auto found = std::ranges::lower_bound(entries_, corner, isBefore, vertex);
    if (found == entries_.end() || isBefore(corner, vertex(*found))) return std::nullopt;
    return *found;
  }

 private:
  const Diagram& diagram_;
  std::vector<std::uint64_t> entries_;
};

/// Whether the triangles from a ring's first vertex to its sides fill it: none of them is turned over.
bool isFan(std::span<const Point> ring) {
  const Point& a = ring.front();
  for (std::size_t k = 2; k < ring.size(); ++k) {
    const Point &b = ring[k - 1], &c = ring[k];
    if ((b.x - a.x) * (c.y - a.y) < (b.y - a.y) * (c.x - a.x)) return false;
  }
  return true;
}

/// Adds the triangles of a piece; returns whether it could be cut.
bool addTriangles(const Diagram& diagram, std::span<const Ring> piece, bool is_convex, CellTriangles& to) {
  const auto add = [&](std::uint64_t a, std::uint64_t b, std::uint64_t c) {
    to.triangles.push_back(
        {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)});
  };
  const Ring& outer = piece.front();
  if (piece.size() == 1 && (is_convex || isFan(verticesOf(diagram, outer)))) {
    for (auto entry = outer.begin + 2; entry < outer.end; ++entry) add(outer.begin, entry - 1, entry);
    return true;
  }
  const auto triangles = trianglesOf(diagram, piece);
  if (!triangles) return false;
  const PieceVertices vertices(diagram, piece);
  for (const auto& [a, b, c] : *triangles) {
    const auto first = vertices.at(a), second = vertices.at(b), third = vertices.at(c);
    if (!first || !second || !third) return false;
    add(*first, *second, *third);
  }
  return true;
}

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
      const PieceVertices vertices(diagram_, piece);
      for (const auto& triangle : *triangles) {
        for (const Point& corner : triangle) {
          const auto entry = vertices.at(corner);
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
    if (in_order_ && used_ == mesh_.points.size()) return;
    std::vector<std::uint32_t>().swap(vertex_of_);
    constexpr std::int32_t unused = -1;
    std::vector<std::int32_t> number(mesh_.points.size(), unused);
    std::vector<Point> points;
    points.reserve(mesh_.points.size());
    for (std::int32_t& corner : mesh_.corners) {
      const auto point = static_cast<std::size_t>(corner);
      if (number[point] == unused) {
        number[point] = static_cast<std::int32_t>(points.size());
        points.push_back(mesh_.points[point]);
      }
      corner = number[point];
    }
    mesh_.points = std::move(points);
  }

 private:
  void addCorner(std::uint64_t entry) {
    const std::uint32_t vertex = vertex_of_[entry];
    if (vertex > used_) in_order_ = false;
    if (vertex == used_) ++used_;
    mesh_.corners.push_back(static_cast<std::int32_t>(vertex));
  }
  void endFace(std::uint32_t site) {
    mesh_.offsets.push_back(mesh_.corners.size());
    mesh_.sites.push_back(site);
  }

  const Diagram& diagram_;
  std::vector<std::uint32_t> vertex_of_;  ///< by position in Diagram::vertices
  CellsMesh& mesh_;
  std::size_t used_ = 0;  ///< points used by corners so far, while they are in order
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
  VORPIPE_VAR(vertices, distinctPoints(diagram.vertices));
  CellsMesh mesh;
  MeshMaker maker(diagram, std::move(vertices), mesh);
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

Result<CellTriangles> cellTriangles(const Diagram& diagram) {
  if (!diagram.solid_angle.empty()) {
    return inputError("triangles: are of cells in a plane, and these are on the globe");
  }
  if (diagram.vertices.size() > std::numeric_limits<std::uint32_t>::max()) {
    return inputError(
        fmt::format("triangles: {} vertices are more than 32 bits count", diagram.vertices.size()));
  }
  CellTriangles found;
  if (diagram.vertices.empty()) return found;  // offsets may be those of neighbors
  found.triangles.reserve(diagram.vertices.size());
  found.sites.resize(diagram.vertices.size());
  const bool is_convex = diagram.ring_starts.empty();
  for (std::size_t site = 0; site < diagram.size(); ++site) {
    std::fill(found.sites.begin() + static_cast<std::ptrdiff_t>(diagram.cell_offsets[site]),
              found.sites.begin() + static_cast<std::ptrdiff_t>(diagram.cell_offsets[site + 1]),
              static_cast<std::uint32_t>(site));
    const auto rings = ringsOf(diagram, site);
    for (const auto piece : piecesOf(rings)) {
      if (addTriangles(diagram, piece, is_convex, found)) continue;
      return deviceError(fmt::format("triangles: the cell of site {} could not be cut into triangles", site));
    }
  }
  return found;
}

}  // namespace vorpipe

// Cells on the globe as faces in space.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <unordered_map>
#include <utility>

#include "base/try.h"
#include "io/base/error.h"
#include "io/cells/cell_polygons.h"
#include "io/cells/cells_mesh.h"

namespace vorpipe {
namespace {

constexpr double piece_degrees = 5;
/// Of edges: those of a cell that is one face are no longer, so that its neighbors have them whole.
constexpr double longest_side = 2.01 * piece_degrees;

double dot(const Point3& a, const Point3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Point3 cross(const Point3& a, const Point3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Point3 normalized(const Point3& a) {
  const double length = std::sqrt(dot(a, a));
  return {a.x / length, a.y / length, a.z / length};
}

/// The plane that touches the sphere about amid some points, where great circles are lines (gnomonic).
class TouchingPlane {
 public:
  explicit TouchingPlane(std::span<const Point3> points) : center_(points.front()) {
    // Badoiu and Clarkson 2003, "Smaller core-sets for balls": a cap around all of them is hardly larger.
    constexpr int steps = 60;
    for (int step = 2; step < steps; ++step) {
      const Point3& far = *std::ranges::min_element(points, {}, [&](auto& p) { return dot(center_, p); });
      const double part = 1.0 / step;
      center_ = normalized({center_.x + part * (far.x - center_.x), center_.y + part * (far.y - center_.y),
                            center_.z + part * (far.z - center_.z)});
    }
    const bool is_level = std::abs(center_.z) < 0.5;
    right_ = normalized(cross(is_level ? Point3{0, 0, 1} : Point3{1, 0, 0}, center_));
    up_ = cross(center_, right_);
  }

  [[nodiscard]] Point at(const Point3& p) const {
    const double depth = dot(center_, p);
    return {dot(right_, p) / depth, dot(up_, p) / depth};
  }
  /// The cosine of the angle to the point that is farthest from the center.
  [[nodiscard]] double reach(std::span<const Point3> points) const {
    double nearest = 1;
    for (const Point3& p : points) nearest = std::min(nearest, dot(center_, p));
    return nearest;
  }

 private:
  Point3 center_, right_{}, up_{};
};

struct PlaceHash {
  std::size_t operator()(const Point3& p) const {
    const std::hash<double> of;
    return (of(p.x) * 31 + of(p.y)) * 31 + of(p.z);
  }
};

class GlobeFaces {
 public:
  GlobeFaces(const Sites& sites, const Diagram& diagram, DistinctPoints vertices, CellsMesh& mesh)
      : sites_(sites), diagram_(diagram), vertex_of_(std::move(vertices.index_of)), mesh_(mesh) {
    for (const Point place : vertices.points) addPoint(onGlobe(place));
    mesh_.offsets.push_back(0);
  }

  void add(std::uint32_t site) {
    if (diagram_.status[site] != Status::ok) return;
    const Cell cell = diagram_.cell(site);
    const Point centroid = diagram_.centroid[site];
    const Point3 center = onGlobe(centroid);
    double nearest = 1;
    for (const Point vertex : cell.vertices()) nearest = std::min(nearest, dot(center, onGlobe(vertex)));
    if (cell.edges() > 2 && nearest >= std::cos(piece_degrees * degree)) {
      for (auto entry = cell.begin(); entry < cell.end(); ++entry) addCorner(vertex_of_[entry]);
      endFace(site);
      return;
    }
    const GlobeBorder border = globeBorder(sites_, diagram_, site, longest_side);
    std::vector<std::uint32_t> outer;
    std::size_t edge = 0;
    for (std::size_t k = 0; k < border.points.size(); ++k) {
      const bool is_vertex = edge < border.begins.size() && border.begins[edge] == k;
      outer.push_back(is_vertex ? vertex_of_[cell.begin() + edge] : between(border.points[k]));
      if (is_vertex) ++edge;
    }
    fill(site, center, outer);
    if (cell.edges() > 0) return;
    // A site alone has the other half as well.
    std::ranges::reverse(outer);
    fill(site, {-center.x, -center.y, -center.z}, outer);
  }

  /// Adds a cell in an outline; returns whether its pieces could be cut into triangles.
  [[nodiscard]] bool addOutlined(std::uint32_t site) {
    if (diagram_.status[site] != Status::ok) return true;
    const Cell cell = diagram_.cell(site);
    const GlobeBorder border = globeBorder(sites_, diagram_, site, longest_side);
    Piece piece;
    for (const Ring& ring : ringsOf(diagram_, site)) {
      const auto beginOf = [&](std::uint64_t entry) {
        return entry < cell.end() ? border.begins[entry - cell.begin()] : border.points.size();
      };
      Piece one;
      auto entry = ring.begin;
      for (auto k = beginOf(ring.begin); k < beginOf(ring.end); ++k) {
        const bool is_vertex = entry < ring.end && beginOf(entry) == k;
        one.numbers.push_back(is_vertex ? vertex_of_[entry++] : between(border.points[k]));
        one.points.push_back(border.points[k]);
      }
      one.ring_starts.push_back(0);
      if (isHole(one.points)) {
        piece.append(one);
        continue;
      }
      if (!addPiece(site, piece)) return false;
      piece = std::move(one);
    }
    return addPiece(site, piece);
  }

 private:
  static constexpr double degree = 3.14159265358979323846 / 180;

  /// A polygon with holes: the rings' points, and their numbers in the mesh.
  struct Piece {
    std::vector<Point3> points;
    std::vector<std::uint32_t> numbers;
    std::vector<std::uint64_t> ring_starts;

    void append(const Piece& hole) {
      ring_starts.push_back(points.size());
      points.insert(points.end(), hole.points.begin(), hole.points.end());
      numbers.insert(numbers.end(), hole.numbers.begin(), hole.numbers.end());
    }
  };

  static bool isHole(std::span<const Point3> ring) {
    const TouchingPlane plane(ring);
    double sum = 0;
    const Point first = plane.at(ring[0]);
    for (std::size_t k = 1; k + 1 < ring.size(); ++k) {
      const Point a = plane.at(ring[k]), b = plane.at(ring[k + 1]);
      sum += (a.x - first.x) * (b.y - first.y) - (b.x - first.x) * (a.y - first.y);
    }
    return sum < 0;
  }

  [[nodiscard]] bool addPiece(std::uint32_t site, const Piece& piece) {
    if (piece.points.empty()) return true;
    const TouchingPlane plane(piece.points);
    if (piece.ring_starts.size() == 1 && plane.reach(piece.points) >= std::cos(piece_degrees * degree)) {
      for (const auto number : piece.numbers) addCorner(number);
      endFace(site);
      return true;
    }
    Diagram flat;
    for (const Point3& point : piece.points) flat.vertices.push_back(plane.at(point));
    flat.status = {Status::ok};
    flat.cell_offsets = {0, piece.points.size()};
    flat.neighbors.assign(piece.points.size(), static_cast<std::int64_t>(Wall::outline));
    flat.ring_starts = piece.ring_starts;
    const auto cut = cellTriangles(flat);
    if (!cut) return false;
    std::map<Side, std::uint32_t> middles;
    for (const auto& [a, b, c] : cut->triangles)
      addTriangle(site, {piece.numbers[a], piece.numbers[b], piece.numbers[c]}, middles);
    return true;
  }

  using Side = std::pair<std::uint32_t, std::uint32_t>;

  /// Adds a triangle, or those that the middles of its long sides make of it; its neighbors have them as
  /// well.
  void addTriangle(std::uint32_t site, std::array<std::uint32_t, 3> corners,
                   std::map<Side, std::uint32_t>& middles) {
    const auto isLong = [&](std::size_t k) {
      return dot(mesh_.inSpace(corners[k]), mesh_.inSpace(corners[(k + 1) % 3])) <
             std::cos(1.01 * longest_side * degree);
    };
    const int count = isLong(0) + isLong(1) + isLong(2);
    if (count == 0) {
      for (const auto corner : corners) addCorner(corner);
      return endFace(site);
    }
    // The last side is short, or all are long; the first is long.
    while (count < 3 && (isLong(2) || !isLong(0)))
      std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    const auto [a, b, c] = corners;
    const auto first = middleOf(a, b, middles);
    const auto add = [&](std::uint32_t p, std::uint32_t q, std::uint32_t r) {
      addTriangle(site, {p, q, r}, middles);
    };
    if (count == 1) {
      add(a, first, c);
      return add(first, b, c);
    }
    const auto second = middleOf(b, c, middles);
    add(first, b, second);
    if (count == 2) {
      add(a, first, second);
      return add(a, second, c);
    }
    const auto third = middleOf(c, a, middles);
    add(a, first, third);
    add(third, second, c);
    add(first, second, third);
  }

  std::uint32_t middleOf(std::uint32_t a, std::uint32_t b, std::map<Side, std::uint32_t>& middles) {
    const auto [known, is_new] = middles.try_emplace(std::minmax(a, b), 0);
    if (is_new) {
      const Point3 p = mesh_.inSpace(a), q = mesh_.inSpace(b);
      known->second = addPoint(normalized({p.x + q.x, p.y + q.y, p.z + q.z}));
    }
    return known->second;
  }

  std::uint32_t addPoint(const Point3& at) {
    mesh_.points.push_back({at.x, at.y});
    mesh_.heights.push_back(at.z);
    return static_cast<std::uint32_t>(mesh_.points.size() - 1);
  }
  /// A point of an edge, which two cells have.
  std::uint32_t between(const Point3& at) {
    const auto [known, is_new] = between_.try_emplace(at, 0);
    if (is_new) known->second = addPoint(at);
    return known->second;
  }
  void addCorner(std::uint32_t point) { mesh_.corners.push_back(static_cast<std::int32_t>(point)); }
  void endFace(std::uint32_t site) {
    mesh_.offsets.push_back(mesh_.corners.size());
    mesh_.sites.push_back(site);
  }

  /// Fills a border, counter-clockwise around a center, by rings of points between both.
  void fill(std::uint32_t site, const Point3& center, const std::vector<std::uint32_t>& border) {
    std::vector<Point3> ends;
    double farthest = 0;
    for (const auto point : border) {
      ends.push_back(mesh_.inSpace(point));
      farthest = std::max(farthest, std::acos(std::clamp(dot(center, ends.back()), -1.0, 1.0)));
    }
    const int rings = std::max(1, static_cast<int>(std::ceil(farthest / (piece_degrees * degree))));
    const auto count = border.size();
    std::vector<std::uint32_t> inner(count, addPoint(center));
    for (int ring = 1; ring <= rings; ++ring) {
      std::vector<std::uint32_t> outer;
      for (std::size_t k = 0; k < count; ++k) {
        outer.push_back(ring == rings ? border[k]
                                      : addPoint(along(center, ends[k], static_cast<double>(ring) / rings)));
      }
      for (std::size_t k = 0; k < count; ++k) {
        const std::size_t next = k + 1 < count ? k + 1 : 0;
        addCorner(inner[k]);
        addCorner(outer[k]);
        addCorner(outer[next]);
        if (ring > 1) addCorner(inner[next]);
        endFace(site);
      }
      inner = std::move(outer);
    }
  }

  /// The place at a part of the way from one to another.
  static Point3 along(const Point3& from, const Point3& to, double part) {
    const double angle = std::acos(std::clamp(dot(from, to), -1.0, 1.0)), sine = std::sin(angle);
    const double of_from = std::sin((1 - part) * angle) / sine, of_to = std::sin(part * angle) / sine;
    return {of_from * from.x + of_to * to.x, of_from * from.y + of_to * to.y,
            of_from * from.z + of_to * to.z};
  }

  const Sites& sites_;
  const Diagram& diagram_;
  std::vector<std::uint32_t> vertex_of_;  ///< by position in Diagram::vertices
  std::unordered_map<Point3, std::uint32_t, PlaceHash> between_;
  CellsMesh& mesh_;
};

}  // namespace

Result<CellsMesh> globeMesh(const ByteSink& sink, const Sites& sites, const Diagram& diagram) {
  constexpr std::uint64_t largest = std::numeric_limits<std::int32_t>::max();
  // .vtk stores one count of all faces plus their corners.
  if (diagram.vertices.size() + diagram.size() > largest) {
    return inputError(fmt::format("{}: cells with {} vertices are too many for this kind of file; write .npz",
                                  sink.name(), diagram.vertices.size()));
  }
  VORPIPE_VAR(vertices, distinctPoints(diagram.vertices));
  CellsMesh mesh;
  GlobeFaces faces(sites, diagram, std::move(vertices), mesh);
  const bool is_outlined = !diagram.ring_starts.empty();
  for (std::uint32_t site = 0; site < diagram.size(); ++site) {
    if (!is_outlined) {
      faces.add(site);
    } else if (!faces.addOutlined(site)) {
      return deviceError(
          fmt::format("{}: the cell of site {} could not be cut into triangles", sink.name(), site));
    }
  }
  return mesh;
}

}  // namespace vorpipe

// Cells on the globe as faces in space.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

#include "base/try.h"
#include "io/base/error.h"
#include "io/cells/cells_mesh.h"

namespace vorpipe {
namespace {

constexpr double piece_degrees = 5;
/// Of edges: those of a cell that is one face are no longer, so that its neighbors have them whole.
constexpr double longest_side = 2.01 * piece_degrees;

double dot(const SpacePoint& a, const SpacePoint& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

struct PlaceHash {
  std::size_t operator()(const SpacePoint& p) const {
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
    const SpacePoint center = onGlobe(centroid);
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

 private:
  static constexpr double degree = 3.14159265358979323846 / 180;

  std::uint32_t addPoint(const SpacePoint& at) {
    mesh_.points.push_back({at.x, at.y});
    mesh_.heights.push_back(at.z);
    return static_cast<std::uint32_t>(mesh_.points.size() - 1);
  }
  /// A point of an edge, which two cells have.
  std::uint32_t between(const SpacePoint& at) {
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
  void fill(std::uint32_t site, const SpacePoint& center, const std::vector<std::uint32_t>& border) {
    std::vector<SpacePoint> ends;
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
  static SpacePoint along(const SpacePoint& from, const SpacePoint& to, double part) {
    const double angle = std::acos(std::clamp(dot(from, to), -1.0, 1.0)), sine = std::sin(angle);
    const double of_from = std::sin((1 - part) * angle) / sine, of_to = std::sin(part * angle) / sine;
    return {of_from * from.x + of_to * to.x, of_from * from.y + of_to * to.y,
            of_from * from.z + of_to * to.z};
  }

  const Sites& sites_;
  const Diagram& diagram_;
  std::vector<std::uint32_t> vertex_of_;  ///< by position in Diagram::vertices
  std::unordered_map<SpacePoint, std::uint32_t, PlaceHash> between_;
  CellsMesh& mesh_;
};

}  // namespace

Result<CellsMesh> globeMesh(const ByteSink& sink, const Sites& sites, const Diagram& diagram) {
  if (!diagram.ring_starts.empty()) {
    return inputError(fmt::format(
        "{}: cells in an outline on the globe are no faces; .gpkg and .geojson have them", sink.name()));
  }
  constexpr std::uint64_t largest = std::numeric_limits<std::int32_t>::max();
  // .vtk stores one count of all faces plus their corners.
  if (diagram.vertices.size() + diagram.size() > largest) {
    return inputError(fmt::format("{}: cells with {} vertices are too many for this kind of file; write .npz",
                                  sink.name(), diagram.vertices.size()));
  }
  VORPIPE_VAR(vertices, distinctPoints(diagram.vertices));
  CellsMesh mesh;
  GlobeFaces faces(sites, diagram, std::move(vertices), mesh);
  for (std::size_t site = 0; site < diagram.size(); ++site) faces.add(static_cast<std::uint32_t>(site));
  return mesh;
}

}  // namespace vorpipe

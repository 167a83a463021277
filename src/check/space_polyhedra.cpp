#include <fmt/core.h>

#include <utility>

#include "check/space.h"

namespace vorpipe::core::checks {
namespace {

/// By what site i is moved to be nearest to vertex v: its image that meets in it, if any does.
Shift3 nearestTo(const CheckedSpace& run, std::size_t v, std::size_t i) {
  return run.period.repeats() ? run.period.toOrigin(run.site(i) - run.vertex(v)) : Shift3{};
}

/// How far ties may move a vertex, from the sites and walls that meet in it.
double slackOfVertex(const CheckedSpace& run, std::size_t v, std::span<const std::int64_t> labels) {
  double reach = 0;
  int walls = 0;
  for (const std::int64_t label : labels) {
    if (label < 0) {
      ++walls;
    } else {
      const auto i = static_cast<std::size_t>(label);
      reach = std::max(reach, length(run.image(i, nearestTo(run, v, i)) - run.vertex(v)));
    }
  }
  const double far = std::max(run.largest, reach);
  if (walls > 1) reach = std::max(reach, run.shortest_side);
  constexpr double steps = 64;
  return run.ties() * reach + steps * epsilon * far;
}

std::span<const std::int64_t> labelsOf(const Diagram3& d, std::size_t v) {
  const auto first = d.vertex_site_offsets[v];
  return std::span(d.vertex_sites).subspan(first, d.vertex_site_offsets[v + 1] - first);
}

/// What is wrong with the sites and walls that vertex v names.
std::string wrongVertex(const CheckedSpace& run, std::size_t v) {
  const auto labels = labelsOf(run.diagram, v);
  const double slack = slackOfVertex(run, v, labels);
  const Point3 p = run.vertex(v);
  std::optional<std::size_t> first;
  Shift3 by{};  // of the first
  for (const std::int64_t label : labels) {
    double off = 0;
    if (label < 0) {
      off = run.wall(label).beyond(p);
    } else if (!first) {
      first = static_cast<std::size_t>(label);
      by = nearestTo(run, v, *first);
    } else if (const auto i = static_cast<std::size_t>(label); i != *first) {
      const Shift3 to = nearestTo(run, v, i);
      off = run.beyond(*first, i, p - run.period.of(by), {to[0] - by[0], to[1] - by[1], to[2] - by[2]});
    }
    if (!(std::abs(off) <= slack))
      return fmt::format("vertex {} at {} is {} off the plane of {}", v, run.text(p), off / run.scale, label);
  }
  return labels.size() < 4 || !first ? fmt::format("vertex {} names {} sites and walls", v, labels.size())
                                     : std::string();
}

/// The polyhedron of a cell, looked at once.
class Polyhedron {
 public:
  Polyhedron(const CheckedSpace& run, std::size_t i) : run_(run), i_(i), slack_(run.slack(i)) {
    for (std::size_t face = run.begin(i); face < run.end(i); ++face) {
      const auto ring = run.ring(face);
      for (std::size_t k = 0; k < ring.size(); ++k) edges_.emplace_back(ring[k], ring[(k + 1) % ring.size()]);
    }
    for (const auto& edge : edges_) vertices_.push_back(edge.first);
    std::ranges::sort(vertices_);
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
  }

  /// What is wrong with it.
  [[nodiscard]] std::string wrong() {
    for (std::size_t face = run_.begin(i_); face < run_.end(i_); ++face) {
      std::string text = wrongRing(face);
      if (!text.empty()) return text;
    }
    if (run_.faces(i_) < 4) return {};  // flat
    if (!isClosed()) return fmt::format("the faces of site {} do not form a closed surface", i_);
    const std::size_t ends = edges_.size();
    if (2 * vertices_.size() + 2 * run_.faces(i_) != ends + 4) {
      return fmt::format("site {} has {} vertices, {} edges and {} faces: Euler's formula fails", i_,
                         vertices_.size(), ends / 2, run_.faces(i_));
    }
    std::string text = wrongShape();
    return text.empty() ? wrongMeasures() : text;
  }

 private:
  /// Whether each edge is passed as often in one direction as in the other.
  bool isClosed() {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> back;
    back.reserve(edges_.size());
    for (const auto& [from, to] : edges_) back.emplace_back(to, from);
    std::ranges::sort(edges_);
    std::ranges::sort(back);
    return edges_ == back;
  }

  [[nodiscard]] std::string wrongRing(std::size_t face) const {
    const std::int64_t neighbor = run_.diagram.neighbors[face];
    const auto ring = run_.ring(face);
    if (ring.size() < 3)
      return fmt::format("the face of sites {} and {} has {} vertices", i_, neighbor, ring.size());
    std::vector<std::uint32_t> sorted(ring.begin(), ring.end());
    std::ranges::sort(sorted);
    if (std::ranges::adjacent_find(sorted) != sorted.end())
      return fmt::format("the face of sites {} and {} visits a vertex twice", i_, neighbor);
    for (const std::uint32_t v : ring) {
      const auto labels = labelsOf(run_.diagram, v);
      const auto names = [&](std::int64_t label) { return std::ranges::find(labels, label) != labels.end(); };
      if (!names(static_cast<std::int64_t>(i_)) || !names(neighbor))
        return fmt::format("vertex {} of the face of sites {} and {} does not name both", v, i_, neighbor);
    }
    return {};
  }

  /// Whether all vertices lie on the inner side of all faces, which turn the right way.
  [[nodiscard]] std::string wrongShape() const {
    // Of cells with very many faces a part of the vertices is looked at.
    constexpr std::size_t most = std::size_t{1} << 16;
    const std::size_t step = 1 + vertices_.size() * run_.faces(i_) / most;
    for (std::size_t face = run_.begin(i_); face < run_.end(i_); ++face) {
      const std::int64_t neighbor = run_.diagram.neighbors[face];
      const Plane3 plane = run_.plane(i_, face);
      for (std::size_t k = 0; k < vertices_.size(); k += step) {
        if (plane.beyond(run_.vertex(vertices_[k])) > slack_)
          return fmt::format("vertex {} of site {} lies beyond its face to {}", vertices_[k], i_, neighbor);
      }
      double perimeter = 0;
      const auto ring = run_.ring(face);
      const Vector3 area = areaOf(ring, perimeter);
      perimeter += slack_ * static_cast<double>(ring.size());  // as it may be where rounding moved no vertex
      if (!(dot(area, plane.normal) >= -slack_ * perimeter))
        return fmt::format("the face of sites {} and {} turns the wrong way", i_, neighbor);
      if (!(std::abs(length(area) - run_.area(face)) <= slack_ * perimeter)) {
        return fmt::format("the face of sites {} and {} has the area {}, but its ring {}", i_, neighbor,
                           run_.diagram.face_areas[face], length(area) / run_.scale / run_.scale);
      }
    }
    return {};
  }

  /// The area vector of a ring, and its length around.
  [[nodiscard]] Vector3 areaOf(std::span<const std::uint32_t> ring, double& perimeter) const {
    const Point3 first = run_.vertex(ring[0]);
    Vector3 twice{0, 0, 0};
    perimeter = length(run_.vertex(ring.back()) - first);
    for (std::size_t k = 1; k < ring.size(); ++k) {
      perimeter += length(run_.vertex(ring[k]) - run_.vertex(ring[k - 1]));
      if (k > 1) twice = twice + cross(run_.vertex(ring[k - 1]) - first, run_.vertex(ring[k]) - first);
    }
    return 0.5 * twice;
  }

  /// Volume and moments of the polyhedron, about the centroid that the diagram has.
  [[nodiscard]] std::string wrongMeasures() const {
    const Point3 origin = run_.centroid(i_);
    double volume = 0, reach = 0;
    Vector3 first{0, 0, 0};
    std::array<double, 6> second{};
    for (std::size_t face = run_.begin(i_); face < run_.end(i_); ++face) {
      const auto ring = run_.ring(face);
      const Vector3 a = run_.vertex(ring[0]) - origin;
      reach = std::max(reach, length(a));
      for (std::size_t k = 2; k < ring.size(); ++k) {
        const Vector3 b = run_.vertex(ring[k - 1]) - origin, c = run_.vertex(ring[k]) - origin;
        const double det = dot(a, cross(b, c));
        const Vector3 sum = a + b + c;
        volume += det / 6;
        first = first + (det / 24) * sum;
        const auto add = [&](std::size_t at, double Vector3::*u, double Vector3::*w) {
          second[at] += det / 120 * (a.*u * a.*w + b.*u * b.*w + c.*u * c.*w + sum.*u * sum.*w);
        };
        add(0, &Vector3::x, &Vector3::x);
        add(1, &Vector3::y, &Vector3::y);
        add(2, &Vector3::z, &Vector3::z);
        add(3, &Vector3::y, &Vector3::z);
        add(4, &Vector3::x, &Vector3::z);
        add(5, &Vector3::x, &Vector3::y);
        reach = std::max({reach, length(b), length(c)});
      }
    }
    const double slack = 2 * slack_ * run_.surface(i_);
    const double unit = run_.scale * run_.scale * run_.scale;
    if (!(std::abs(volume - run_.volume(i_)) <= slack))
      return fmt::format("site {} has the volume {}, its vertices enclose {}", i_, run_.diagram.volume[i_],
                         volume / unit);
    if (!(length(first) <= slack * reach))
      return fmt::format("the centroid of site {} is {} off", i_, length(first) / volume / run_.scale);
    for (std::size_t k = 0; k < second.size(); ++k) {
      const double had = run_.diagram.second_moments[i_][k], squared = run_.scale * run_.scale;
      // In the caller's unit it may be no number that a double holds.
      const double found = second[k] / unit / squared;
      if (!std::isnormal(1 / unit / squared) || (second[k] != 0 && !std::isnormal(found)) ||
          std::abs(second[k] - had * unit * squared) <= 2 * slack * reach * reach)
        continue;
      return fmt::format("site {} has the second moment {}, number {}, its vertices {}", i_, had, k, found);
    }
    return {};
  }

  const CheckedSpace& run_;
  std::size_t i_;
  double slack_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges_;  ///< both directions of each
  std::vector<std::uint32_t> vertices_;
};

}  // namespace

void checkPolyhedra(const CheckedSpace& run, Broken& broken) {
  const Diagram3& d = run.diagram;
  broken.expect("vertices", d.vertices.size(), run.threads,
                [&](std::size_t v) { return wrongVertex(run, v); });
  broken.expect("polyhedra", run.size(), run.threads,
                [&](std::size_t i) { return run.ok(i) ? Polyhedron(run, i).wrong() : std::string(); });
  std::uint64_t flat = 0;
  for (std::size_t i = 0; i < run.size(); ++i) flat += run.ok(i) && run.faces(i) < 4 ? 1u : 0u;
  if (flat != d.flat) broken.add("polyhedra", fmt::format("{} are flat; the diagram says {}", flat, d.flat));
}

}  // namespace vorpipe::core::checks

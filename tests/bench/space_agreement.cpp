#include "bench/space_agreement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace vorpipe::test {
namespace {

constexpr double volume_slack = 1e-9;  // of the cell's
// Of the cell's surface: a face goes when its ends are not wider than 1e-6 of the distance of two sites.
constexpr double face_slack = 2e-6;

/// The faces of a cell: whose they are, and their areas.
using Faces = std::vector<std::pair<std::int64_t, double>>;

std::int64_t neighborOf(int label) {
  if (label == -5) return wall_zmin;
  if (label == -6) return wall_zmax;
  return label;
}

/// Whether faces agree where they are no slivers. Both are in ascending order.
bool agree(const Faces& a, const Faces& b, double slack) {
  auto at = a.begin(), other = b.begin();
  while (at != a.end() || other != b.end()) {
    const bool in_a = at != a.end() && (other == b.end() || at->first <= other->first);
    const bool in_b = other != b.end() && (at == a.end() || other->first <= at->first);
    const double difference = (in_a ? at->second : 0) - (in_b ? other->second : 0);
    if (!(std::abs(difference) <= slack)) return false;
    at += in_a ? 1 : 0;
    other += in_b ? 1 : 0;
  }
  return true;
}

}  // namespace

std::string disagreement(const SpaceInput& input, const MeasuredInSpace& measured,
                         const Diagram3& reference) {
  const double unit = 1 / input.side;
  std::size_t volumes = 0, faces = 0, seen = 0;
  Faces ours, theirs;
  for (const auto& cells : measured.parts) {
    std::size_t face = 0;
    for (std::size_t k = 0; k < cells.site.size(); ++k, ++seen) {
      const auto site = static_cast<std::size_t>(cells.site[k]);
      theirs.clear();
      for (; face < cells.faces_end[k]; ++face)
        theirs.emplace_back(neighborOf(cells.neighbors[face]), cells.face_areas[face] * unit * unit);
      std::ranges::sort(theirs);
      ours.clear();
      for (auto f = reference.face_offsets[site]; f < reference.face_offsets[site + 1]; ++f)
        ours.emplace_back(reference.neighbors[f], reference.face_areas[f]);
      if (!agree(ours, theirs, face_slack * reference.surface[site])) ++faces;
      const double volume = cells.volume[k] * unit * unit * unit;
      if (!(std::abs(volume - reference.volume[site]) <= volume_slack * reference.volume[site])) ++volumes;
    }
  }
  const auto cells = static_cast<std::size_t>(std::ranges::count(reference.status, Status::ok));
  if (seen == cells && volumes == 0 && faces == 0) return {};
  return fmt::format("{} cells instead of {}, of which {} have another volume, {} other faces", seen, cells,
                     volumes, faces);
}

std::string disagreement(const TriangulatedInSpace& triangulated, const Diagram3& reference) {
  std::size_t least = 0, most = 0;
  for (std::size_t v = 0; v < reference.vertices.size(); ++v) {
    const auto begin = reference.vertex_site_offsets[v], end = reference.vertex_site_offsets[v + 1];
    // Walls come first: they are negative.
    if (isWall(reference.vertex_sites[begin])) continue;
    const std::size_t sites = end - begin;
    least += sites - 3;
    most += (sites - 2) * (sites - 3) / 2;
  }
  if (triangulated.tetrahedra >= least && triangulated.tetrahedra <= most) return {};
  return fmt::format("{} tetrahedra, not {} to {}", triangulated.tetrahedra, least, most);
}

}  // namespace vorpipe::test

#include "check/space.h"

#include <fmt/core.h>

#include <numeric>

#include "base/block_sums.h"
#include "base/refusal.h"
#include "base/try.h"

namespace vorpipe::core::checks {
namespace {

/// The power of two that scales the domain's longest side into [1, 2).
double scaleOfSpace(const Box3& box) {
  int exponent = 0;
  std::frexp(std::max({box.xmax - box.xmin, box.ymax - box.ymin, box.zmax - box.zmin}), &exponent);
  return std::ldexp(1.0, 1 - exponent);
}

/// For each site, the first one at its position.
std::vector<std::uint32_t> firstAtPositions(std::span<const Point3> sites) {
  std::vector<std::uint32_t> order(sites.size()), first(sites.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, [&](std::uint32_t a, std::uint32_t b) { return sites[a] < sites[b]; });
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool same = k > 0 && sites[order[k - 1]] == sites[order[k]];
    first[order[k]] = same ? first[order[k - 1]] : order[k];
  }
  return first;
}

bool isWallOfSpace(std::int64_t neighbor) {
  return (neighbor <= wall_xmin && neighbor >= wall_ymax) || neighbor == wall_zmin || neighbor == wall_zmax;
}

void checkSpaceOutcome(const CheckedSpace& run, Broken& broken) {
  const Diagram3& d = run.diagram;
  const auto first = firstAtPositions(run.sites);
  broken.expect("owners", run.size(), run.threads, [&](std::size_t i) {
    return d.owner[i] == first[i]
               ? std::string()
               : fmt::format("site {} is owned by site {}, but site {} has its position first", i, d.owner[i],
                             first[i]);
  });
  broken.expect("statuses", run.size(), run.threads, [&](std::size_t i) -> std::string {
    const bool duplicate = d.status[i] == Status::duplicate;
    if (d.status[i] > Status::duplicate) return fmt::format("site {} has none that is known", i);
    if (duplicate != (first[i] != i)) {
      return fmt::format("site {} is {}a duplicate", i, duplicate ? "" : "not ");
    }
    if (d.status[i] != Status::empty || !run.inDomain(run.site(i))) return {};
    return fmt::format("site {} lies in the domain and cannot be empty", i);
  });
  std::array<std::uint64_t, 4> counts{};
  for (const Status each : d.status) ++counts[std::min<std::size_t>(static_cast<std::size_t>(each), 3)];
  const Report& report = d.report;
  if (counts == std::array<std::uint64_t, 4>{report.ok, report.empty, report.duplicate, 0}) return;
  broken.add("statuses", fmt::format("{} ok, {} empty, {} duplicate; the report says {}, {}, {}", counts[0],
                                     counts[1], counts[2], report.ok, report.empty, report.duplicate));
}

/// What is wrong with the record or the neighbors of site i.
std::string wrongRecord(const CheckedSpace& run, std::size_t i) {
  const Diagram3& d = run.diagram;
  if (!run.ok(i)) {
    const bool bare =
        run.faces(i) == 0 && d.volume[i] == 0 && d.surface[i] == 0 && d.centroid[i] == run.sites[i];
    return bare ? std::string() : fmt::format("site {} has no cell, but measures or faces", i);
  }
  if (!(d.volume[i] >= 0 && std::isfinite(d.volume[i]) && d.surface[i] >= 0 && std::isfinite(d.surface[i]))) {
    return fmt::format("site {} has the volume {} and the surface {}", i, d.volume[i], d.surface[i]);
  }
  for (std::size_t face = run.begin(i); face < run.end(i); ++face) {
    const std::int64_t neighbor = d.neighbors[face];
    const bool known = neighbor < 0 ? isWallOfSpace(neighbor)
                                    : static_cast<std::size_t>(neighbor) < run.size() &&
                                          static_cast<std::size_t>(neighbor) != i &&
                                          run.ok(static_cast<std::size_t>(neighbor));
    if (!known) return fmt::format("site {} has the neighbor {}, which is none", i, neighbor);
    if (face > run.begin(i) && d.neighbors[face - 1] >= neighbor)
      return fmt::format("the neighbors of site {} do not ascend at {}", i, neighbor);
    if (!(d.face_areas[face] >= 0 && std::isfinite(d.face_areas[face])))
      return fmt::format("the face of sites {} and {} has the area {}", i, neighbor, d.face_areas[face]);
  }
  return {};
}

/// What is wrong with the arrays of vertices.
std::string wrongVertexArrays(const Diagram3& d) {
  const auto ascending = [](const std::vector<std::uint64_t>& offsets, std::size_t count, std::size_t last) {
    return offsets.size() == count + 1 && offsets.front() == 0 && std::ranges::is_sorted(offsets) &&
           offsets.back() == last;
  };
  if (!ascending(d.face_vertex_offsets, d.neighbors.size(), d.face_vertices.size()))
    return "face_vertex_offsets do not fit the faces and their vertices";
  if (!ascending(d.vertex_site_offsets, d.vertices.size(), d.vertex_sites.size()))
    return "vertex_site_offsets do not fit the vertices and their sites";
  const auto is_vertex = [&](std::uint32_t v) { return v < d.vertices.size(); };
  if (!std::ranges::all_of(d.face_vertices, is_vertex)) return "face_vertices has one that does not exist";
  const auto is_label = [&](std::int64_t label) {
    return label < 0 ? isWallOfSpace(label) : static_cast<std::size_t>(label) < d.size();
  };
  if (!std::ranges::all_of(d.vertex_sites, is_label)) return "vertex_sites has one that does not exist";
  return {};
}

}  // namespace

CheckedSpace::CheckedSpace(std::span<const Point3> of, const Cells3Options& options, const Diagram3& result,
                           int thread_count)
    : sites(of),
      diagram(result),
      detail(options.detail),
      threads(threadCount(thread_count)),
      scale(scaleOfSpace(options.domain)) {
  const Box3& b = options.domain;
  box = {b.xmin * scale, b.ymin * scale, b.zmin * scale, b.xmax * scale, b.ymax * scale, b.zmax * scale};
  shortest_side = std::min({box.xmax - box.xmin, box.ymax - box.ymin, box.zmax - box.zmin});
  largest = std::max({std::abs(box.xmin), std::abs(box.xmax), std::abs(box.ymin), std::abs(box.ymax),
                      std::abs(box.zmin), std::abs(box.zmax)});
}

std::optional<std::size_t> CheckedSpace::faceTo(std::size_t i, std::int64_t neighbor) const {
  const auto first = diagram.neighbors.begin();
  const auto from = first + static_cast<std::ptrdiff_t>(begin(i)),
             to = first + static_cast<std::ptrdiff_t>(end(i));
  const auto found = std::lower_bound(from, to, neighbor);
  if (found == to || *found != neighbor) return std::nullopt;
  return static_cast<std::size_t>(found - first);
}

Plane3 CheckedSpace::plane(std::size_t i, std::int64_t neighbor) const {
  switch (neighbor) {
    case wall_xmin:
      return {{-1, 0, 0}, -box.xmin};
    case wall_xmax:
      return {{1, 0, 0}, box.xmax};
    case wall_ymin:
      return {{0, -1, 0}, -box.ymin};
    case wall_ymax:
      return {{0, 1, 0}, box.ymax};
    case wall_zmin:
      return {{0, 0, -1}, -box.zmin};
    case wall_zmax:
      return {{0, 0, 1}, box.zmax};
    default:
      break;
  }
  const Vector3 way = scale * (sites[static_cast<std::size_t>(neighbor)] - sites[i]);
  const double distance = length(way);
  const Vector3 normal = (1 / distance) * way;
  return {normal, dot(site(i), normal) + distance / 2};
}

double CheckedSpace::beyond(std::size_t i, std::size_t j, const Point3& p) const {
  const Vector3 way = scale * (sites[j] - sites[i]);
  const double distance = length(way);
  return dot(p - site(i), way) / distance - distance / 2;
}

double CheckedSpace::slack(std::size_t i) const {
  double reach = 0;
  int walls = 0;
  for (std::size_t face = begin(i); face < end(i); ++face) {
    const std::int64_t neighbor = diagram.neighbors[face];
    if (neighbor < 0) {
      ++walls;
      continue;
    }
    reach = std::max(reach, length(scale * (sites[static_cast<std::size_t>(neighbor)] - sites[i])));
    if (!polyhedra()) continue;
    for (const std::uint32_t v : ring(face)) reach = std::max(reach, length(vertex(v) - site(i)));
  }
  // Along an edge of the box, ties are measured by its shortest side.
  reach = walls > 1 ? std::max(reach, shortest_side) : std::min(reach, shortest_side);
  const Point3& p = sites[i];
  const double farthest =
      std::max({largest, std::abs(p.x * scale), std::abs(p.y * scale), std::abs(p.z * scale)});
  constexpr double steps = 64;
  return tie_slack * reach + steps * epsilon * farthest;
}

std::string CheckedSpace::text(const Point3& p) const {
  return fmt::format("({}, {}, {})", p.x / scale, p.y / scale, p.z / scale);
}

bool checkSpaceArrays(const CheckedSpace& run, Broken& broken) {
  const Diagram3& d = run.diagram;
  const auto has = [&](std::string_view name, std::size_t size, std::size_t wanted) {
    if (size != wanted) broken.add("arrays", fmt::format("{} has {} records, not {}", name, size, wanted));
    return size == wanted;
  };
  const std::size_t n = run.size();
  if (!(has("status", d.status.size(), n) && has("owner", d.owner.size(), n) &&
        has("volume", d.volume.size(), n) && has("surface", d.surface.size(), n) &&
        has("centroid", d.centroid.size(), n) && has("face_offsets", d.face_offsets.size(), n + 1) &&
        (!run.polyhedra() || has("second_moments", d.second_moments.size(), n)))) {
    return false;
  }
  if (d.face_offsets.front() != 0 || !std::ranges::is_sorted(d.face_offsets)) {
    broken.add("arrays", "face_offsets do not ascend from 0");
    return false;
  }
  const std::size_t faces = d.face_offsets.back();
  if (!(has("neighbors", d.neighbors.size(), faces) && has("face_areas", d.face_areas.size(), faces))) {
    return false;
  }
  checkSpaceOutcome(run, broken);
  if (!broken.expect("neighbors", n, run.threads, [&](std::size_t i) { return wrongRecord(run, i); })) {
    return false;
  }
  const std::string wrong = run.polyhedra() ? wrongVertexArrays(d) : std::string();
  if (!wrong.empty()) broken.add("arrays", wrong);
  return wrong.empty();
}

}  // namespace vorpipe::core::checks

namespace vorpipe {

Result<std::vector<std::string>> check(std::span<const Point3> sites, const Cells3Options& options,
                                       const Diagram3& diagram, int threads) {
  using namespace core::checks;
  try {
    const CheckedSpace run(sites, options, diagram, threads);
    Broken broken;
    if (checkSpaceArrays(run, broken)) {
      checkSpaceMeasures(run, broken);
      if (run.polyhedra()) checkPolyhedra(run, broken);
      checkNearestInSpace(run, broken);
    }
    return broken.take();
  } catch (const std::bad_alloc&) {
    return tl::unexpected(Error{ErrorCode::device, "there is not enough memory to check the cells"});
  }
}

}  // namespace vorpipe

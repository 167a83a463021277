#include "check/space.h"

#include <fmt/core.h>

#include <functional>
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

/// Around the vectors of a lattice that begin at 0.
Box3 domainOrAround(const Cells3Options& options) {
  if (!options.lattice) return options.domain;
  const auto& [a, b, c] = *options.lattice;
  const auto most = [](double x, double y, double z) { return std::abs(x) + std::abs(y) + std::abs(z); };
  const double x = most(a.x, b.x, c.x), y = most(a.y, b.y, c.y), z = most(a.z, b.z, c.z);
  return {-x, -y, -z, x, y, z};
}

/// Sites of a period that has few digits, each in it.
Sites3 withinPeriod(const CheckedSpace& run) {
  Sites3 places(run.size());
  for (std::size_t i = 0; i < run.size(); ++i)
    places[i] = run.period.less(run.site(i), run.period.stepsTo(run.site(i)));
  return places;
}

/// For each site, the heaviest at its position, and of several the first.
std::vector<std::uint32_t> firstAtPositions(const CheckedSpace& run) {
  const bool wraps = run.period.repeats() && run.period.isCoarse();
  const Sites3 within = wraps ? withinPeriod(run) : Sites3();
  const auto sites = wraps ? std::span<const Point3>(within) : run.sites;
  std::vector<std::uint32_t> order(sites.size()), first(sites.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, [&](std::uint32_t a, std::uint32_t b) {
    if (sites[a] != sites[b]) return sites[a] < sites[b];
    return run.weighted && run.weights[a] > run.weights[b];
  });
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool same = k > 0 && sites[order[k - 1]] == sites[order[k]];
    first[order[k]] = same ? first[order[k - 1]] : order[k];
  }
  return first;
}

bool isWallOfSpace(const CheckedSpace& run, std::int64_t neighbor) {
  const auto has = [&](std::int64_t low, std::int64_t high, std::size_t axis) {
    return (neighbor == low || neighbor == high) && !run.period.along(axis);
  };
  return has(wall_xmin, wall_xmax, 0) || has(wall_ymin, wall_ymax, 1) || has(wall_zmin, wall_zmax, 2);
}

/// Whether a period's rounding may have made site i one with another, which is not lighter.
bool mayBeOne(const CheckedSpace& run, std::size_t i, std::size_t owner) {
  if (!run.period.repeats() || owner >= run.size() || run.diagram.owner[owner] != owner) return false;
  const Vector3 way = run.scaled(run.sites[owner] - run.sites[i]);
  const double apart = length(way + run.period.of(run.period.toOrigin(way)));
  const double far = std::max({run.largest, length(run.site(i)), length(run.site(owner))});
  constexpr double steps = 16;
  const double heavier = run.heavier(owner, i);
  return apart <= steps * epsilon * far && (heavier > 0 || (heavier == 0 && owner < i));
}

void checkSpaceOutcome(const CheckedSpace& run, Broken& broken) {
  const Diagram3& d = run.diagram;
  const auto first = firstAtPositions(run);
  broken.expect("owners", run.size(), run.threads, [&](std::size_t i) {
    return d.owner[i] == first[i] || mayBeOne(run, i, d.owner[i])
               ? std::string()
               : fmt::format("site {} is owned by site {}, but site {} has its position first", i, d.owner[i],
                             first[i]);
  });
  broken.expect("statuses", run.size(), run.threads, [&](std::size_t i) -> std::string {
    const bool duplicate = d.status[i] == Status::duplicate;
    if (d.status[i] > Status::duplicate) return fmt::format("site {} has none that is known", i);
    if (duplicate != (d.owner[i] != i)) {
      return fmt::format("site {} is {}a duplicate", i, duplicate ? "" : "not ");
    }
    if (d.status[i] != Status::empty || run.weighted || !run.inDomain(run.site(i))) return {};
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
    const Shift3 by = run.shift(face);
    const bool is_moved = by != Shift3{};
    const bool known = neighbor < 0 ? isWallOfSpace(run, neighbor) && !is_moved
                                    : static_cast<std::size_t>(neighbor) < run.size() &&
                                          (is_moved || static_cast<std::size_t>(neighbor) != i) &&
                                          run.ok(static_cast<std::size_t>(neighbor));
    if (!known) return fmt::format("site {} has the neighbor {}, which is none", i, run.name(neighbor, by));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (by[axis] != 0 && !run.period.along(axis))
        return fmt::format("site {} has the neighbor {}, but that axis does not repeat", i,
                           run.name(neighbor, by));
    }
    if (face > run.begin(i) &&
        std::pair(d.neighbors[face - 1], run.shift(face - 1)) >= std::pair(neighbor, by))
      return fmt::format("the neighbors of site {} do not ascend at {}", i, run.name(neighbor, by));
    if (!(d.face_areas[face] >= 0 && std::isfinite(d.face_areas[face])))
      return fmt::format("the face of sites {} and {} has the area {}", i, neighbor, d.face_areas[face]);
  }
  return {};
}

/// What is wrong with the arrays of vertices.
std::string wrongVertexArrays(const CheckedSpace& run) {
  const Diagram3& d = run.diagram;
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
    return label < 0 ? isWallOfSpace(run, label) : static_cast<std::size_t>(label) < d.size();
  };
  if (!std::ranges::all_of(d.vertex_sites, is_label)) return "vertex_sites has one that does not exist";
  return {};
}

}  // namespace

CheckedSpace::CheckedSpace(std::span<const Point3> of, const Cells3Options& options, const Diagram3& result,
                           int thread_count)
    : sites(of),
      weights(options.weights),
      weighted(std::ranges::adjacent_find(weights, std::not_equal_to<>()) != weights.end()),
      diagram(result),
      detail(options.detail),
      threads(threadCount(thread_count)),
      scale(scaleOfSpace(domainOrAround(options))),
      period(options, scale) {
  const Box3 b = domainOrAround(options);
  box = {b.xmin * scale, b.ymin * scale, b.zmin * scale, b.xmax * scale, b.ymax * scale, b.zmax * scale};
  const double x = box.xmax - box.xmin, y = box.ymax - box.ymin, z = box.zmax - box.zmin;
  shortest_side = flattest = std::min({x, y, z});
  volume_of_all = x * y * z;
  if (options.lattice) {
    shortest_side = period.shortest();
    volume_of_all = period.volume();
    for (std::size_t r = 0; r < 3; ++r) flattest = std::min(flattest, 1 / period.partOfLength(r));
  }
  largest = std::max({std::abs(box.xmin), std::abs(box.xmax), std::abs(box.ymin), std::abs(box.ymax),
                      std::abs(box.zmin), std::abs(box.zmax)});
}

std::optional<std::size_t> CheckedSpace::faceTo(std::size_t i, std::int64_t neighbor,
                                                const Shift3& by) const {
  const auto first = diagram.neighbors.begin();
  const auto from = first + static_cast<std::ptrdiff_t>(begin(i)),
             to = first + static_cast<std::ptrdiff_t>(end(i));
  for (auto found = std::lower_bound(from, to, neighbor); found != to && *found == neighbor; ++found) {
    const auto face = static_cast<std::size_t>(found - first);
    if (shift(face) == by) return face;
  }
  return std::nullopt;
}

Plane3 CheckedSpace::wall(std::int64_t neighbor) const {
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
    default:
      return {{0, 0, 1}, box.zmax};
  }
}

Plane3 CheckedSpace::plane(std::size_t i, std::size_t face) const {
  const std::int64_t neighbor = diagram.neighbors[face];
  if (neighbor < 0) return wall(neighbor);
  const Vector3 to = way(i, face);
  const double distance = length(to);
  const Vector3 normal = (1 / distance) * to;
  const double foot = (distance + heavier(i, static_cast<std::size_t>(neighbor)) / distance) / 2;
  return {normal, dot(site(i), normal) + foot};
}

double CheckedSpace::beyond(std::size_t i, std::size_t j, const Point3& p, const Shift3& by) const {
  const Vector3 to = scale * (sites[j] - sites[i]) + period.of(by);
  // A site without a cell may be so near that the square of this is 0.
  const double distance = std::hypot(to.x, to.y, to.z);
  return dot(p - site(i), to) / distance - (distance + heavier(i, j) / distance) / 2;
}

std::string CheckedSpace::name(std::int64_t neighbor, const Shift3& by) const {
  if (by == Shift3{}) return fmt::format("{}", neighbor);
  return fmt::format("{} moved by ({}, {}, {})", neighbor, by[0], by[1], by[2]);
}

Point3 CheckedSpace::placeAt(const std::array<double, 3>& parts) const {
  const auto& [u, v, w] = parts;
  if (period.isLattice()) return period.placeOf(parts);
  return {box.xmin + u * (box.xmax - box.xmin), box.ymin + v * (box.ymax - box.ymin),
          box.zmin + w * (box.zmax - box.zmin)};
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
    reach = std::max(reach, length(way(i, face)));
    if (!polyhedra()) continue;
    for (const std::uint32_t v : ring(face)) reach = std::max(reach, length(vertex(v) - site(i)));
  }
  // Along an edge of the box, ties are measured by its shortest side; between sites by their distance, which
  // may be more than that in a flat box.
  if (walls > 1) reach = std::max(reach, shortest_side);
  const Point3& p = sites[i];
  const double farthest =
      std::max({largest, std::abs(p.x * scale), std::abs(p.y * scale), std::abs(p.z * scale)});
  constexpr double steps = 64;
  return ties() * reach + steps * epsilon * farthest;
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
  if (!has("neighbor_shifts", d.neighbor_shifts.size(), run.period.repeats() ? faces : 0)) return false;
  if (!(has("neighbors", d.neighbors.size(), faces) && has("face_areas", d.face_areas.size(), faces))) {
    return false;
  }
  checkSpaceOutcome(run, broken);
  if (!broken.expect("neighbors", n, run.threads, [&](std::size_t i) { return wrongRecord(run, i); })) {
    return false;
  }
  const std::string wrong = run.polyhedra() ? wrongVertexArrays(run) : std::string();
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

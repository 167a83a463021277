#include "space/tied_polyhedra.h"

#include <algorithm>
#include <atomic>
#include <bit>

#include "base/parallel.h"
#include "space/place.h"
#include "space/polyhedra.h"
#include "space/row_vertices.h"

namespace vorpipe::space {
namespace {

constexpr std::size_t tied_in_part = 512, tied_vertices_in_part = 4096;
constexpr std::uint32_t none = 0xffffffff;
constexpr std::uint8_t at_border = 0x80;

template <class T>
void atomicMin(T& value, T other) {
  std::atomic_ref<T> at(value);
  T now = at.load(std::memory_order_relaxed);
  while (other < now && !at.compare_exchange_weak(now, other, std::memory_order_relaxed)) {
  }
}

template <class T>
void atomicMax(T& value, T other) {
  std::atomic_ref<T> at(value);
  T now = at.load(std::memory_order_relaxed);
  while (now < other && !at.compare_exchange_weak(now, other, std::memory_order_relaxed)) {
  }
}

void atomicOr(std::uint8_t& value, std::uint8_t bits) {
  std::atomic_ref at(value);
  if ((at.load(std::memory_order_relaxed) & bits) != bits) at.fetch_or(bits, std::memory_order_relaxed);
}

std::uint8_t wallBit(Label wall) { return static_cast<std::uint8_t>(1U << wallOf(wall)); }

/// Of vertices that have become one, the best gives the place: one with the most walls, then the best
/// conditioned.
std::uint64_t rankOf(std::size_t on_walls, double condition, std::uint32_t vertex) {
  const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(condition));
  return std::uint64_t{on_walls} << 62 | std::uint64_t{bits >> 1} << 32 | (none - vertex);
}

}  // namespace

void writeSitesOf(const ProvedCells& cells, std::size_t site, const Row& row,
                  const std::array<std::uint32_t, 3>& faces, std::int64_t* to) {
  // Faces stand in the order of their neighbors, walls first.
  const std::uint32_t ascending[3] = {faces[0], std::min(faces[1], faces[2]), std::max(faces[1], faces[2])};
  std::size_t k = 0;
  while (k < 3 && isWallLabel(row.neighbor[ascending[k]]))
    *to++ = publicNumber(cells, row.neighbor[ascending[k++]]);
  *to++ = cells.input[site];
  while (k < 3) *to++ = publicNumber(cells, row.neighbor[ascending[k++]]);
}

/// The faces of a row towards cells that are not in the contraction.
struct TiedPolyhedra::Border {
  std::vector<std::uint8_t> outside;
  bool any = false;

  void take(const Contraction& contraction, const Row& row) {
    outside.assign(row.faces, 0);
    any = false;
    for (std::size_t f = 0; f < row.faces; ++f) {
      const Label label = row.neighbor[f];
      if (isWallLabel(label) || contraction.cellOf(label) != SharedVertices::nowhere) continue;
      outside[f] = 1;
      any = true;
    }
  }
  [[nodiscard]] bool has(const std::array<std::uint32_t, 3>& faces) const {
    return (outside[faces[0]] | outside[faces[1]] | outside[faces[2]]) != 0;
  }
};

/// Calls each()(cell, site, row).
template <class Each>
void TiedPolyhedra::forCells(const Each& each) const {
  const auto sites = contraction_.cells();
  parallelFor(sites.size(), tied_in_part, threads_, [&](std::size_t begin, std::size_t end) {
    auto of_range = each();
    for (std::size_t c = begin; c < end; ++c) {
      const auto site = static_cast<std::size_t>(sites[c]);
      of_range(c, site, cells_.rows[site]);
    }
  });
}

void TiedPolyhedra::countRings() const {
  forCells([&] {
    return [&, walk = contraction_.cellWalk()](std::size_t cell, std::size_t site, const Row& row) mutable {
      std::uint64_t size = 0;
      bool taken = false;
      for (std::size_t f = 0; f < row.faces; ++f) {
        const std::size_t of_face = contraction_.remaining(cell, f);
        if (of_face != Contraction::many_vertices) {
          size += of_face;
          continue;
        }
        if (!std::exchange(taken, true)) contraction_.take(cell, row, walk);
        size += Contraction::ring(walk, row, f, 0).size();
      }
      if (size != 0) out_.face_vertex_offsets[out_.face_offsets[cells_.input[site]]] = size;
    };
  });
}

void TiedPolyhedra::writeRings() {
  const std::size_t count = contraction_.cells().empty() ? 0 : contraction_.vertices().size();
  user_.assign(count, none);
  number_.assign(count, none);
  around_.assign(count, 0);
  forCells([&] {
    return [&, walk = contraction_.cellWalk(), border = Border()](std::size_t cell, std::size_t site,
                                                                  const Row& row) mutable {
      contraction_.take(cell, row, walk);
      border.take(contraction_, row);
      const std::uint32_t own = cells_.input[site];
      std::uint64_t at = out_.face_offsets[own], to = out_.face_vertex_offsets[at];
      for (std::uint32_t f = 0; f < row.faces; ++f) {
        if (contraction_.remaining(cell, f) == 0) continue;
        const Ring ring = row.ring(f);
        const std::size_t begin = row.ringBegin(f), n = ring.size();
        out_.face_vertex_offsets[at++] = to;
        for (const auto& [edge_end, vertex] : Contraction::ring(walk, row, f, leastIn(ring, n))) {
          out_.face_vertices[to++] = vertex;
          std::uint32_t first = own;
          if (isWallLabel(row.neighbor[f])) atomicOr(around_[vertex], wallBit(row.neighbor[f]));
          if (border.any) {
            const std::size_t k = edge_end - begin;
            const std::array<std::uint32_t, 3> faces{
                f, static_cast<std::uint32_t>(ring[k]),
                static_cast<std::uint32_t>(ring[k + 1 == n ? 0 : k + 1])};
            if (border.has(faces)) {
              atomicOr(around_[vertex], at_border);
              for (const auto face : faces) {
                if (border.outside[face] != 0)
                  first = std::min(first, cells_.input[static_cast<std::size_t>(row.neighbor[face])]);
              }
            }
          }
          atomicMin(user_[vertex], first);
        }
      }
    };
  });
}

void TiedPolyhedra::rankVertices(std::vector<std::uint32_t>& count) {
  forCells([&] {
    return [&](std::size_t, std::size_t site, const Row&) {
      const std::uint32_t own = cells_.input[site];
      const auto begin = out_.face_vertex_offsets[out_.face_offsets[own]],
                 end = out_.face_vertex_offsets[out_.face_offsets[own + 1]];
      std::uint32_t rank = 0;
      for (auto k = begin; k < end; ++k) {
        const std::uint32_t vertex = out_.face_vertices[k];
        if (user_[vertex] == own && number_[vertex] == none) number_[vertex] = rank++;
      }
      count[own + 1] = rank;
    };
  });
}

void TiedPolyhedra::addFirst(const std::vector<std::uint32_t>& first) {
  parallelEach(number_.size(), tied_vertices_in_part, threads_, [&](std::size_t v) {
    if (number_[v] != none) number_[v] += first[user_[v]];
  });
}

/// Whether a vertex is one of the diagram, and not at the border.
bool TiedPolyhedra::isInner(std::size_t vertex) const {
  return number_[vertex] != none && (around_[vertex] & at_border) == 0;
}

/// Calls each(site, vertex) for each inner vertex of each cell once.
template <class Each>
void TiedPolyhedra::forInnerVisits(const Each& each) const {
  forCells([&] {
    return [&, vertices = std::vector<std::uint32_t>()](std::size_t, std::size_t site, const Row&) mutable {
      const std::uint32_t own = cells_.input[site];
      const auto begin = out_.face_vertex_offsets[out_.face_offsets[own]],
                 end = out_.face_vertex_offsets[out_.face_offsets[own + 1]];
      vertices.assign(out_.face_vertices.begin() + static_cast<std::ptrdiff_t>(begin),
                      out_.face_vertices.begin() + static_cast<std::ptrdiff_t>(end));
      std::ranges::sort(vertices);
      vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
      for (const std::uint32_t vertex : vertices) {
        if (isInner(vertex)) each(own, vertex);
      }
    };
  });
}

void TiedPolyhedra::countSites() {
  if (user_.empty()) return;
  auto& offsets = out_.vertex_site_offsets;
  for (std::size_t v = offsets.size(); --v > 0;) offsets[v] = 4;
  std::ranges::fill(user_, 0U);
  forInnerVisits([&](std::uint32_t, std::uint32_t vertex) {
    std::atomic_ref(user_[vertex]).fetch_add(1, std::memory_order_relaxed);
  });
  parallelEach(user_.size(), tied_vertices_in_part, threads_, [&](std::size_t v) {
    if (!isInner(v)) return;
    offsets[number_[v] + 1] = user_[v] + static_cast<std::uint64_t>(std::popcount(around_[v]));
  });
  for (std::size_t v = 1; v < offsets.size(); ++v) offsets[v] += offsets[v - 1];
}

void TiedPolyhedra::writeSites() {
  writeBorderSites();
  auto& offsets = out_.vertex_site_offsets;
  // While a vertex is filled, its offset runs on.
  forInnerVisits([&](std::uint32_t site, std::uint32_t vertex) {
    const auto at = std::atomic_ref(offsets[number_[vertex]]).fetch_add(1, std::memory_order_relaxed);
    out_.vertex_sites[at] = site;
  });
  parallelEach(user_.size(), tied_vertices_in_part, threads_, [&](std::size_t v) {
    if (!isInner(v)) return;
    auto& offset = offsets[number_[v]];
    const auto begin = out_.vertex_sites.begin() + static_cast<std::ptrdiff_t>(offset - user_[v]);
    auto end = out_.vertex_sites.begin() + static_cast<std::ptrdiff_t>(offset);
    for (int wall = 0; wall < walls; ++wall) {
      if ((around_[v] & wallBit(labelOfWall(wall))) != 0) *end++ = publicNumber(cells_, labelOfWall(wall));
    }
    std::sort(begin, end);
    offset -= user_[v];
  });
}

/// Those of vertices at the border that these cells have numbered.
void TiedPolyhedra::writeBorderSites() {
  forCells([&] {
    return [&, border = Border(), vertices = RowVertices()](std::size_t cell, std::size_t site,
                                                            const Row& row) mutable {
      border.take(contraction_, row);
      if (!border.any) return;
      vertices.number(row);
      const auto isLater = [&](std::uint32_t face) {
        const Label label = row.neighbor[face];
        return isWallLabel(label) || cells_.input[static_cast<std::size_t>(label)] > cells_.input[site];
      };
      for (std::size_t e = 0; e < vertices.atEnd().size(); ++e) {
        const auto& faces = vertices.faces()[vertices.atEnd()[e]];
        if (border.has(faces) && std::ranges::all_of(faces, isLater))
          writeSitesOf(cells_, site, row, faces,
                       &out_.vertex_sites[out_.vertex_site_offsets[numberAt(cell, e)]]);
      }
    };
  });
}

/// Calls each(site, row, faces, vertex) for each vertex of the contraction, in the cell that numbered it.
template <class Each>
void TiedPolyhedra::forOwnVertices(const Each& each) const {
  const auto& shared = contraction_.vertices();
  forCells([&] {
    return [&, vertices = RowVertices()](std::size_t cell, std::size_t site, const Row& row) mutable {
      vertices.number(row);
      std::uint32_t vertex = shared.ownBegin(cell);
      for (const auto& faces : vertices.faces()) {
        if (shared.isOwn(static_cast<Label>(site), row, faces))
          each(cell, static_cast<Label>(site), row, faces, vertex++);
      }
    };
  });
}

void TiedPolyhedra::findPlaces() {
  if (user_.empty()) return;
  BigVector<std::uint64_t> best(user_.size(), 0);
  BigVector<std::uint8_t> on_walls(user_.size(), 0);
  forOwnVertices([&](std::size_t, Label site, const Row& row, const std::array<std::uint32_t, 3>& faces,
                     std::uint32_t v) {
    const std::uint32_t became = contraction_.become(v);
    std::size_t count = 0;
    Relative way[3];
    double sizes = 1;
    for (std::size_t e = 0; e < 3; ++e) {
      const Label label = row.neighbor[faces[e]];
      way[e] = relative(cells_.places, site, label);
      sizes *= way[e].size();
      if (!isWallLabel(label)) continue;
      ++count;
      atomicOr(on_walls[became], wallBit(label));
    }
    const auto& [a, b, c] = way;
    const double det =
        a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
    atomicMax(best[became], rankOf(count, std::max(det / sizes, 0.0), v));
  });
  place_.resize((contraction_.cells().size() + tied_in_part - 1) / tied_in_part);
  const Box3& box = cells_.places.box;
  forOwnVertices([&](std::size_t cell, Label site, const Row& row, const std::array<std::uint32_t, 3>& faces,
                     std::uint32_t v) {
    const std::uint32_t became = contraction_.become(v);
    if (number_[became] == none || static_cast<std::uint32_t>(best[became]) != none - v) return;
    const std::uint8_t on = on_walls[became];
    Point3 p = canonicalPlace(cells_.places,
                              {site, row.neighbor[faces[0]], row.neighbor[faces[1]], row.neighbor[faces[2]]});
    if ((on & 3) != 0) p.x = (on & 1) != 0 ? box.xmin : box.xmax;
    if ((on & 12) != 0) p.y = (on & 4) != 0 ? box.ymin : box.ymax;
    if ((on & 48) != 0) p.z = (on & 16) != 0 ? box.zmin : box.zmax;
    place_[cell / tied_in_part].emplace_back(number_[became],
                                             Point3{p.x * cells_.unit, p.y * cells_.unit, p.z * cells_.unit});
  });
}

void TiedPolyhedra::writePlaces() {
  parallelEach(place_.size(), 1, threads_, [&](std::size_t part) {
    for (const auto& [vertex, place] : place_[part]) out_.vertices[vertex] = place;
    place_[part] = {};
  });
  for (const Label label : contraction_.cells()) {
    const std::uint32_t own = cells_.input[static_cast<std::size_t>(label)];
    const auto begin = out_.face_vertex_offsets[out_.face_offsets[own]],
               end = out_.face_vertex_offsets[out_.face_offsets[own + 1]];
    for (auto k = begin; k < end; ++k) out_.face_vertices[k] = number_[out_.face_vertices[k]];
  }
}

}  // namespace vorpipe::space

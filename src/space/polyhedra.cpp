#include "space/polyhedra.h"

#include <algorithm>
#include <array>
#include <atomic>

#include "base/parallel.h"
#include "space/glue.h"
#include "space/place.h"

namespace vorpipe::space {
namespace {

constexpr std::size_t cells_in_part = 512, vertices_in_part = 4096;
constexpr std::uint32_t no_number = 0xffffffff;

/// The inverse of publicNumber() for walls.
Label labelOfPublicWall(std::int64_t number) {
  int wall = 0;
  constexpr std::int64_t of[walls] = {wall_xmin, wall_xmax, wall_ymin, wall_ymax, wall_zmin, wall_zmax};
  while (of[wall] != number) ++wall;
  return labelOfWall(wall);
}

}  // namespace

Result<void> Polyhedra::write() {
  layOutRings();
  tied_.writeRings();
  countVertices();
  tied_.addFirst(first_);
  layOutEnds();
  numberEnds();
  if (!writeRings())
    return tl::unexpected(Error{ErrorCode::device, "two cells disagree about a face: a fault of vorpipe"});
  ends_begin_ = {};
  small_ = {};
  large_ = {};
  writeSites();
  tied_.findPlaces();
  contraction_.forgetRings();
  cells_.rows.forget();
  writePlaces();
  return {};
}

/// Calls each(site, row) for cells without ties.
template <class Each>
void Polyhedra::forPlainCells(const Each& each) const {
  if (contraction_.cells().size() == cells_.rows.size()) return;
  parallelFor(cells_.rows.size(), cells_in_part, threads_, [&](std::size_t begin, std::size_t end) {
    auto of_range = each();
    for (std::size_t i = begin; i < end; ++i) {
      const Row row = cells_.rows[i];
      if (row.faces != 0 && !isTied(static_cast<Label>(i))) of_range(i, row);
    }
  });
}

Polyhedra::Earlier Polyhedra::earlierFaces(std::size_t site, const Row& row) const {
  Earlier earlier;
  while (earlier.begin < row.faces && isWallLabel(row.neighbor[earlier.begin])) ++earlier.begin;
  earlier.end = earlier.begin;
  const std::uint32_t own = cells_.input[site];
  while (earlier.end < row.faces && cells_.input[static_cast<std::size_t>(row.neighbor[earlier.end])] < own) {
    ++earlier.end;
  }
  return earlier;
}

/// Makes room for all rings, and writes where those of each cell begin.
void Polyhedra::layOutRings() {
  auto& offsets = out_.face_vertex_offsets;
  offsets.assign(out_.neighbors.size() + 1, 0);
  forPlainCells([&] {
    return
        [&](std::size_t i, const Row& row) { offsets[out_.face_offsets[cells_.input[i]]] = row.edge_ends; };
  });
  tied_.countRings();
  std::uint64_t begin = 0;
  for (std::size_t i = 0; i < out_.size(); ++i) {
    if (out_.face_offsets[i] == out_.face_offsets[i + 1]) continue;
    auto& of_cell = offsets[out_.face_offsets[i]];
    begin += std::exchange(of_cell, begin);
  }
  offsets.back() = begin;
  out_.face_vertices.resize(begin);
}

/// Counts the vertices of each cell that no cell before it has.
void Polyhedra::countVertices() {
  first_.assign(out_.size() + 1, 0);
  forPlainCells([&] {
    return [&](std::size_t i, const Row& row) {
      const Earlier earlier = earlierFaces(i, row);
      std::uint32_t ends = 0;
      for (std::size_t f = 0; f < row.faces; ++f) {
        if (earlier.has(f)) continue;
        const Ring ring = row.ring(f);
        bool before = earlier.has(ring[ring.size() - 1]);
        for (std::size_t k = 0; k < ring.size(); ++k) {
          const bool here = earlier.has(ring[k]);
          ends += before || here ? 0 : 1;
          before = here;
        }
      }
      first_[cells_.input[i] + 1] = ends / 3;
    };
  });
  tied_.rankVertices(first_);
  for (std::size_t i = 0; i + 1 < first_.size(); ++i) first_[i + 1] += first_[i];
}

void Polyhedra::layOutEnds() {
  if (contraction_.cells().size() == cells_.rows.size()) return;
  ends_begin_.resize(cells_.rows.size());
  std::uint64_t small = 0, large = 0;
  for (std::size_t i = 0; i < cells_.rows.size(); ++i) {
    const Row row = cells_.rows[i];
    const bool fits = row.edge_ends <= 3 * not_own;
    ends_begin_[i] = fits ? small : large | is_large;
    if (!isTied(static_cast<Label>(i))) (fits ? small : large) += row.edge_ends;
  }
  small_.resize(small);
  large_.resize(large);
}

/// Numbers the own vertices of each cell, in the order in which its rings name them.
void Polyhedra::numberEnds() {
  const bool are_any_tied = !contraction_.cells().empty();
  forPlainCells([&] {
    return [&, vertices = RowVertices(), own = std::vector<std::uint32_t>()](std::size_t i,
                                                                             const Row& row) mutable {
      vertices.numberFromLeast(row);
      const Earlier earlier = earlierFaces(i, row);
      own.resize(vertices.size());
      std::uint32_t count = 0;
      for (std::size_t v = 0; v < own.size(); ++v) {
        const auto& faces = vertices.faces()[v];
        own[v] = earlier.hasNone(faces) ? count++ : no_number;
        if (are_any_tied && own[v] != no_number)
          numberForTied(i, row, faces, first_[cells_.input[i]] + own[v]);
      }
      const auto& at_end = vertices.atEnd();
      const std::uint64_t begin = ends_begin_[i];
      for (std::size_t e = 0; e < at_end.size(); ++e) {
        const std::uint32_t number = own[at_end[e]];
        if ((begin & is_large) != 0) {
          large_[(begin & ~is_large) + e] = number;
        } else {
          small_[begin + e] = static_cast<std::uint8_t>(number);
        }
      }
    };
  });
}

/// Tells a vertex' number to the tied cells that have it.
void Polyhedra::numberForTied(std::size_t site, const Row& row, const std::array<std::uint32_t, 3>& faces,
                              std::uint32_t number) {
  for (std::size_t e = 0; e < 3; ++e) {
    const Label label = row.neighbor[faces[e]];
    if (isWallLabel(label) || !isTied(label)) continue;
    // (i; j, k, l) is (j; i, l, k).
    const Row other = cells_.rows[static_cast<std::size_t>(label)];
    const std::size_t face = other.faceOf(static_cast<Label>(site)),
                      third = other.faceOf(row.neighbor[faces[(e + 2) % 3]]);
    tied_.setNumber(contraction_.cellOf(label), other.ringBegin(face) + placeIn(other.ring(face), third),
                    number);
    return;
  }
}

std::uint32_t Polyhedra::numberAt(std::size_t site, std::size_t edge_end) const {
  const auto label = static_cast<Label>(site);
  if (isTied(label)) return tied_.numberAt(contraction_.cellOf(label), edge_end);
  const std::uint64_t begin = ends_begin_[site];
  const std::uint32_t own =
      (begin & is_large) != 0 ? large_[(begin & ~is_large) + edge_end] : small_[begin + edge_end];
  return first_[cells_.input[site]] + own;
}

bool Polyhedra::writeRings() {
  std::atomic<bool> glued = true;
  forPlainCells([&] {
    return [&, vertices = RowVertices(), number = std::vector<std::uint32_t>()](std::size_t i,
                                                                                const Row& row) mutable {
      vertices.numberFromLeast(row);
      const Earlier earlier = earlierFaces(i, row);
      const std::uint32_t site = cells_.input[i];
      number.resize(vertices.size());
      std::uint32_t next = first_[site];
      for (std::size_t v = 0; v < number.size(); ++v)
        number[v] = earlier.hasNone(vertices.faces()[v]) ? next++ : no_number;
      if (!takeOthers(i, row, earlier, vertices, number)) {
        glued = false;
        return;
      }
      const auto& at_end = vertices.atEnd();
      std::uint64_t at = out_.face_offsets[site], to = out_.face_vertex_offsets[at];
      for (std::size_t f = 0; f < row.faces; ++f) {
        out_.face_vertex_offsets[at++] = to;
        const std::size_t begin = row.ringBegin(f), n = row.ringBegin(f + 1) - begin;
        for (std::size_t k = leastIn(row.ring(f), n), count = 0; count < n; ++count) {
          out_.face_vertices[to++] = number[at_end[begin + k]];
          k = k + 1 == n ? 0 : k + 1;
        }
      }
    };
  });
  return glued;
}

/// Takes the numbers of vertices from the first of their cells; false if one is not to be found.
bool Polyhedra::takeOthers(std::size_t site, const Row& row, const Earlier& earlier,
                           const RowVertices& vertices, std::vector<std::uint32_t>& number) const {
  const auto& at_end = vertices.atEnd();
  for (std::size_t f = earlier.begin; f < earlier.end; ++f) {
    const auto giver = static_cast<std::size_t>(row.neighbor[f]);
    const Row other = cells_.rows[giver];
    const Earlier before{earlier.begin, f};
    const std::size_t begin = row.ringBegin(f), face = cells_.rows.faceOf(other, static_cast<Label>(site));
    if (face == other.faces) return false;
    const std::size_t other_begin = other.ringBegin(face);
    const bool fit =
        layOn(row, f, other, face, [&](std::size_t a, std::size_t b, std::size_t k, std::size_t at) {
          if (before.has(a) || before.has(b)) return;
          number[at_end[begin + k]] = numberAt(giver, other_begin + at);
        });
    if (!fit) return false;
  }
  return std::ranges::find(number, no_number) == number.end();
}

/// Writes the cells and walls that have faces at each vertex.
void Polyhedra::writeSites() {
  auto& offsets = out_.vertex_site_offsets;
  offsets.resize(std::size_t{first_.back()} + 1);
  parallelEach(offsets.size(), vertices_in_part, threads_, [&](std::size_t v) { offsets[v] = 4 * v; });
  tied_.countSites();
  out_.vertex_sites.resize(offsets.back());
  forPlainCells([&] {
    return [&, vertices = RowVertices()](std::size_t i, const Row& row) mutable {
      vertices.numberFromLeast(row);
      const Earlier earlier = earlierFaces(i, row);
      std::uint32_t next = first_[cells_.input[i]];
      for (const auto& faces : vertices.faces()) {
        if (earlier.hasNone(faces)) writeSitesOf(cells_, i, row, faces, &out_.vertex_sites[offsets[next++]]);
      }
    };
  });
  tied_.writeSites();
}

/// Writes the places of vertices of plain cells, from their sites: so that rows need not stay.
void Polyhedra::writePlaces() {
  BigVector<Label> run(out_.size());
  parallelEach(cells_.input.size(), vertices_in_part, threads_,
               [&](std::size_t i) { run[cells_.input[i]] = static_cast<Label>(i); });
  out_.vertices.resize(first_.back());
  parallelEach(cells_.input.size(), cells_in_part, threads_, [&](std::size_t i) {
    if (isTied(static_cast<Label>(i))) return;
    const std::uint32_t site = cells_.input[i];
    for (std::uint32_t v = first_[site]; v < first_[site + 1]; ++v) {
      std::array<Label, 4> labels{};
      for (std::size_t k = 0; k < 4; ++k) {
        const std::int64_t number = out_.vertex_sites[out_.vertex_site_offsets[v] + k];
        labels[k] = isWall(number) ? labelOfPublicWall(number) : run[static_cast<std::size_t>(number)];
      }
      const Point3 p = canonicalPlace(cells_.places, labels);
      out_.vertices[v] = {p.x * cells_.unit, p.y * cells_.unit, p.z * cells_.unit};
    }
  });
  tied_.writePlaces();
}

}  // namespace vorpipe::space

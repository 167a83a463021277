#include "space/shared_vertices.h"

#include <algorithm>
#include <atomic>

#include "base/parallel.h"

namespace vorpipe::space {
namespace {

constexpr std::size_t cells_at_once = 512;
constexpr std::uint32_t most_faces_to_look_through = 128;
constexpr std::size_t most_vertices_in_bytes = 256;
constexpr std::uint32_t not_yet = 0xffffffff;

Row rowAt(const Rows& rows, Label site) { return rows[static_cast<std::size_t>(site)]; }

}  // namespace

FaceFinder::FaceFinder(const Rows& rows, std::span<const Label> cells) {
  for (const Label site : cells) {
    const Row row = rowAt(rows, site);
    if (row.faces <= most_faces_to_look_through) continue;
    auto& index = large_[site];
    for (std::uint32_t f = 0; f < row.faces; ++f) index.emplace_back(row.neighbor[f], f);
    std::ranges::sort(index);
  }
}

std::size_t FaceFinder::faceOf(Label site, const Row& row, Label neighbor) const {
  if (row.faces <= most_faces_to_look_through) return row.faceOf(neighbor);
  const auto& index = large_.at(site);
  const auto at = std::ranges::lower_bound(index, std::pair(neighbor, std::uint32_t{0}));
  return at == index.end() || at->first != neighbor ? row.faces : at->second;
}

Result<SharedVertices> SharedVertices::of(const Rows& rows, std::vector<Label> cells, int threads) {
  SharedVertices shared;
  shared.cells_ = std::move(cells);
  shared.layOut(rows);
  shared.numberOwn(rows, threads);
  if (!shared.takeOthers(rows, threads))
    return tl::unexpected(Error{ErrorCode::device, "two cells disagree about a face: a fault of vorpipe"});
  return shared;
}

void SharedVertices::layOut(const Rows& rows) {
  if (cells_.size() != rows.size()) {
    place_.assign(rows.size(), nowhere);
    for (std::uint32_t c = 0; c < cells_.size(); ++c) place_[static_cast<std::size_t>(cells_[c])] = c;
  }
  vertex_begin_.reserve(cells_.size() + 1);
  end_begin_.reserve(cells_.size());
  std::uint64_t vertices = 0, small = 0, large = 0;
  for (const Label site : cells_) {
    const Row row = rowAt(rows, site);
    const bool fits = row.edge_ends <= 3 * most_vertices_in_bytes;
    end_begin_.push_back(fits ? small : large | is_large);
    (fits ? small : large) += row.edge_ends;
    vertex_begin_.push_back(vertices);
    vertices += row.edge_ends / 3;
  }
  vertex_begin_.push_back(vertices);
  vertex_.resize(vertices);
  small_.resize(small);
  large_.resize(large);
}

void SharedVertices::numberOwn(const Rows& rows, int threads) {
  own_begin_.assign(cells_.size() + 1, 0);
  parallelFor(cells_.size(), cells_at_once, threads, [&](std::size_t begin, std::size_t end) {
    RowVertices vertices;
    for (std::size_t c = begin; c < end; ++c) {
      const Row row = rowAt(rows, cells_[c]);
      vertices.number(row);
      const auto& at_end = vertices.atEnd();
      const std::uint64_t ends = end_begin_[c];
      if ((ends & is_large) != 0) {
        std::ranges::copy(at_end, large_.begin() + static_cast<std::ptrdiff_t>(ends & ~is_large));
      } else {
        for (std::size_t e = 0; e < at_end.size(); ++e)
          small_[ends + e] = static_cast<std::uint8_t>(at_end[e]);
      }
      std::uint32_t own = 0;
      for (std::size_t v = 0; v < vertices.size(); ++v) {
        vertex_[vertex_begin_[c] + v] = isOwn(cells_[c], row, vertices.faces()[v]) ? own++ : not_yet;
      }
      own_begin_[c + 1] = own;
    }
  });
  for (std::size_t c = 0; c < cells_.size(); ++c) own_begin_[c + 1] += own_begin_[c];
  parallelFor(cells_.size(), cells_at_once, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      for (auto v = vertex_begin_[c]; v < vertex_begin_[c + 1]; ++v) {
        if (vertex_[v] != not_yet) vertex_[v] += own_begin_[c];
      }
    }
  });
}

bool SharedVertices::takeOthers(const Rows& rows, int threads) {
  const FaceFinder finder(rows, cells_);
  std::atomic<bool> glued = true;
  parallelFor(cells_.size(), cells_at_once, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      const Label site = cells_[c];
      const Row row = rowAt(rows, site);
      for (std::size_t f = 0; f < row.faces; ++f) {
        const Label label = row.neighbor[f];
        if (isWallLabel(label) || label > site) continue;
        const std::uint32_t other_cell = cellOf(label);
        if (other_cell == nowhere) continue;
        const Row other = rowAt(rows, label);
        if (!takeFrom(c, f, row, other_cell, finder.faceOf(label, other, site), other)) glued = false;
      }
    }
  });
  return glued && std::ranges::find(vertex_, not_yet) == vertex_.end();
}

/// Takes the numbers of those vertices of a face that the other cell has numbered itself.
bool SharedVertices::takeFrom(std::size_t cell, std::size_t face, const Row& row, std::size_t other_cell,
                              std::size_t other_face, const Row& other) {
  if (other_face == other.faces) return false;
  const Ring ring = row.ring(face), reverse = other.ring(other_face);
  const std::size_t n = ring.size();
  if (reverse.size() != n) return false;
  // The vertex between ring[k] and ring[k + 1] is that between ring[k + 1] and ring[k] of the other.
  std::size_t at = 0;
  while (at < n && other.neighbor[reverse[at]] != row.neighbor[ring[1]]) ++at;
  if (at == n) return false;
  const std::size_t begin = row.ringBegin(face), other_begin = other.ringBegin(other_face);
  const Label giver = row.neighbor[face];
  const auto precedes = [&](std::size_t f) {
    const Label label = row.neighbor[f];
    return !isWallLabel(label) && label < giver && cellOf(label) != nowhere;
  };
  bool before = precedes(ring[0]);
  for (std::size_t k = 0; k < n; ++k) {
    const bool after = precedes(ring[k + 1 == n ? 0 : k + 1]);
    if (!before && !after) {
      const std::uint32_t vertex = this->at(other_cell, other_begin + at);
      vertex_[vertex_begin_[cell] + vertexInCell(cell, begin + k)] = vertex;
    }
    before = after;
    at = at == 0 ? n - 1 : at - 1;
  }
  return true;
}

void SharedVertices::forgetEnds() {
  vertex_ = {};
  small_ = {};
  large_ = {};
  vertex_begin_ = {};
  end_begin_ = {};
}

}  // namespace vorpipe::space

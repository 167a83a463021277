#include "space/shared_vertices.h"

#include <algorithm>
#include <atomic>
#include <limits>

#include "base/parallel.h"
#include "space/glue.h"

namespace vorpipe::space {
namespace {

constexpr std::size_t cells_at_once = 512;
constexpr std::size_t most_vertices_in_bytes = 256;
constexpr std::uint32_t not_yet = 0xffffffff;
constexpr Label later = std::numeric_limits<Label>::max();

Row rowAt(const Rows& rows, Label site) { return rows[static_cast<std::size_t>(site)]; }

}  // namespace

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
  if (!cells_.empty() && cells_.size() != rows.size()) {
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

/// By face: the neighbor if its cell comes before, and numbers the vertices that both have; else `later`.
void SharedVertices::findEarlier(Label site, const Row& row, std::vector<Label>& earlier) const {
  earlier.resize(row.faces);
  for (std::size_t f = 0; f < row.faces; ++f) {
    const Label label = row.neighbor[f];
    earlier[f] = !isWallLabel(label) && label < site && cellOf(label) != nowhere ? label : later;
  }
}

void SharedVertices::numberOwn(const Rows& rows, int threads) {
  own_begin_.assign(cells_.size() + 1, 0);
  parallelFor(cells_.size(), cells_at_once, threads, [&](std::size_t begin, std::size_t end) {
    RowVertices vertices;
    std::vector<Label> earlier;
    for (std::size_t c = begin; c < end; ++c) {
      const Row row = rowAt(rows, cells_[c]);
      vertices.number(row);
      findEarlier(cells_[c], row, earlier);
      const auto* const at_end = vertices.atEnd().data();
      const std::uint64_t ends = end_begin_[c];
      if ((ends & is_large) != 0) {
        std::copy_n(at_end, row.edge_ends, large_.data() + (ends & ~is_large));
      } else {
        auto* const small = small_.data() + ends;
        for (std::size_t e = 0; e < row.edge_ends; ++e) small[e] = static_cast<std::uint8_t>(at_end[e]);
      }
      std::uint32_t own = 0;
      auto* const vertex = vertex_.data() + vertex_begin_[c];
      for (std::size_t v = 0; v < vertices.size(); ++v) {
        const auto& [f, a, b] = vertices.faces()[v];
        const bool is_own = std::min({earlier[f], earlier[a], earlier[b]}) == later;
        vertex[v] = is_own ? own : not_yet;
        own += is_own ? 1 : 0;
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
  std::atomic<bool> glued = true;
  parallelFor(cells_.size(), cells_at_once, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Label> earlier;
    for (std::size_t c = begin; c < end; ++c) {
      const Row row = rowAt(rows, cells_[c]);
      findEarlier(cells_[c], row, earlier);
      bool whole = true;
      for (std::size_t f = 0; f < row.faces && whole; ++f)
        whole = earlier[f] == later || takeFrom(c, f, row, earlier, rows);
      if (!whole || std::ranges::find(of(c), not_yet) != of(c).end()) glued = false;
    }
  });
  return glued;
}

/// Takes the numbers of those vertices of a face that the other cell has numbered itself.
bool SharedVertices::takeFrom(std::size_t cell, std::size_t face, const Row& row,
                              const std::vector<Label>& earlier, const Rows& rows) {
  const Label giver = row.neighbor[face];
  const Row other = rowAt(rows, giver);
  const std::size_t other_cell = cellOf(giver), other_face = rows.faceOf(other, cells_[cell]);
  if (other_face == other.faces) return false;
  const std::size_t begin = row.ringBegin(face), other_begin = other.ringBegin(other_face);
  auto* const vertex = vertex_.data() + vertex_begin_[cell];
  return layOn(row, face, other, other_face,
               [&](std::size_t a, std::size_t b, std::size_t k, std::size_t other_k) {
                 if (std::min(earlier[a], earlier[b]) < giver) return;
                 vertex[vertexInCell(cell, begin + k)] = at(other_cell, other_begin + other_k);
               });
}

void SharedVertices::forgetEnds() {
  vertex_ = {};
  small_ = {};
  large_ = {};
  vertex_begin_ = {};
  end_begin_ = {};
}

}  // namespace vorpipe::space

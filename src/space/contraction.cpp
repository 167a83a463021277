#include "space/contraction.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "base/parallel.h"
#include "space/short_edges.h"
#include "space/tied_edges.h"

namespace vorpipe::space {
namespace {

constexpr std::size_t cells_in_step = 256;

/// The sites of cells around the ends of short edges, ascending.
std::vector<Label> cellsAround(const Rows& rows, const std::vector<ShortEdge>& edges, int threads) {
  if (edges.empty()) return {};
  std::vector<std::uint8_t> wanted(rows.size(), 0);
  const auto want = [&](Label label) {
    if (isWallLabel(label)) return;
    std::atomic_ref(wanted[static_cast<std::size_t>(label)]).store(1, std::memory_order_relaxed);
  };
  constexpr std::size_t grain = 4096;
  parallelEach(edges.size(), grain, threads, [&](std::size_t e) {
    const Row row = rows[static_cast<std::size_t>(edges[e].site)];
    const EdgeAround around = edgeAround(row, edges[e].edge_end);
    want(edges[e].site);
    for (const auto face : {around.face, around.other, around.before, around.after}) want(row.neighbor[face]);
  });
  std::vector<Label> cells;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (wanted[i] != 0) cells.push_back(static_cast<Label>(i));
  }
  return cells;
}

// Marks of vertices. A suspect lies in just two faces of some cell; one that others need lies in more of
// another.
constexpr std::uint8_t suspect = 1, needed = 2;

void mark(std::uint8_t& marks, std::uint8_t with) {
  std::atomic_ref at(marks);
  if ((at.load(std::memory_order_relaxed) & with) == 0) at.fetch_or(with, std::memory_order_relaxed);
}

void sortOnce(std::vector<std::uint32_t>& numbers) {
  std::ranges::sort(numbers);
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

}  // namespace

Result<Contraction> Contraction::of(const Places& places, const Rows& rows,
                                    std::span<const std::uint32_t> tied, int threads) {
  auto edges = shortEdges(places, rows, tied, threads);
  auto vertices = SharedVertices::of(rows, cellsAround(rows, edges, threads), threads);
  if (!vertices) return tl::unexpected(std::move(vertices).error());
  Contraction contraction(std::move(*vertices));
  TiedEdges ties(places, rows, contraction.vertices_, std::move(edges), threads);
  std::uint64_t finer = 0;
  for (;;) {
    const std::uint64_t count = ties.join(*contraction.sets_);
    auto too_wide = contraction.findFaces(rows, threads);
    const bool pinched = !too_wide.empty();
    const auto wide = ties.findWide(*contraction.sets_);
    too_wide.insert(too_wide.end(), wide.begin(), wide.end());
    sortOnce(too_wide);
    contraction.counts_.edges = count;
    contraction.counts_.finer = finer += too_wide.size();
    if (too_wide.empty()) break;
    if (!ties.makeFiner(*contraction.sets_, too_wide)) {
      if (!pinched) break;
      return tl::unexpected(Error{ErrorCode::device, "a face is pinched: a fault of vorpipe"});
    }
    contraction.startAgain();
  }
  return contraction;
}

void Contraction::startAgain() {
  sets_ = std::make_unique<DisjointSets>(vertices_.size());
  marks_.assign(vertices_.size(), 0);
  dropped_.clear();
  counts_ = {};
}

const std::vector<RingStep>& Contraction::ring(CellWalk& walk, const Row& row, std::size_t face,
                                               std::size_t k) {
  auto& steps = walk.walk(row, face, k);
  shorten(steps, [](const RingStep&, const RingStep&) {});
  for (auto& step : steps) step.to = walk.became(step.to);
  return steps;
}

/// What is found on a walk along all rings of cells.
struct Contraction::Walked {
  std::vector<std::uint32_t> pinched;  ///< vertices that a ring visits twice
  std::uint64_t faces = 0, spurs = 0, flat = 0, gone = 0;
  bool any_suspect = false;
  std::vector<std::uint32_t> visits;  ///< of the last cell: how many faces visit each name

  void add(const Walked& other) {
    pinched.insert(pinched.end(), other.pinched.begin(), other.pinched.end());
    faces += other.faces;
    spurs += other.spurs;
    flat += other.flat;
    gone += other.gone;
    any_suspect = any_suspect || other.any_suspect;
  }
};

/// Finds out which faces remain, and counts; returns the vertices where faces are pinched.
std::vector<std::uint32_t> Contraction::findFaces(const Rows& rows, int threads) {
  face_begin_.resize(cells().size() + 1);
  for (std::size_t c = 0; c < cells().size(); ++c)
    face_begin_[c + 1] = face_begin_[c] + rows[static_cast<std::size_t>(cells()[c])].faces;
  remaining_.resize(face_begin_.back());
  std::uint64_t straight = 0;
  for (;;) {
    Walked walked = walkFaces(rows, threads);
    const std::uint64_t more = walked.any_suspect ? dropStraight(threads) : 0;
    straight += more;
    if (more > 0) continue;
    counts_.faces = walked.faces;
    counts_.spurs = walked.spurs;
    counts_.flat = walked.flat;
    counts_.gone = walked.gone;
    counts_.straight = straight;
    sortOnce(walked.pinched);
    return std::move(walked.pinched);
  }
}

/// Counts faces, and marks vertices by how many faces of each cell have them.
Contraction::Walked Contraction::walkFaces(const Rows& rows, int threads) {
  const auto sites = cells();
  std::vector<Walked> found((sites.size() + cells_in_step - 1) / cells_in_step);
  parallelFor(sites.size(), cells_in_step, threads, [&](std::size_t begin, std::size_t end) {
    CellWalk walk = cellWalk();
    Walked& here = found[begin / cells_in_step];
    for (std::size_t c = begin; c < end; ++c)
      walkCell(c, rows[static_cast<std::size_t>(sites[c])], walk, here);
    here.visits = {};
  });
  Walked all;
  for (const auto& part : found) all.add(part);
  return all;
}

void Contraction::walkCell(std::size_t cell, const Row& row, CellWalk& walk, Walked& found) {
  take(cell, row, walk);
  found.visits.assign(walk.names(), 0);
  std::size_t remaining = 0;
  for (std::size_t f = 0; f < row.faces; ++f) {
    auto& steps = walk.walk(row, f, 0);
    const std::size_t before = steps.size();
    if (before == 2 || walk.visitsAgain()) {
      shorten(steps, [](const RingStep&, const RingStep&) {});
      walk.forEachAgain([&](std::uint32_t name) { found.pinched.push_back(walk.became(name)); });
    }
    const bool counts = isWallLabel(row.neighbor[f]) || row.neighbor[f] > cells()[cell];
    const bool remains = !steps.empty();
    remaining += remains;
    found.faces += counts && !remains;
    found.spurs += counts && remains && steps.size() < before;
    remaining_[face_begin_[cell] + f] =
        static_cast<std::uint8_t>(std::min<std::size_t>(steps.size(), many_vertices));
    for (const auto& step : steps) ++found.visits[step.to];
  }
  found.flat += remaining > 0 && remaining < 4;
  found.gone += remaining == 0;
  for (std::uint32_t name = 0; name < found.visits.size(); ++name) {
    if (found.visits[name] == 0) continue;
    const bool is_suspect = found.visits[name] < 3;
    mark(marks_[walk.became(name)], is_suspect ? suspect : needed);
    found.any_suspect = found.any_suspect || is_suspect;
  }
}

/// Drops suspects that are in more than two faces of no cell; returns how many.
std::uint64_t Contraction::dropStraight(int threads) {
  constexpr std::size_t vertices_in_step = 1 << 14;
  std::atomic<std::uint64_t> count = 0;
  dropped_.resize(marks_.size(), 0);
  parallelFor(marks_.size(), vertices_in_step, threads, [&](std::size_t begin, std::size_t end) {
    std::uint64_t here = 0;
    for (std::size_t v = begin; v < end; ++v) {
      const bool drop = marks_[v] == suspect;
      here += drop;
      if (drop) dropped_[v] = 1;
      marks_[v] = 0;
    }
    count += here;
  });
  return count;
}

}  // namespace vorpipe::space

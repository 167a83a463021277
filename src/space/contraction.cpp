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

/// The sites that have cells, or those of them around the ends of short edges; ascending.
std::vector<Label> cellsAround(const Rows& rows, const std::vector<ShortEdge>& edges, bool all) {
  std::vector<std::uint8_t> wanted(rows.size(), all ? 1 : 0);
  const auto want = [&](Label label) {
    if (!isWallLabel(label)) wanted[static_cast<std::size_t>(label)] = 1;
  };
  if (!all) {
    for (const auto& edge : edges) {
      const Row row = rows[static_cast<std::size_t>(edge.site)];
      const EdgeAround around = edgeAround(row, edge.edge_end);
      want(edge.site);
      for (const auto face : {around.face, around.other, around.before, around.after})
        want(row.neighbor[face]);
    }
  }
  std::vector<Label> cells;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (wanted[i] != 0 && rows[i].faces != 0) cells.push_back(static_cast<Label>(i));
  }
  return cells;
}

// Marks of vertices. A suspect lies in just two faces of some cell; one that others need lies in more of
// another.
constexpr std::uint8_t suspect = 1, needed = 2;

bool isMarked(std::uint8_t& marks, std::uint8_t with) {
  return (std::atomic_ref(marks).load(std::memory_order_relaxed) & with) != 0;
}

void mark(std::uint8_t& marks, std::uint8_t with) {
  if (!isMarked(marks, with)) std::atomic_ref(marks).fetch_or(with, std::memory_order_relaxed);
}

/// How many faces of a cell visit each vertex.
class VisitCounts {
 public:
  void start(std::size_t most) {
    std::size_t room = 64;
    while (room < 2 * most) room *= 2;
    if (table_.size() < room) table_.resize(room);
    mask_ = table_.size() - 1;
    for (const auto at : used_) table_[at].count = 0;
    used_.clear();
  }
  void add(std::uint32_t vertex) {
    constexpr std::uint32_t scatter = 2654435769U;
    std::size_t at = vertex * scatter >> 8 & mask_;
    while (table_[at].count != 0 && table_[at].vertex != vertex) at = (at + 1) & mask_;
    if (table_[at].count++ == 0) used_.push_back(at);
    table_[at].vertex = vertex;
  }
  template <class Each>
  void forEach(const Each& each) const {
    for (const auto at : used_) each(table_[at].vertex, table_[at].count);
  }

 private:
  struct Visited {
    std::uint32_t vertex, count = 0;
  };
  std::vector<Visited> table_;
  std::vector<std::size_t> used_;
  std::size_t mask_ = 0;
};

/// Appends the vertices that steps visit more than once.
void findPinches(const std::vector<RingStep>& steps, std::vector<std::uint32_t>& sorted,
                 std::vector<std::uint32_t>& pinched) {
  sorted.clear();
  for (const auto& step : steps) sorted.push_back(step.to);
  std::ranges::sort(sorted);
  for (std::size_t k = 1; k < sorted.size(); ++k) {
    if (sorted[k] == sorted[k - 1]) pinched.push_back(sorted[k]);
  }
}

void sortOnce(std::vector<std::uint32_t>& numbers) {
  std::ranges::sort(numbers);
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

}  // namespace

Result<Contraction> Contraction::of(const Places& places, const Rows& rows,
                                    std::span<const std::uint32_t> tied, bool all, int threads) {
  auto edges = shortEdges(places, rows, tied, threads);
  auto vertices = SharedVertices::of(rows, cellsAround(rows, edges, all), threads);
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

void Contraction::ring(std::size_t cell, const Row& row, std::size_t face, std::size_t k,
                       std::vector<RingStep>& steps) const {
  walk(cell, row, face, k, steps);
  shorten(steps, [](const RingStep&, const RingStep&) {});
}

void Contraction::walk(std::size_t cell, const Row& row, std::size_t face, std::size_t k,
                       std::vector<RingStep>& steps) const {
  const auto isNone = [&](std::uint32_t vertex) { return !dropped_.empty() && dropped_[vertex] != 0; };
  walkRing(vertices_, *sets_, isNone, cell, row, face, k, steps);
}

/// Finds out which faces remain, and counts; returns the vertices where faces are pinched.
std::vector<std::uint32_t> Contraction::findFaces(const Rows& rows, int threads) {
  face_begin_.resize(cells().size() + 1);
  for (std::size_t c = 0; c < cells().size(); ++c)
    face_begin_[c + 1] = face_begin_[c] + rows[static_cast<std::size_t>(cells()[c])].faces;
  remaining_.resize(face_begin_.back());
  std::uint64_t straight = 0;
  for (;;) {
    auto pinched = walkFaces(rows, threads);
    const std::uint64_t more = dropStraight(rows, threads);
    straight += more;
    if (more > 0) continue;
    counts_.straight = straight;
    return pinched;
  }
}

/// Counts faces, and marks the vertices in just two faces of some cell.
std::vector<std::uint32_t> Contraction::walkFaces(const Rows& rows, int threads) {
  const auto sites = cells();
  std::vector<std::vector<std::uint32_t>> pinched((sites.size() + cells_in_step - 1) / cells_in_step);
  std::atomic<std::uint64_t> faces = 0, spurs = 0, flat = 0, gone = 0;
  parallelFor(sites.size(), cells_in_step, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<RingStep> steps;
    std::vector<std::uint32_t> sorted;
    VisitCounts visits;
    for (std::size_t c = begin; c < end; ++c) {
      const Row row = rows[static_cast<std::size_t>(sites[c])];
      visits.start(row.edge_ends);
      std::size_t remaining = 0;
      for (std::size_t f = 0; f < row.faces; ++f) {
        walk(c, row, f, 0, steps);
        const std::size_t before = steps.size();
        shorten(steps, [](const RingStep&, const RingStep&) {});
        const bool remains = !steps.empty(), is_spurred = steps.size() < before;
        const bool counts = isWallLabel(row.neighbor[f]) || row.neighbor[f] > sites[c];
        remaining += remains;
        faces += counts && !remains;
        spurs += counts && remains && is_spurred;
        remaining_[face_begin_[c] + f] =
            static_cast<std::uint8_t>(std::min<std::size_t>(steps.size(), many_vertices));
        for (const auto& step : steps) visits.add(step.to);
        findPinches(steps, sorted, pinched[c / cells_in_step]);
      }
      flat += remaining > 0 && remaining < 4;
      gone += remaining == 0;
      visits.forEach([&](std::uint32_t vertex, std::uint32_t count) {
        if (count < 3) mark(marks_[vertex], suspect);
      });
    }
  });
  counts_.faces = faces;
  counts_.spurs = spurs;
  counts_.flat = flat;
  counts_.gone = gone;
  std::vector<std::uint32_t> vertices;
  for (const auto& part : pinched) vertices.insert(vertices.end(), part.begin(), part.end());
  sortOnce(vertices);
  return vertices;
}

/// Drops suspects that are in more than two faces of no cell; returns how many.
std::uint64_t Contraction::dropStraight(const Rows& rows, int threads) {
  const auto sites = cells();
  if (std::ranges::none_of(marks_, [](std::uint8_t marks) { return (marks & suspect) != 0; })) return 0;
  parallelFor(sites.size(), cells_in_step, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<RingStep> steps;
    VisitCounts visits;
    for (std::size_t c = begin; c < end; ++c) {
      const Row row = rows[static_cast<std::size_t>(sites[c])];
      visits.start(row.edge_ends);
      for (std::size_t f = 0; f < row.faces; ++f) {
        if (remaining(c, f) == 0) continue;
        ring(c, row, f, 0, steps);
        for (const auto& step : steps) {
          if (isMarked(marks_[step.to], suspect)) visits.add(step.to);
        }
      }
      visits.forEach([&](std::uint32_t vertex, std::uint32_t count) {
        if (count >= 3) mark(marks_[vertex], needed);
      });
    }
  });
  std::uint64_t count = 0;
  dropped_.resize(marks_.size(), 0);
  for (std::size_t v = 0; v < marks_.size(); ++v) {
    const bool drop = marks_[v] == suspect;
    count += drop;
    if (drop) dropped_[v] = 1;
    marks_[v] = 0;
  }
  return count;
}

}  // namespace vorpipe::space

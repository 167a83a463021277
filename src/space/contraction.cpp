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

void Contraction::ring(std::size_t cell, const Row& row, std::size_t face, std::size_t k,
                       std::vector<RingStep>& steps) const {
  walkRing(vertices_, *sets_, cell, row, face, k, steps);
  shorten(steps, [](const RingStep&, const RingStep&) {});
}

/// Finds out which faces remain, and counts; returns the vertices where faces are pinched.
std::vector<std::uint32_t> Contraction::findFaces(const Rows& rows, int threads) {
  const auto sites = cells();
  face_begin_.resize(sites.size() + 1);
  for (std::size_t c = 0; c < sites.size(); ++c)
    face_begin_[c + 1] = face_begin_[c] + rows[static_cast<std::size_t>(sites[c])].faces;
  remaining_.resize(face_begin_.back());
  std::vector<std::vector<std::uint32_t>> pinched((sites.size() + cells_in_step - 1) / cells_in_step);
  std::atomic<std::uint64_t> faces = 0, spurs = 0, flat = 0, gone = 0;
  parallelFor(sites.size(), cells_in_step, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<RingStep> steps;
    std::vector<std::uint32_t> sorted;
    for (std::size_t c = begin; c < end; ++c) {
      const Row row = rows[static_cast<std::size_t>(sites[c])];
      std::size_t remaining = 0;
      for (std::size_t f = 0; f < row.faces; ++f) {
        walkRing(vertices_, *sets_, c, row, f, 0, steps);
        const std::size_t before = steps.size();
        shorten(steps, [](const RingStep&, const RingStep&) {});
        const bool remains = !steps.empty();
        const bool counts = isWallLabel(row.neighbor[f]) || row.neighbor[f] > sites[c];
        remaining += remains;
        remaining_[face_begin_[c] + f] =
            static_cast<std::uint8_t>(std::min<std::size_t>(steps.size(), many_vertices));
        if (counts && !remains) ++faces;
        if (counts && remains && steps.size() < before) ++spurs;
        findPinches(steps, sorted, pinched[c / cells_in_step]);
      }
      flat += remaining > 0 && remaining < 4;
      gone += remaining == 0;
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

}  // namespace vorpipe::space

#include "core/judge/judge.h"

#include <cassert>
#include <numeric>

#include "base/progress_steps.h"
#include "core/delaunay/mesh_cells.h"

namespace vorpipe::core {
namespace {

/// Break-even: the mesh of n sites takes as long as the tree takes for n / sites_per_cell cells in double, or
/// for n / sites_per_exact_cell cells exactly: about 1 us a site, 20 us a cell in double, some milliseconds
/// exactly. With weights the cells that devices leave have far to search, and cost four times as much.
constexpr std::size_t sites_per_cell = 16, sites_per_weighted_cell = 64, sites_per_exact_cell = 2048;

/// Of no more sites with weights the mesh is made for a single cell: where all of them nearly meet in a
/// point, that cell may take minutes with many digits.
constexpr std::size_t few_weighted_sites = std::size_t{1} << 14;

/// Cells between two calls of progress.
constexpr std::size_t most_at_once = std::size_t{1} << 24;

using Indices = std::vector<std::uint32_t>;

bool isOpen(CellStatus status) { return !isDone(status); }

}  // namespace

Result<NeighborRows> Judge::find(std::span<const std::uint32_t> which, Precision precision, int threads,
                                 const Progress& progress, std::uint64_t& exact) {
  NeighborRows cells(which.size(), threads);
  Indices entries(which.size());
  std::iota(entries.begin(), entries.end(), 0u);
  const bool few = !sites_.weight.empty() && sites_.size() <= few_weighted_sites && mesh_.isPossible();
  const bool pays = precision == Precision::exact
                        ? few || (!mesh_.isMade() && which.size() > sites_.size() / sites_per_exact_cell)
                        : mesh_.isMade() || areMany(which.size());
  if (const auto* mesh = pays ? mesh_.get() : nullptr; mesh != nullptr) {
    cells.add(entries, meshCells(sites_, *mesh, which, threads));
    return cells;
  }
  auto found = findSome(which, entries, precision, progress, cells);
  if (found && precision == Precision::in_double && !found->empty()) {
    Indices open;
    for (const auto e : *found) open.push_back(which[e]);
    auto exactly = find(open, Precision::exact, threads, progress, exact);
    if (!exactly) return exactly;
    exact += open.size();
    cells.add(*found, std::move(*exactly));
    return cells;
  }
  if (!found) return tl::unexpected(found.error());
  assert(found->empty());
  return cells;
}

std::optional<NeighborRows> Judge::findInMesh(std::span<const std::uint32_t> which, int threads) {
  const auto* mesh = mesh_.isPossible() ? mesh_.get() : nullptr;
  if (mesh == nullptr) return {};
  NeighborRows cells(which.size(), threads);
  Indices entries(which.size());
  std::iota(entries.begin(), entries.end(), 0u);
  cells.add(entries, meshCells(sites_, *mesh, which, threads));
  return cells;
}

ExactTier& Judge::ready() {
  if (!ready_) exact_.take(sites_);
  ready_ = true;
  return exact_;
}

void Judge::nearest(const View& view, std::span<const std::uint32_t> pixels, std::span<std::uint32_t> sites) {
  ready().nearest(view, pixels, sites);
}

bool Judge::areMany(std::size_t cells) const {
  const auto sites = sites_.weight.empty() ? sites_per_cell : sites_per_weighted_cell;
  return cells > sites_.size() / sites && mesh_.isPossible();
}

Result<std::vector<std::uint32_t>> Judge::findSome(std::span<const std::uint32_t> which,
                                                   std::span<const std::uint32_t> entries,
                                                   Precision precision, const Progress& progress,
                                                   NeighborRows& cells) {
  std::vector<std::uint32_t> open;
  std::vector<std::uint32_t> some;
  const auto work = [&](std::size_t begin, std::size_t count) -> Result<void> {
    const auto part = entries.subspan(begin, count);
    some.clear();
    for (const auto e : part) some.push_back(which[e]);
    CellNeighbors found;
    ready().cells(some, precision, found);
    const auto left = withStatus(part, found.status, isOpen);
    open.insert(open.end(), left.begin(), left.end());
    cells.add(part, std::move(found));
    return {};
  };
  const auto* stage = precision == Precision::exact ? "exact cells" : "cells in double";
  if (auto done = runInSteps(progress, stage, entries.size(), most_at_once, work); !done) {
    return tl::unexpected(done.error());
  }
  return open;
}

}  // namespace vorpipe::core

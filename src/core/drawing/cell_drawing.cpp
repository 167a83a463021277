#include "core/drawing/cell_drawing.h"

#include <algorithm>

#include "base/progress_steps.h"
#include "core/search/device_eligible.h"

namespace vorpipe::core {

CellDrawing::CellDrawing(const DrawingInput& input, std::optional<NeighborRows> known)
    : input_(input),
      upload_(input.backend, input.palette_index),
      all_known_(known.has_value()),
      polygons_({input.backend, input.sites, input.palette_index, input.threads}),
      status_(input.sites.size(), CellStatus::certified),
      pixels_(input.sites, input.palette_index, input.threads) {
  if (known) take(std::move(*known));
}

/// A site without a cell may have an image at the end of the band that seems to have one.
void CellDrawing::take(NeighborRows known) {
  Indices which(known.size());
  for (std::uint32_t i = 0; i < which.size(); ++i) {
    which[i] = i;
    const bool hidden = !input_.sites.hidden.empty() && input_.sites.hidden[i] != 0;
    if (hidden) known.drop(i, CellStatus::empty);
    status_[i] = known.status(i);
  }
  known_cells_.push_back({std::move(which), std::move(known)});
}

Result<void> CellDrawing::draw(const View& view) {
  const bool first = !all_known_ && !lists_ && !grid_;
  if (first) {
    if (auto prepared = prepare(); !prepared) return prepared;
  }
  if (auto given = giveAll(); !given) return given;
  if (auto begun = input_.backend.begin(view); !begun) return begun;
  if (!all_known_) {
    auto left = grid_ ? grid_->draw(on_device_) : lists_->draw(view, on_device_);
    if (!left) return tl::unexpected(left.error());
    if (auto found = judge(std::move(*left)); !found) return found;
  }
  for (const auto& cells : known_cells_) {
    if (auto drawn = polygons_.draw(view, cells, input_.progress); !drawn) return drawn;
  }
  return giveAll();
}

Result<void> CellDrawing::read(const View& view, std::span<std::uint32_t> rgba,
                               std::span<std::uint32_t> ids) {
  if (auto read = input_.backend.read(rgba, ids); !read) return read;
  pixels_.apply(status_, view.palette, rgba, ids);
  return {};
}

/// Whatever the search, a backend may look at all sites when it begins or finishes a picture; but not for
/// triangles alone.
Result<void> CellDrawing::giveAll() {
  if (all_known_ && input_.backend.info().has_vertices) return {};
  return fits(input_.sites, input_.backend.info()) ? upload_.give({input_.sites, {}, {}}) : Result<void>{};
}

/// Sorts out the cells.
Result<void> CellDrawing::prepare() {
  const bool by_grid = input_.search.method == Search::grid;
  auto triage = sortOut(input_.sites, input_.threads);
  leaveHidden(triage.inside);
  leaveHidden(triage.outside);
  on_device_ = std::move(triage.inside);
  if (by_grid) {
    grid_ = std::make_unique<GridDrawing>(input_.backend, upload_, input_.judge, input_.sites, input_.threads,
                                          input_.progress);
  } else {
    const Stopwatch watch;
    lists_ = std::make_unique<ListDrawing>(
        Canvas{input_.backend, input_.sites, input_.palette_index, input_.threads},
        static_cast<std::size_t>(input_.search.neighbors), input_.several_views, input_.progress);
    tree_seconds_ = watch.seconds();
  }
  return judge(std::move(triage.outside));
}

/// Takes the cells that are known to be empty from some.
void CellDrawing::leaveHidden(Indices& which) {
  const auto& hidden = input_.sites.hidden;
  if (hidden.empty()) return;
  std::erase_if(which, [&](std::uint32_t site) {
    if (hidden[site] != 0) status_[site] = CellStatus::empty;
    return hidden[site] != 0;
  });
}

/// Finds cells that the device does not, and takes them from it.
Result<void> CellDrawing::judge(Indices which) {
  if (which.empty()) return {};
  std::sort(which.begin(), which.end());
  const Stopwatch watch;
  auto found = input_.judge.find(which, Precision::in_double, input_.threads, input_.progress, exact_);
  if (!found) return tl::unexpected(found.error());
  judge_seconds_ += watch.seconds();
  in_double_ += which.size();
  for (std::size_t e = 0; e < which.size(); ++e) status_[which[e]] = found->status(e);
  std::erase_if(on_device_,
                [&](std::uint32_t site) { return std::binary_search(which.begin(), which.end(), site); });
  known_cells_.push_back({std::move(which), std::move(*found)});
  return {};
}

void CellDrawing::describe(Report& report) const {
  if (grid_) report.retried += grid_->retried();
  if (lists_) report.retried += lists_->retried();
  report.in_double += in_double_;
  report.exact += exact_;
  auto& times = report.time_ms;
  const auto add = [](double seconds, double& to) { to = std::max(to, 0.0) + 1e3 * seconds; };
  add(upload_.seconds(), times.upload);
  if (lists_) add(tree_seconds_ + lists_->searchSeconds(), times.search);
  if (in_double_ > 0) add(judge_seconds_, times.cells);
  times.draw = 1e3 * polygons_.seconds();
  if (grid_) times.draw += 1e3 * grid_->seconds();
  if (lists_) times.draw += 1e3 * lists_->drawSeconds();
}

}  // namespace vorpipe::core

#include "core/drawing/cell_drawing.h"

#include <algorithm>

#include "base/stopwatch.h"
#include "core/drawing/convex_pieces.h"
#include "core/search/device_eligible.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t lines_per_batch = std::size_t{1} << 21;
/// The walls of an entry take room as its lines do.
constexpr std::size_t walls = 4;
/// By how much a cell drawn in pieces may be too large, in pixels. What else may be off about it is less by
/// so much then.
constexpr double pixels_beyond = 0.0005;

}  // namespace

CellDrawing::CellDrawing(const DrawingInput& input)
    : input_(input),
      upload_(input.backend, input.palette_index),
      batches_({input.backend, input.sites, input.palette_index, input.threads}),
      status_(input.sites.size(), CellStatus::certified),
      pixels_(input.sites, input.palette_index, input.threads) {}

Result<void> CellDrawing::draw(const View& view) {
  if (!lists_ && !grid_) {
    if (auto prepared = prepare(); !prepared) return prepared;
  }
  if (auto given = giveAll(); !given) return given;
  if (auto begun = input_.backend.begin(view); !begun) return begun;
  auto left = grid_ ? grid_->draw(on_device_) : lists_->draw(view, on_device_);
  if (!left) return tl::unexpected(left.error());
  if (auto found = judge(std::move(*left)); !found) return found;
  for (const auto& cells : judged_) {
    if (auto drawn = drawJudged(view, cells); !drawn) return drawn;
  }
  return giveAll();
}

Result<void> CellDrawing::read(const View& view, std::span<std::uint32_t> rgba,
                               std::span<std::uint32_t> ids) {
  if (auto read = input_.backend.read(rgba, ids); !read) return read;
  pixels_.apply(status_, view.palette, rgba, ids);
  return {};
}

/// Whatever the search, a backend may look at all sites when it begins or finishes a picture.
Result<void> CellDrawing::giveAll() {
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
  auto found = input_.judge.find(which, Effort::in_double, input_.threads, input_.progress, exact_);
  if (!found) return tl::unexpected(found.error());
  judge_seconds_ += watch.seconds();
  in_double_ += which.size();
  for (std::size_t e = 0; e < which.size(); ++e) status_[which[e]] = found->status(e);
  std::erase_if(on_device_,
                [&](std::uint32_t site) { return std::binary_search(which.begin(), which.end(), site); });
  judged_.push_back({std::move(which), std::move(*found)});
  return {};
}

Result<void> CellDrawing::drawJudged(const View& view, const JudgedCells& cells) {
  const auto room = static_cast<std::size_t>(input_.backend.info().most_edges);
  Indices whole;
  Indices in_pieces;
  for (std::uint32_t e = 0; e < cells.which.size(); ++e) {
    if (cells.found.status(e) != CellStatus::certified) continue;
    (cells.found.edges(e).size() + walls > room ? in_pieces : whole).push_back(e);
  }
  const auto candidates = boundaries(input_.sites, cells, whole, input_.threads);
  const auto status = batches_.draw(view, candidates, Effort::roomy);
  if (!status) return tl::unexpected(status.error());
  for (std::size_t k = 0; k < whole.size(); ++k) {
    if (!isDone((*status)[k])) in_pieces.push_back(whole[k]);
  }
  return drawPieces(view, cells, in_pieces);
}

Result<void> CellDrawing::drawPieces(const View& view, const JudgedCells& cells, const Indices& entries) {
  const auto& info = input_.backend.info();
  const auto most_lines = std::min<std::uint64_t>(info.max_lines, lines_per_batch);
  const auto edges = static_cast<std::size_t>(info.most_edges) - walls;
  const auto& box = view.box;
  const double tolerance =
      pixels_beyond * std::min((box.xmax - box.xmin) / view.width, (box.ymax - box.ymin) / view.height);
  Pieces pieces{{}, {}, tolerance};
  for (const auto e : entries) {
    const auto polygon = cellPolygon(input_.sites, cells.which[e], cells.found.edges(e));
    if (pieces.batch.lines.size() + 2 * polygon.size() > most_lines) {
      if (auto drawn = batches_.draw(view, std::move(pieces)); !drawn) return drawn;
      pieces = {{}, {}, tolerance};
    }
    const auto added = appendPieces(polygon, edges, tolerance, pieces.batch);
    pieces.site.insert(pieces.site.end(), added, cells.which[e]);
  }
  return pieces.site.empty() ? Result<void>{} : batches_.draw(view, std::move(pieces));
}

void CellDrawing::describe(Report& report) const {
  report.retried += grid_ ? grid_->retried() : lists_->retried();
  report.in_double += in_double_;
  report.exact += exact_;
  auto& times = report.time_ms;
  const auto add = [](double seconds, double& to) { to = std::max(to, 0.0) + 1e3 * seconds; };
  add(upload_.seconds(), times.upload);
  if (lists_) add(tree_seconds_ + lists_->searchSeconds(), times.search);
  if (in_double_ > 0) add(judge_seconds_, times.cells);
  times.draw = 1e3 * (batches_.seconds() + (grid_ ? grid_->seconds() : lists_->drawSeconds()));
}

}  // namespace vorpipe::core

#include "core/drawing/cell_drawing.h"

#include <algorithm>
#include <utility>

#include "base/stopwatch.h"

namespace vorpipe::core {
namespace {

/// Fewer cells than this are clipped with room from the start: that costs less than a second pipeline.
constexpr std::size_t worth_fast_pipeline = std::size_t{1} << 15;

/// What a fast pipeline does not draw, a roomy one may; what has no shape is for the judge to say.
void askForRoom(Effort effort, std::span<CellStatus> status) {
  for (auto& each : status) {
    if (each == CellStatus::certified) continue;
    each = effort == Effort::fast ? CellStatus::overflow : CellStatus::open;
  }
}

/// The same, but that more candidates may help.
void askForCandidates(Effort effort, std::span<CellStatus> status) {
  for (auto& each : status) {
    if (each == CellStatus::certified || each == CellStatus::unsecured) continue;
    each = effort == Effort::fast ? CellStatus::overflow : CellStatus::open;
  }
}

}  // namespace

CellDrawing::CellDrawing(const SearchInput& input, std::span<const std::uint8_t> palette_index,
                         std::optional<NeighborRows> known)
    : input_(input),
      upload_(input.backend, palette_index),
      all_known_(known.has_value()),
      ladder_(input, upload_, worth_fast_pipeline),
      batches_({input.backend, input.sites, palette_index, input.threads}),
      polygons_({input.backend, input.sites, palette_index, input.threads}),
      status_(input.sites.size(), CellStatus::certified),
      pixels_(input.sites, palette_index, input.threads) {
  if (known) take(std::move(*known));
}

/// A site without a cell may have an image at the end of the band that seems to have one.
void CellDrawing::take(NeighborRows known) {
  std::vector<std::uint32_t> which(known.size());
  for (std::uint32_t i = 0; i < which.size(); ++i) {
    which[i] = i;
    const bool hidden = !input_.sites.hidden.empty() && input_.sites.hidden[i] != 0;
    if (hidden) known.drop(i, CellStatus::empty);
    status_[i] = known.status(i);
  }
  known_.push_back({std::move(which), std::move(known)});
}

Result<void> CellDrawing::draw(const View& view) {
  if (auto given = giveAll(); !given) return given;
  if (auto begun = input_.backend.begin(view); !begun) return begun;
  if (!all_known_) {
    if (auto climbed = climb(view); !climbed) return climbed;
  }
  for (const auto& cells : known_) {
    if (auto drawn = polygons_.draw(view, cells, input_.progress); !drawn) return drawn;
  }
  return giveAll();
}

/// Has the device find and draw what it can.
Result<void> CellDrawing::climb(const View& view) {
  const auto by_grid = [&](const Tile&, auto which, Effort effort, auto status) -> Result<void> {
    const Stopwatch watch;
    if (auto drawn = askToDraw(input_.backend, which, effort, status); !drawn) return drawn;
    grid_seconds_ += watch.seconds();
    askForRoom(effort, status);
    return {};
  };
  const auto by_lists = [&](const Candidates& candidates, Effort effort, auto status) -> Result<void> {
    const auto drawn = batches_.draw(view, candidates, effort);
    if (!drawn) return tl::unexpected(drawn.error());
    std::ranges::copy(*drawn, status.begin());
    askForCandidates(effort, status);
    return {};
  };
  auto judged = ladder_.climb({by_grid, by_lists});
  if (!judged) return tl::unexpected(judged.error());
  for (std::size_t e = 0; e < judged->which.size(); ++e) status_[judged->which[e]] = judged->found.status(e);
  known_.push_back(std::move(*judged));
  return {};
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

void CellDrawing::describe(Report& report) const {
  ladder_.describe(report);
  auto& times = report.time_ms;
  const auto add = [](double seconds, double& to) { to = std::max(to, 0.0) + 1e3 * seconds; };
  add(upload_.seconds(), times.upload);
  if (ladder_.judgeSeconds() > 0) add(ladder_.judgeSeconds(), times.cells);
  times.draw = 1e3 * (polygons_.seconds() + batches_.seconds() + grid_seconds_);
}

}  // namespace vorpipe::core

#include <fmt/core.h>

#include <cmath>
#include <new>
#include <utility>

#include "base/double_double.h"
#include "base/parallel.h"
#include "base/refusal.h"
#include "base/stopwatch.h"
#include "base/try.h"
#include "cells/diagram_writer.h"
#include "session/input_check.h"
#include "session/open_cells.h"
#include "session/session_state.h"
#include "session/tiles.h"
#include "vorpipe/tiled.h"

namespace vorpipe {

using namespace core;

namespace {

/// Open cells are settled once they number a tile's usual sites divided by this.
constexpr std::uint64_t open_at_once = 8;

constexpr std::size_t cells_in_tiles_grain = std::size_t{1} << 13;

/// Sums over some cells.
struct Sums {
  DoubleDouble area;
  std::uint64_t ok = 0, empty = 0, duplicate = 0;

  void add(const CellMeasures& cell) {
    area = area + DoubleDouble(cell.area);
    ok += cell.status == Status::ok ? 1u : 0u;
    empty += cell.status == Status::empty ? 1u : 0u;
    duplicate += cell.status == Status::duplicate ? 1u : 0u;
  }
};

/// Adds one run's report to the total.
void addReport(const Report& from, Report& to) {
  to.backend = from.backend;
  to.device = from.device;
  to.driver = from.driver;
  to.retried += from.retried;
  to.in_double += from.in_double;
  to.exact += from.exact;
  to.time_ms.upload = std::max(to.time_ms.upload, 0.0) + std::max(from.time_ms.upload, 0.0);
  to.time_ms.search = std::max(to.time_ms.search, 0.0) + std::max(from.time_ms.search, 0.0);
  to.pipelines.insert(to.pipelines.end(), from.pipelines.begin(), from.pipelines.end());
  to.notes.insert(to.notes.end(), from.notes.begin(), from.notes.end());
  to.validation_messages.insert(to.validation_messages.end(), from.validation_messages.begin(),
                                from.validation_messages.end());
}

/// One run over all tiles.
class TiledRun {
 public:
  TiledRun(FindPart find, const TiledOptions& options, int threads, const SiteCells& cells,
           const CellsSink& sink)
      : find_(std::move(find)), options_(options), threads_(threads), cells_(cells), sink_(sink) {}

  Result<TiledReport> run() {
    const auto tiles = tilesOf(cells_, std::min(options_.usual, options_.most));
    for (const TileBlock& tile : tiles) {
      made_.largest = std::max(made_.largest, tile.sites);
      if (tile.sites > options_.most) return tl::unexpected(crowded(tile));
    }
    made_.tiles = tiles.size();
    for (const TileBlock& tile : tiles) {
      VORPIPE_TRY(measure(tile));
      if (open_.sites.size() < options_.usual / open_at_once) continue;
      VORPIPE_TRY(settle());
    }
    VORPIPE_TRY(settle());
    made_.area_sum = sum_.high;
    return std::move(made_);
  }

 private:
  [[nodiscard]] Error crowded(const TileBlock& tile) const {
    const double size = cells_.lattice().size;
    const Point place{cells_.lattice().xmin + tile.own.west * size,
                      cells_.lattice().ymin + tile.own.south * size};
    const Unscale unscale(cells_.exponent());
    const Point at = unscale(place);
    return refusal(Subject::sites,
                   fmt::format("{} of them are crowded together around {}, {}, more than the {} that a tile "
                               "may have",
                               tile.sites, at.x, at.y, options_.most));
  }

  Result<void> measure(const TileBlock& tile) {
    const PartSites part = sitesOf(cells_, tile, threads_);
    const PartFrame frame = frameOf(cells_, tile);
    const Box& box = frame.prepared.domain;
    std::vector<std::uint32_t> which;
    if (!(box.xmin < box.xmax && box.ymin < box.ymax)) {
      // Beyond the domain.
      for (std::uint32_t i = 0; i < part.own.size(); ++i) {
        if (part.own[i] != 0) open_.sites.push_back(part.number[i]);
      }
      return {};
    }
    VORPIPE_LET(found, find_(part, frame));
    const auto open = openCells(part, found, knownBox(cells_, tile), threads_);
    addOpen(part, found, open);
    auto next = open.begin();
    for (std::uint32_t i = 0; i < part.own.size(); ++i) {
      const bool is_open = next != open.end() && *next == i;
      if (is_open) ++next;
      if (part.own[i] != 0 && !is_open) which.push_back(i);
    }
    return take(part, found, which);
  }

  void addOpen(const PartSites& part, const PartCells& found, std::span<const std::uint32_t> open) {
    if (open.empty()) return;
    const auto& set = found.run->prepared.set;
    std::vector<std::uint8_t> is_open(part.own.size());
    for (const auto i : open) {
      is_open[i] = 1;
      open_.sites.push_back(part.number[i]);
    }
    for (std::size_t cell = 0; cell < set.size(); ++cell) {
      if (is_open[set.id[cell]] == 0) continue;
      for (const auto neighbor : found.agreed.rows.edges(cell)) {
        if (neighbor >= 0) open_.around.push_back(part.number[set.id[static_cast<std::size_t>(neighbor)]]);
      }
    }
  }

  Result<void> settle() {
    made_.open += open_.sites.size();
    return settleOpenCells(cells_, std::exchange(open_, {}), options_.most, threads_, find_,
                           [this](const PartSites& part, const PartCells& found,
                                  std::span<const std::uint32_t> which) { return take(part, found, which); });
  }

  /// Hands the cells `which` of a part to the sink.
  Result<void> take(const PartSites& part, const PartCells& found, std::span<const std::uint32_t> which) {
    numbers_.resize(which.size());
    measures_.resize(which.size());
    std::vector<Sums> sums((which.size() + cells_in_tiles_grain - 1) / cells_in_tiles_grain);
    parallelFor(which.size(), cells_in_tiles_grain, threads_, [&](std::size_t begin, std::size_t end) {
      Sums& sum = sums[begin / cells_in_tiles_grain];
      for (auto k = begin; k < end; ++k) {
        numbers_[k] = part.number[which[k]];
        measures_[k] = measuresOf(part, found, which[k]);
        sum.add(measures_[k]);
      }
    });
    for (const Sums& sum : sums) add(sum);
    addReport(found.report, made_.report);
    return sink_(numbers_, measures_);
  }

  void add(const Sums& sum) {
    sum_ = sum_ + sum.area;
    made_.report.ok += sum.ok;
    made_.report.empty += sum.empty;
    made_.report.duplicate += sum.duplicate;
  }

  FindPart find_;
  const TiledOptions& options_;
  int threads_;
  const SiteCells& cells_;
  const CellsSink& sink_;
  TiledReport made_;
  OpenCells open_;
  DoubleDouble sum_;
  std::vector<std::uint32_t> numbers_;
  std::vector<CellMeasures> measures_;
};

/// Refuses areas that do not add up to the domain's, as in Session::cells.
Result<void> checkSum(const TiledReport& made, const Box& domain) {
  const double area = (domain.xmax - domain.xmin) * (domain.ymax - domain.ymin);
  const double gap = std::isnormal(area) ? made.area_sum / area - 1 : 0;
  if (std::abs(gap) <= area_wrong) return {};
  return tl::unexpected(refusal(
      Subject::sites,
      fmt::format("the areas of all cells add up to {} of the domain's, beyond what rounding explains",
                  1 + gap)));
}

}  // namespace

SitesInPlace sitesInPlace(const Sites& sites) {
  const auto of = [](const std::vector<double>& values) {
    return NumbersInPlace{reinterpret_cast<const std::byte*>(values.data()), sizeof(double), false};
  };
  return {of(sites.x), of(sites.y), sites.size()};
}

CellsInTiles::CellsInTiles(Session& session, TiledOptions options)
    : session_(session), options_(std::move(options)) {}

Result<TiledReport> CellsInTiles::measure(const SitesInPlace& sites, const CellsSink& sink) {
  try {
    CellsOptions checked{};
    checked.domain = options_.domain;
    checked.search = options_.search;
    VORPIPE_TRY(checkOptions({}, checked));
    Session::State& on = *session_.state_;
    const Stopwatch watch;
    VORPIPE_VAR(cells, SiteCells::over(sites, options_.domain, on.threads, options_.progress));
    const double order_ms = watch.milliseconds();
    Progress go_on;
    // Progress within a tile is not reported: the stages would restart for each tile.
    double done = 0;
    if (options_.progress) {
      go_on = [&](std::string_view, double) { return options_.progress("cells in tiles", done); };
    }
    const FindPart find = [&](const PartSites& part, const PartFrame& frame) {
      return on.device.run<PartCells>([&](Backend& backend) {
        return cellsOfPart(on.with(backend), cells, part, frame, options_.search, go_on);
      });
    };
    const CellsSink counted = [&](auto numbers, auto measures) -> Result<void> {
      done += static_cast<double>(numbers.size()) / static_cast<double>(sites.count);
      if (go_on && !go_on("", done)) return tl::unexpected(Error{ErrorCode::cancelled, "cancelled"});
      return sink(numbers, measures);
    };
    auto made = TiledRun(find, options_, on.threads, cells, counted).run();
    if (!made) return made;
    VORPIPE_TRY(checkSum(*made, options_.domain));
    Times& times = made->report.time_ms;
    times.order = order_ms;
    times.cells = watch.milliseconds() - order_ms - times.upload - times.search;
    return made;
  } catch (const std::bad_alloc&) {
    return tl::unexpected(outOfMemory());
  }
}

}  // namespace vorpipe

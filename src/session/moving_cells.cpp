#include <algorithm>
#include <cmath>
#include <new>
#include <optional>
#include <utility>

#include "base/parallel.h"
#include "base/try.h"
#include "domain/cell_mass.h"
#include "domain/cells_run.h"
#include "session/cell_edges.h"
#include "session/disc_cells.h"
#include "session/input_check.h"
#include "session/session_state.h"

namespace vorpipe {

using namespace core;

struct MovingCells::State {
  Session::State* session;
  CellsOptions options;
  Surface surface;
  Density density{};  ///< apart from the options: mass and spread are measured together here
  std::optional<std::size_t> count{};
  CellMoments moments{};
  CellsThatMeet neighbors{};
  EdgesOfCells edges{};
  bool has_neighbors = false, has_edges = false;  ///< written since the last update
  FoundBox found{};
  CellPolygons polygons{};
  Sites places{};              ///< of sites whose cells are polygons
  FreeSurface free_surface{};  ///< if the surface is free
  Report report{};

  [[nodiscard]] bool needsPolygons() const {
    return options.periodic != Periodic::none || !options.outline.empty();
  }
  [[nodiscard]] std::optional<DensityPixels> pixels() const {
    if (density.values.empty()) return {};
    return DensityPixels(density, options.domain, options.periodic);
  }

  Result<void> update(const Sites& sites, bool unless_empty);
  Result<void> findInBox(const Sites& sites, bool unless_empty);
  Result<void> findPolygons(const Sites& sites);
  void takePolygons(FoundCells cells);
  void takeReport(Report of_update);
  void weigh(const OwnCorners& cells);
};

Result<void> MovingCells::State::findInBox(const Sites& sites, bool unless_empty) {
  struct Done {
    Report report;
  };
  auto done = session->device.run<Done>([&](Backend& backend) -> Result<Done> {
    const Machine machine = session->with(backend);
    const AtEmpty at_empty = unless_empty ? AtEmpty::end : AtEmpty::ignore;
    VORPIPE_VAR(made, findMoments(machine, sites, options, at_empty, found, moments));
    if (found.cells && surface == Surface::free)
      cutByDiscs(found, sites, machine.threads, moments, made, free_surface);
    return Done{std::move(made)};
  });
  if (!done) return tl::unexpected(done.error());
  takeReport(std::move(done->report));
  if (!found.cells) return {};
  const Prepared& prepared = found.run->prepared;
  weigh({prepared.set, found.cells->rows, Unscale(prepared.exponent), sites, session->threads});
  return {};
}

/// Keeps the report of the last update, and adds earlier pipelines, which are made only once.
void MovingCells::State::takeReport(Report of_update) {
  auto& made = of_update.pipelines;
  made.insert(made.begin(), report.pipelines.begin(), report.pipelines.end());
  report = std::move(of_update);
}

/// Gives cells their masses under the density.
void MovingCells::State::weigh(const OwnCorners& cells) {
  if (const auto density_pixels = pixels())
    weighCells(cells, *density_pixels, {moments.area, moments.mass, moments.centroid, moments.spread});
}

/// Periods and outlines need polygons.
Result<void> MovingCells::State::findPolygons(const Sites& sites) {
  struct Done {
    FoundCells cells;
    Report report;
  };
  auto done = session->device.run<Done>([&](Backend& backend) -> Result<Done> {
    VORPIPE_VAR(made, findCells(session->with(backend), sites, options, ImagesFor::pictures));
    Report made_report = std::move(made.diagram.report);
    return Done{std::move(made), std::move(made_report)};
  });
  if (!done) return tl::unexpected(done.error());
  takeReport(std::move(done->report));
  VORPIPE_VAR(placed, wrapped(sites, options.domain, options.periodic, session->threads));
  places = std::move(placed);
  takePolygons(std::move(done->cells));
  return {};
}

void MovingCells::State::takePolygons(FoundCells cells) {
  Diagram& d = cells.diagram;
  constexpr std::size_t grain = 1 << 14;
  moments.spread.resize(d.size());
  parallelEach(d.size(), grain, session->threads,
               [&](std::size_t i) { moments.spread[i] = d.second_moments[i][0] + d.second_moments[i][2]; });
  moments.status = std::move(d.status);
  moments.area = std::move(d.area);
  moments.mass = moments.area;
  moments.centroid = std::move(d.centroid);
  neighbors = {std::move(d.cell_offsets), std::move(d.neighbors), std::move(d.neighbor_shifts)};
  has_neighbors = true;
  polygons = {std::move(d.vertices), std::move(d.edge_lengths), std::move(d.ring_starts)};
  weigh(ownCorners(cells, options, places, session->threads));
}

MovingCells::MovingCells(Session& session, CellsOptions options, Surface surface)
    : state_(std::make_unique<State>(State{session.state_.get(), std::move(options), surface})) {
  state_->density = std::exchange(state_->options.density, {});
  state_->options.detail = Detail::polygons;
}
MovingCells::MovingCells(MovingCells&&) noexcept = default;
MovingCells& MovingCells::operator=(MovingCells&&) noexcept = default;
MovingCells::~MovingCells() = default;

Result<void> MovingCells::State::update(const Sites& sites, bool unless_empty) {
  if (count && *count != sites.size()) {
    return tl::unexpected(Error{ErrorCode::input, "as many sites as before are to move"});
  }
  try {
    VORPIPE_TRY(checkOptions(sites, options));
    if (surface == Surface::free) {
      VORPIPE_TRY(checkFreeSurface(options, density));
    }
    if (!count && !density.values.empty()) {
      VORPIPE_TRY(checkDensity(density));
    }
    has_neighbors = has_edges = false;
    auto updated = needsPolygons() ? findPolygons(sites) : findInBox(sites, unless_empty);
    if (!updated) return updated;
    count = sites.size();
    return {};
  } catch (const std::bad_alloc&) {
    return tl::unexpected(outOfMemory());
  }
}

Result<void> MovingCells::update(const Sites& sites) { return state_->update(sites, false); }

Result<bool> MovingCells::updateUnlessEmpty(const Sites& sites) {
  State& s = *state_;
  VORPIPE_TRY(s.update(sites, true));
  if (!s.needsPolygons() && !s.found.cells) return false;
  return std::ranges::all_of(s.moments.mass, [](double mass) { return mass > 0; });
}

const CellMoments& MovingCells::moments() const { return state_->moments; }

const CellsThatMeet& MovingCells::neighbors() const {
  State& s = *state_;
  if (!s.has_neighbors && s.found.cells) {
    s.neighbors = neighborsOf(s.found, s.session->threads);
    s.has_neighbors = true;
  }
  return s.neighbors;
}

const EdgesOfCells& MovingCells::edges() const {
  State& s = *state_;
  if (!s.has_edges && s.needsPolygons()) {
    s.edges = edgesOf(s.polygons, neighbors(),
                      {s.places, s.options.domain, s.options.periodic, s.density, s.session->threads});
  } else if (!s.has_edges && s.found.cells && s.surface == Surface::free) {
    s.edges = edgesInDiscs(s.found, s.free_surface, neighbors(), s.session->threads);
  } else if (!s.has_edges && s.found.cells) {
    const auto density_pixels = s.pixels();
    s.edges = edgesOf(s.found, neighbors(), density_pixels ? &*density_pixels : nullptr, s.session->threads);
  }
  s.has_edges = true;
  return s.edges;
}

const Report& MovingCells::report() const { return state_->report; }

}  // namespace vorpipe

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>
#include <utility>

#include "base/parallel.h"
#include "core/cells/cell_mass.h"
#include "core/cells/cells_run.h"
#include "core/moving/box_edges.h"
#include "core/moving/disc_cells.h"
#include "core/session/input_check.h"
#include "core/session/session_state.h"

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
  bool has_neighbors = false, has_edges = false;  ///< those of the last update are written
  FoundBox found{};
  FreeSurface free_surface{};  ///< where the surface is one
  Report report{};

  [[nodiscard]] bool needsPolygons() const {
    return options.periodic != Periodic::none || !options.outline.empty() || !density.values.empty();
  }

  Result<void> findInBox(const Sites& sites);
  Result<void> findPolygons(const Sites& sites);
  void takePolygons(Diagram cells);
};

Result<void> MovingCells::State::findInBox(const Sites& sites) {
  struct Done {
    Report report;
  };
  auto done = session->device.run<Done>([&](Backend& backend) -> Result<Done> {
    const Machine machine = session->with(backend);
    auto made = findMoments(machine, sites, options, found, moments);
    if (!made) return tl::unexpected(made.error());
    if (surface == Surface::free) cutByDiscs(found, sites, machine.threads, moments, *made, free_surface);
    return Done{std::move(*made)};
  });
  if (!done) return tl::unexpected(done.error());
  report = std::move(done->report);
  return {};
}

/// Periods, outlines and densities are measured by polygons.
Result<void> MovingCells::State::findPolygons(const Sites& sites) {
  auto cells = session->device.run<Diagram>(
      [&](Backend& backend) { return cellsOn(session->with(backend), sites, options); });
  if (!cells) return tl::unexpected(cells.error());
  takePolygons(std::move(*cells));
  return {};
}

void MovingCells::State::takePolygons(Diagram cells) {
  if (density.values.empty()) {
    constexpr std::size_t grain = 1 << 14;
    moments.spread.resize(cells.size());
    parallelFor(cells.size(), grain, session->threads, [&](std::size_t begin, std::size_t end) {
      for (auto i = begin; i < end; ++i) {
        moments.spread[i] = cells.second_moments[i][0] + cells.second_moments[i][2];
      }
    });
  } else {
    measureMass(density, options.domain, options.periodic, session->threads, cells, &moments.spread);
  }
  moments.status = std::move(cells.status);
  moments.area = std::move(cells.area);
  moments.mass = cells.mass.empty() ? moments.area : std::move(cells.mass);
  moments.centroid = cells.mass_centroid.empty() ? std::move(cells.centroid) : std::move(cells.mass_centroid);
  neighbors = {std::move(cells.cell_offsets), std::move(cells.neighbors), std::move(cells.neighbor_shifts)};
  has_neighbors = true;
  report = std::move(cells.report);
}

MovingCells::MovingCells(Session& session, CellsOptions options, Surface surface)
    : state_(std::make_unique<State>(State{session.state_.get(), std::move(options), surface})) {
  state_->density = std::exchange(state_->options.density, {});
  state_->options.detail = Detail::polygons;
}
MovingCells::MovingCells(MovingCells&&) noexcept = default;
MovingCells& MovingCells::operator=(MovingCells&&) noexcept = default;
MovingCells::~MovingCells() = default;

Result<void> MovingCells::update(const Sites& sites) {
  State& s = *state_;
  if (s.count && *s.count != sites.size()) {
    return tl::unexpected(Error{ErrorCode::input, "as many sites as before are to move"});
  }
  try {
    if (auto checked = checkOptions(sites, s.options); !checked) return checked;
    if (s.surface == Surface::free) {
      if (auto checked = checkFreeSurface(s.options, s.density); !checked) return checked;
    }
    if (!s.count && !s.density.values.empty()) {
      if (auto checked = checkDensity(s.density); !checked) return checked;
    }
    s.has_neighbors = s.has_edges = false;
    auto found = s.needsPolygons() ? s.findPolygons(sites) : s.findInBox(sites);
    if (!found) return found;
    s.count = sites.size();
    return {};
  } catch (const std::bad_alloc&) {
    return tl::unexpected(outOfMemory());
  }
}

Result<bool> MovingCells::updateUnlessEmpty(const Sites& sites) {
  if (auto updated = update(sites); !updated) return tl::unexpected(std::move(updated.error()));
  return std::ranges::all_of(state_->moments.mass, [](double mass) { return mass > 0; });
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
  if (!s.has_edges && s.found.cells) {
    s.edges = s.surface == Surface::free
                  ? edgesInDiscs(s.found, s.free_surface, neighbors(), s.session->threads)
                  : edgesOf(s.found, neighbors(), s.session->threads);
  }
  s.has_edges = true;
  return s.edges;
}

const Report& MovingCells::report() const { return state_->report; }

}  // namespace vorpipe

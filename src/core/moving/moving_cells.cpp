#include <cmath>
#include <optional>
#include <utility>

#include "core/cells/cell_mass.h"
#include "vorpipe.h"

namespace vorpipe {

struct MovingCells::State {
  Session* session;
  CellsOptions options;
  Density density;  ///< apart from the options: mass and spread are measured together here
  std::optional<std::size_t> count{};
  CellMoments moments{};
  CellsThatMeet neighbors{};
  Report report{};
};

MovingCells::MovingCells(Session& session, CellsOptions options)
    : state_(std::make_unique<State>(State{&session, std::move(options), {}})) {
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
  const bool has_density = !s.density.values.empty();
  if (!s.count && has_density) {
    if (auto checked = core::checkDensity(s.density); !checked) return checked;
  }
  auto cells = s.session->cells(sites, s.options);
  if (!cells) return tl::unexpected(cells.error());
  if (has_density) {
    core::measureMass(s.density, s.options.domain, s.options.periodic, 0, *cells, &s.moments.spread);
  } else {
    s.moments.spread.resize(sites.size());
    for (std::size_t i = 0; i < sites.size(); ++i) {
      s.moments.spread[i] = cells->second_moments[i][0] + cells->second_moments[i][2];
    }
  }
  s.count = sites.size();
  s.moments.status = std::move(cells->status);
  s.moments.area = std::move(cells->area);
  s.moments.mass = cells->mass.empty() ? s.moments.area : std::move(cells->mass);
  s.moments.centroid =
      cells->mass_centroid.empty() ? std::move(cells->centroid) : std::move(cells->mass_centroid);
  s.neighbors = {std::move(cells->cell_offsets), std::move(cells->neighbors),
                 std::move(cells->neighbor_shifts)};
  s.report = std::move(cells->report);
  return {};
}

const CellMoments& MovingCells::moments() const { return state_->moments; }
const CellsThatMeet& MovingCells::neighbors() const { return state_->neighbors; }
const Report& MovingCells::report() const { return state_->report; }

}  // namespace vorpipe

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/stopwatch.h"
#include "vorpipe.h"

namespace vorpipe {

struct Relaxation::State {
  RelaxOptions options;
  MovingCells cells;
  Sites sites;
  std::vector<RelaxStep> trace{};
  RelaxEnd end = RelaxEnd::iterations;
  Stopwatch watch{};

  Result<void> measure() {
    if (auto done = cells.update(sites); !done) return done;
    const CellMoments& m = cells.moments();
    RelaxStep step{trace.size()};
    double area = 0;
    for (std::size_t i = 0; i < sites.size(); ++i) {
      const double dx = m.centroid[i].x - sites.x[i], dy = m.centroid[i].y - sites.y[i];
      if (m.status[i] != Status::ok) continue;
      const double weight = sites.weight.empty() ? 0 : sites.weight[i];
      step.energy += m.spread[i] + m.mass[i] * (dx * dx + dy * dy - weight);
      step.farthest = std::max(step.farthest, std::hypot(dx, dy));
      area += m.area[i];
    }
    const double count = static_cast<double>(cells.report().ok);
    step.hexagonal = step.energy / (5 / (18 * std::sqrt(3.0)) * area * area / count);
    step.farthest /= std::sqrt(area / count);
    step.seconds = watch.seconds();
    trace.push_back(step);
    return {};
  }
};

Relaxation::Relaxation() = default;
Relaxation::Relaxation(Relaxation&&) noexcept = default;
Relaxation& Relaxation::operator=(Relaxation&&) noexcept = default;
Relaxation::~Relaxation() = default;

Result<Relaxation> Relaxation::begin(Session& session, Sites sites, RelaxOptions options) {
  CellsOptions cells{};
  cells.domain = options.domain;
  cells.outline = options.outline;
  cells.periodic = options.periodic;
  cells.density = options.density;
  cells.search = options.search;
  cells.progress = options.progress;
  Relaxation relaxation;
  relaxation.state_ = std::make_unique<State>(
      State{std::move(options), MovingCells(session, std::move(cells)), std::move(sites)});
  if (auto done = relaxation.state_->measure(); !done) return tl::unexpected(done.error());
  return relaxation;
}

Result<bool> Relaxation::step() {
  State& s = *state_;
  if (s.trace.size() > s.options.iterations) return false;
  const CellMoments& m = s.cells.moments();
  for (std::size_t i = 0; i < s.sites.size(); ++i) {
    if (m.status[i] != Status::ok) continue;
    s.sites.x[i] = m.centroid[i].x;
    s.sites.y[i] = m.centroid[i].y;
  }
  if (auto done = s.measure(); !done) return tl::unexpected(done.error());
  return true;
}

const Sites& Relaxation::sites() const { return state_->sites; }
const std::vector<RelaxStep>& Relaxation::trace() const { return state_->trace; }
RelaxEnd Relaxation::end() const { return state_->end; }
const Report& Relaxation::report() const { return state_->cells.report(); }

}  // namespace vorpipe

#include "view/painter.h"

#include <utility>

#include "base/stopwatch.h"
#include "base/try.h"

namespace vorpipe::view {
namespace {

double kineticEnergy(const FluidState& state) {
  double energy = 0;
  for (std::size_t i = 0; i < state.velocity.size(); ++i) {
    const Point v = state.velocity[i];
    const double density = state.density.empty() ? 1 : state.density[i];
    energy += density * state.volume[i] * (v.x * v.x + v.y * v.y) / 2;
  }
  return energy;
}

}  // namespace

/// Whether the request's fluid is in this one's present state. Or in the state before, if the request was
/// issued in the same gesture before the last change was known.
bool FluidRun::isAt(const FrameRequest& request) const {
  if (!fluid_) return false;
  return request.fluid == now_ || (request.fluid == before_ && request.gesture == gesture_);
}

/// Makes the fluid's present state available to others, as `now_`.
void FluidRun::take(FixedSites sites, std::uint64_t stirred) {
  auto snapshot = std::make_shared<FluidSnapshot>();
  snapshot->setup = {fluid_->state(), setup_.options};
  snapshot->last = fluid_->last();
  snapshot->sites = sites ? std::move(sites) : std::make_shared<const Sites>(snapshot->setup.state.sites);
  snapshot->is_begun = true;
  if (stirred != now_->stirred) snapshot->last.kinetic = kineticEnergy(snapshot->setup.state);
  snapshot->stirred = stirred;
  now_ = std::move(snapshot);
}

Result<void> FluidRun::begin(Session& session, const FixedFluid& from, const Progress& progress) {
  fluid_.reset();
  setup_.options = from->setup.options;
  FluidOptions options = setup_.options;
  options.progress = progress;
  VORPIPE_VAR(begun, Fluid::begin(session, from->setup.state, std::move(options)));
  fluid_ = std::move(begun);
  now_ = from;
  if (!from->is_begun) take({}, from->stirred);
  return {};
}

Result<void> FluidRun::stir(const FrameRequest& request) {
  std::uint64_t stirred = now_->stirred;
  for (const Stroke& stroke : request.strokes) {
    if (stroke.number <= now_->stirred) continue;
    VORPIPE_TRY(fluid_->push(pushOf(stroke, now_->setup)));
    stirred = stroke.number;
  }
  if (stirred > now_->stirred) take(now_->sites, stirred);
  return {};
}

Result<void> FluidRun::step(Frame& frame) {
  const auto more = fluid_->step();
  if (!more || !*more) {
    const FluidEnd end = fluid_->end();
    // A new fluid will continue from `now_`.
    fluid_.reset();
    if (!more) return tl::unexpected(more.error());
    if (end == FluidEnd::cancelled) return tl::unexpected(Error{ErrorCode::cancelled, "cancelled"});
    frame.ended = end;
    return {};
  }
  take({}, now_->stirred);
  frame.flowed = true;
  return {};
}

Result<void> FluidRun::go(Session& session, const FrameRequest& request, const Progress& progress,
                          double seconds, Frame& frame) {
  const bool stirs = !request.strokes.empty() && request.strokes.back().number > request.fluid->stirred;
  const bool steps = request.motion != Motion::rests;
  frame.fluid_from = frame.fluid = request.fluid;
  if (request.fluid->is_begun && !stirs && !steps) return {};
  // A single step must start from the state for which it was requested.
  const bool is_at = isAt(request) && (request.motion != Motion::steps_once || request.fluid == now_);
  if (!is_at) {
    VORPIPE_TRY(begin(session, request.fluid, progress));
  } else {
    frame.fluid_from = now_;
  }
  before_ = frame.fluid_from;
  gesture_ = request.gesture;
  VORPIPE_TRY(stir(request));
  if (steps) {
    const Stopwatch watch;
    do {
      VORPIPE_TRY(step(frame));
    } while (!frame.ended && watch.seconds() < seconds);
  }
  frame.fluid = now_;
  frame.sites = now_->sites;
  return {};
}

}  // namespace vorpipe::view

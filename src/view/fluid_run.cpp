#include "view/fluid_run.h"

#include <utility>

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

/// Whether the wish's fluid is in this one's present state. Or in the state before, if the wish was issued in
/// the same gesture before the last change was known.
bool FluidRun::isAt(const Wish& wish) const {
  if (!fluid_) return false;
  return wish.fluid == now_ || (wish.fluid == before_ && wish.gesture == gesture_);
}

/// Makes the fluid's present state available to others, as `now_`.
void FluidRun::take(FixedSites sites, std::uint64_t stirred) {
  auto flowing = std::make_shared<Flowing>();
  flowing->setup = {fluid_->state(), setup_.options};
  flowing->last = fluid_->last();
  flowing->sites = sites ? std::move(sites) : std::make_shared<const Sites>(flowing->setup.state.sites);
  flowing->is_begun = true;
  if (stirred != now_->stirred) flowing->last.kinetic = kineticEnergy(flowing->setup.state);
  flowing->stirred = stirred;
  now_ = std::move(flowing);
}

Result<void> FluidRun::begin(Session& session, const FixedFluid& from, const Progress& progress) {
  fluid_.reset();
  setup_.options = from->setup.options;
  FluidOptions options = setup_.options;
  options.progress = progress;
  auto begun = Fluid::begin(session, from->setup.state, std::move(options));
  if (!begun) return tl::unexpected(std::move(begun.error()));
  fluid_ = std::move(*begun);
  now_ = from;
  if (!from->is_begun) take({}, from->stirred);
  return {};
}

Result<void> FluidRun::stir(const Wish& wish) {
  std::uint64_t stirred = now_->stirred;
  for (const Stroke& stroke : wish.strokes) {
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

Result<void> FluidRun::go(Session& session, const Wish& wish, const Progress& progress, Frame& frame) {
  const bool stirs = !wish.strokes.empty() && wish.strokes.back().number > wish.fluid->stirred;
  const bool steps = wish.motion != Motion::rests;
  frame.fluid_from = frame.fluid = wish.fluid;
  if (wish.fluid->is_begun && !stirs && !steps) return {};
  // A single step must start from the state for which it was wished.
  const bool is_at = isAt(wish) && (wish.motion != Motion::steps_once || wish.fluid == now_);
  if (!is_at) {
    VORPIPE_TRY(begin(session, wish.fluid, progress));
  } else {
    frame.fluid_from = now_;
  }
  before_ = frame.fluid_from;
  gesture_ = wish.gesture;
  VORPIPE_TRY(stir(wish));
  if (steps) {
    VORPIPE_TRY(step(frame));
  }
  frame.fluid = now_;
  frame.sites = now_->sites;
  return {};
}

}  // namespace vorpipe::view

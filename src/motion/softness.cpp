#include "motion/softness.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/block_sums.h"
#include "motion/movable.h"

namespace vorpipe::moving {
namespace {

/// Epsilon times the usual speed, in spacings; decision D129.
double softnessOf(Surface surface) { return surface == Surface::free ? 3 : 2; }

/// Springs this many times softer or stiffer than by default do not suit a speed: a vortex then has errors as
/// large as its velocity.
constexpr double far_off = 5;

double fastestOf(const std::vector<Point>& velocity) {
  double fastest = 0;
  for (const Point& v : velocity) fastest = std::max(fastest, v.x * v.x + v.y * v.y);
  return std::sqrt(fastest);
}

/// Returns a note on sites more than a spacing beyond the domain, along axes that do not repeat.
std::string farBeyond(const FluidState& state, const FluidOptions& options) {
  const Box& box = options.domain;
  const double spacing = meanSpacing(state.volume);
  const RepeatingAxes around = repeats(options.periodic);
  const auto beyond = [](double at, double low, double high) { return std::max(low - at, at - high); };
  std::size_t count = 0;
  double farthest = 0;
  for (std::size_t i = 0; i < state.sites.size(); ++i) {
    const double x = around.x ? 0 : beyond(state.sites.x[i], box.xmin, box.xmax);
    const double y = around.y ? 0 : beyond(state.sites.y[i], box.ymin, box.ymax);
    if (std::max(x, y) > spacing) ++count;
    farthest = std::max({farthest, x, y});
  }
  if (count == 0) return {};
  return fmt::format("{} of {} sites lie beyond the domain, up to {:.3g} spacings: their cells do not", count,
                     state.sites.size(), farthest / spacing);
}

}  // namespace

double meanSpacing(const std::vector<double>& volume) {
  const double sum = carefulSum(volume.size(), 1, [&](std::size_t i) { return volume[i]; });
  return std::sqrt(sum / static_cast<double>(volume.size()));
}

std::vector<double> fallOf(const FluidState& state, const FluidOptions& options) {
  const Box& box = options.domain;
  const Point pull = options.gravity;
  const Point floor{pull.x > 0 ? box.xmax : box.xmin, pull.y > 0 ? box.ymax : box.ymin};
  std::vector<double> fall(state.sites.size());
  for (std::size_t i = 0; i < fall.size(); ++i) {
    fall[i] = pull.x * (floor.x - state.sites.x[i]) + pull.y * (floor.y - state.sites.y[i]);
  }
  return fall;
}

double usualSpeed(const FluidState& state, const FluidOptions& options) {
  const std::vector<double> fall = fallOf(state, options);
  const double deepest = std::max(0.0, *std::ranges::max_element(fall));
  return std::max(fastestOf(state.velocity), std::sqrt(2 * deepest) / 2);
}

double usualEpsilon(const FluidState& state, const FluidOptions& options) {
  const Box& box = options.domain;
  const double speed = usualSpeed(state, options);
  const double side = std::min(box.xmax - box.xmin, box.ymax - box.ymin);
  return softnessOf(options.surface) * meanSpacing(state.volume) / (speed > 0 ? speed : side);
}

bool areTooSoft(double epsilon, double speed, double spacing, Surface surface) {
  return epsilon * speed > far_off * softnessOf(surface) * spacing;
}

std::string unfitFor(double epsilon, double speed, double spacing, Surface surface) {
  const double fit = softnessOf(surface) * spacing / speed;
  const bool are_soft = areTooSoft(epsilon, speed, spacing, surface);
  if (!(speed > 0) || (!are_soft && epsilon * far_off >= fit)) return {};
  return fmt::format("epsilon: springs of {:.3g} are too {} for speeds of {:.3g}; {:.3g} goes with them",
                     epsilon, are_soft ? "soft" : "stiff", speed, fit);
}

double longestStep(double epsilon) { return 2 * epsilon; }

std::vector<std::string> notesBefore(const FluidState& state, const FluidOptions& options, bool is_chosen) {
  std::vector<std::string> notes;
  if (auto beyond = farBeyond(state, options); !beyond.empty()) notes.push_back(std::move(beyond));
  if (options.scheme != FluidScheme::springs) return notes;
  const double epsilon = options.epsilon, speed = usualSpeed(state, options);
  if (is_chosen && !(speed > 0)) {
    notes.push_back(
        fmt::format("epsilon: nothing moves and nothing pulls; springs of {:.3g} are for speeds of the "
                    "domain's shorter side "
                    "per unit of time",
                    epsilon));
  }
  auto unfit = unfitFor(epsilon, speed, meanSpacing(state.volume), options.surface);
  if (!unfit.empty()) notes.push_back(std::move(unfit));
  if (options.step > longestStep(epsilon)) {
    notes.push_back(fmt::format(
        "step: {:.3g} is longer than the {:.3g} up to which springs of epsilon {:.3g} are stable: energy "
        "will grow without end; {:.3g} conserves it",
        options.step, longestStep(epsilon), epsilon, epsilon / 4));
  }
  return notes;
}

}  // namespace vorpipe::moving

/// A fluid in a window, at one moment.
#pragma once

#include <cstdint>
#include <memory>

#include "vorpipe/fluid.h"
#include "vorpipe/picture.h"
#include "vorpipe/sites.h"

namespace vorpipe::view {

/// Sites that do not change any more: where they do, there are others. So that a pointer tells which they
/// are, and another thread may have them.
using FixedSites = std::shared_ptr<const Sites>;

/// All that later steps depend on. It does not change any more: a step makes another.
struct Flowing {
  FluidSetup setup{};         ///< as it is now; without progress
  FluidStep last{};           ///< the result of the last step
  FixedSites sites{};         ///< those of the state; velocities alone may change between two with the same
  bool is_begun = false;      ///< its sites have the weights of their cells
  std::uint64_t stirred = 0;  ///< the number of the last stroke that is in its velocities
};
using FixedFluid = std::shared_ptr<const Flowing>;

/// A fluid that is to begin, or to go on with other options.
FixedFluid toBegin(FluidSetup setup);

/// What colors of a fluid's cells stand for.
enum class FlowColor : std::uint8_t {
  none,  ///< what ColorBy says
  density,
  speed,
};

/// Density where there are several, and cells would have the colors of their indices.
FlowColor usualFlowColor(const FluidState& state, ColorBy color);

/// The pointer, as it was dragged through a fluid.
struct Stroke {
  std::uint64_t number = 0;  ///< above that of all before
  Point from{0, 0}, to{0, 0};
  double radius = 0;  ///< of the brush; nothing beyond it is pushed
  double speed = 0;   ///< that a stroke as long as the radius adds to what lies on its way
};

/// What a stroke adds to the velocities of a fluid's sites, whatever pieces it is drawn in.
std::vector<Point> pushOf(const Stroke& stroke, const FluidSetup& fluid);

/// A speed that is usual in a fluid: that of its sites, or of what falls through its domain.
double usualSpeed(const FluidSetup& fluid);

}  // namespace vorpipe::view

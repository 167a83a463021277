/// The fluid of a window: its state at one moment, how it is stirred, and the colors of its cells.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/option_names.h"
#include "vorpipe/fluid.h"
#include "vorpipe/picture.h"
#include "vorpipe/result.h"
#include "vorpipe/sites.h"

namespace vorpipe::view {

/// What the colors of a fluid's cells show.
enum class FlowColor : std::uint8_t {
  none,  ///< as ColorBy selects
  density,
  speed,
};

}  // namespace vorpipe::view

namespace vorpipe {

template <>
inline constexpr std::array<std::string_view, 3> names_of<view::FlowColor>{"none", "density", "speed"};

}  // namespace vorpipe

namespace vorpipe::view {

/// Immutable sites: a change makes new ones. So pointers can be compared instead of sites, and threads can
/// share them.
using FixedSites = std::shared_ptr<const Sites>;

/// All that later steps depend on. Immutable: a step makes a new one.
struct FluidSnapshot {
  FluidSetup setup{};  ///< present setup; without progress
  FluidStep last{};    ///< the result of the last step
  FixedSites sites{};  ///< those of the state; two states with the same sites may still differ in velocities
  bool is_begun = false;      ///< the sites already have their cells' weights
  std::uint64_t stirred = 0;  ///< the number of the last stroke included in the velocities
};
using FixedFluid = std::shared_ptr<const FluidSnapshot>;

/// Returns a fluid that is yet to begin, or to continue with other options.
FixedFluid toBegin(FluidSetup setup);

/// Returns the width and the height of a domain; 0 along an axis that is not periodic.
Point periodsOf(const Box& domain, Periodic axes);

/// Returns the value of `difference` modulo `period` that is nearest to 0; unchanged if the period is 0.
double leastImage(double difference, double period);

/// Returns density if there are several densities and cells would otherwise be colored by index.
FlowColor usualFlowColor(const FluidState& state, ColorBy color);

/// A drag of the pointer through a fluid.
struct Stroke {
  std::uint64_t number = 0;  ///< larger than all before
  Point from{0, 0}, to{0, 0};
  double radius = 0;  ///< of the brush; nothing beyond it is pushed
  double speed = 0;   ///< speed that a stroke as long as the radius adds to the fluid on its path
};

/// Returns what a stroke adds to the velocities of a fluid's sites. Splitting the stroke does not change the
/// sum.
std::vector<Point> pushOf(const Stroke& stroke, const FluidSetup& fluid);

/// Returns a typical speed of a fluid: that of its sites, or of a fall through its domain.
double usualSpeed(const FluidSetup& fluid);

/// Returns options for the same picture with white cells, which colorFlow() then colors.
RenderOptions ofWhiteCells(RenderOptions options);

/// Returns sites whose weights are densities or speeds, so that coloring by weight shows these values.
Sites valuesOf(const FluidState& state, FlowColor by);

/// Colors the white cells of a picture and the marks over them. Map, scale (linear if none is named) and
/// range are those of `options`. A pixel with several samples gets the color of the cell at its center.
/// Errors: those of siteColors.
Result<void> colorFlow(const FluidState& state, FlowColor by, const RenderOptions& options, Image& image);

}  // namespace vorpipe::view

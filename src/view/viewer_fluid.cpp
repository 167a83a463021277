// Viewer's functions for fluids.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "view/viewer.h"

namespace vorpipe::view {
namespace {

/// Number of steps over which the steps per second are averaged.
constexpr std::size_t steps_of_mean = 20;

double shorterSide(const Box& box) { return std::min(box.xmax - box.xmin, box.ymax - box.ymin); }

std::string endText(FluidEnd end, const FluidStep& last) {
  if (end == FluidEnd::time) return fmt::format("The fluid ends at time {:.6g}.", last.time);
  return fmt::format(
      "Areas could not be found after step {}, at time {:.6g}; a smaller step or softer springs may help.",
      last.step, last.time);
}

}  // namespace

/// Handles what the pointer has changed.
void Viewer::changed(Changed by) {
  if (by == Changed::stroke) return stir();
  // The result of the last relaxation step does not apply to changed sites.
  if ((by == Changed::sites || by == Changed::drag) && settings_.motion == Motion::rests) step_.reset();
  if (by != Changed::refused) return want(by);
  message_ = "Cells of a fluid are not added, removed or weighted.";
}

void Viewer::stir() {
  const auto [from, to] = pointer_.stroke();
  if (!document_.fluid() || (from.x == to.x && from.y == to.y)) return;
  const FluidSetup& begun = document_.opened().fluid->setup;
  strokes_.push_back({++last_stroke_, from, to, settings_.brush.radius * shorterSide(begun.options.domain),
                      settings_.brush.push * usualSpeed(begun)});
}

void Viewer::beginAgain() {
  if (!document_.fluid()) {
    message_ = no_fluid;
    return;
  }
  pointer_.release();
  strokes_.clear();
  steps_.clear();
  document_.flow(document_.fluid(), document_.opened().fluid);
  want(Changed::sites);
}

void Viewer::beginFluid(FluidCase which) {
  FluidSetup setup = fluidCase(which, settings_.parcels);
  setup.options.until = FluidOptions{}.until;
  setup.options.search = settings_.picture.search;
  const auto index = static_cast<std::size_t>(which);
  replaceContents(openedFluid(toBegin(std::move(setup)), fluidCaseNames().at(index)));
  message_ = how_to_flow;
}

void Viewer::flowBy(const FluidOptions& options) {
  const FixedFluid now = document_.fluid();
  if (!now) return;
  auto other = std::make_shared<FluidSnapshot>(*now);
  other->setup.options = options;
  document_.flow(now, std::move(other));
  want(Changed::sites);
}

/// Takes the fluid's state from a frame; returns whether the picture shows the document's fluid.
bool Viewer::acceptFluid(const Frame& frame) {
  if (frame.fluid != frame.fluid_from) {
    const bool is_wanted = !frame.flowed || settings_.motion != Motion::rests;
    // The fluid was replaced or paused meanwhile.
    if (!is_wanted || !document_.flow(frame.fluid_from, frame.fluid)) return false;
    // Requests issued meanwhile were for the fluid before this step.
    if (frame.request < requested_) want(Changed::view);
  }
  std::erase_if(strokes_, [&](const Stroke& stroke) { return stroke.number <= frame.fluid->stirred; });
  if (frame.flowed) {
    steps_.emplace_back(Stopwatch(), frame.fluid->last.step);
    if (steps_.size() > steps_of_mean) steps_.pop_front();
  }
  if (frame.ended) message_ = endText(*frame.ended, frame.fluid->last);
  if (frame.ended || (frame.flowed && settings_.motion == Motion::steps_once)) {
    settings_.motion = Motion::rests;
  }
  if (settings_.motion != Motion::runs) steps_.clear();
  return true;
}

std::optional<FluidShown> Viewer::fluidShown() const {
  const FixedFluid& fluid = document_.fluid();
  if (!fluid) return std::nullopt;
  const Opened& opened = document_.opened();
  FluidShown shown{opened.fluid_name, fluid->setup.options, fluid->last};
  if (steps_.size() > 1) {
    const double seconds = steps_.front().first.seconds() - steps_.back().first.seconds();
    const auto steps = static_cast<double>(steps_.back().second - steps_.front().second);
    if (seconds > 0) shown.steps_per_second = steps / seconds;
  }
  if (const auto& position = pointer_.position()) {
    shown.brush =
        BrushShown{*position, settings_.brush.radius * shorterSide(opened.domain) / camera_.unitsPerPixel()};
  }
  return shown;
}

}  // namespace vorpipe::view

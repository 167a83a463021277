#include "view/flowing.h"
#include "base/try.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace vorpipe::view {
namespace {

/// A stroke is summed over pieces of at most this fraction of the radius.
constexpr double longest_piece = 0.125;

/// Brush profile, smoothly from 1 at the center to 0 at the radius; takes the squared ratio of distance to
/// radius.
double brush(double squared) { return squared < 1 ? (1 - squared) * (1 - squared) : 0; }

/// Multiplies two colors channel by channel; white leaves the other unchanged.
std::uint32_t through(std::uint32_t filter, std::uint32_t color) {
  constexpr std::uint32_t most = 255;
  std::uint32_t seen = color & 0xFF000000U;
  for (int shift = 0; shift < 24; shift += 8) {
    const std::uint32_t product = (filter >> shift & most) * (color >> shift & most);
    seen |= (product + most / 2) / most << shift;
  }
  return seen;
}

}  // namespace

Point periodsOf(const Box& domain, Periodic axes) {
  return {axes == Periodic::x || axes == Periodic::xy ? domain.xmax - domain.xmin : 0,
          axes == Periodic::y || axes == Periodic::xy ? domain.ymax - domain.ymin : 0};
}

double leastImage(double difference, double period) {
  return period > 0 ? std::remainder(difference, period) : difference;
}

FixedFluid toBegin(FluidSetup setup) {
  auto snapshot = std::make_shared<FluidSnapshot>();
  snapshot->setup = std::move(setup);
  snapshot->last.step = snapshot->setup.state.step;
  snapshot->last.time = snapshot->setup.state.time;
  snapshot->sites = std::make_shared<const Sites>(snapshot->setup.state.sites);
  return snapshot;
}

FlowColor usualFlowColor(const FluidState& state, ColorBy color) {
  const auto differs = [&](double density) { return density != state.density.front(); };
  const bool are_several = std::ranges::any_of(state.density, differs);
  return color == ColorBy::site && are_several ? FlowColor::density : FlowColor::none;
}

std::vector<Point> pushOf(const Stroke& stroke, const FluidSetup& fluid) {
  const Sites& sites = fluid.state.sites;
  const Point period = periodsOf(fluid.options.domain, fluid.options.periodic);
  const Point way{stroke.to.x - stroke.from.x, stroke.to.y - stroke.from.y};
  const double length = std::hypot(way.x, way.y) / stroke.radius;
  const double pieces = std::max(1.0, std::ceil(length / longest_piece));
  std::vector<Point> push(sites.size(), Point{0, 0});
  for (std::size_t i = 0; i < sites.size(); ++i) {
    double felt = 0;
    for (double k = 0.5; k < pieces; ++k) {
      const double part = k / pieces;
      const double dx = leastImage(sites.x[i] - (stroke.from.x + part * way.x), period.x) / stroke.radius;
      const double dy = leastImage(sites.y[i] - (stroke.from.y + part * way.y), period.y) / stroke.radius;
      felt += brush(dx * dx + dy * dy);
    }
    const double speed = stroke.speed / stroke.radius * felt / pieces;
    push[i] = {speed * way.x, speed * way.y};
  }
  return push;
}

double usualSpeed(const FluidSetup& fluid) {
  const Box& box = fluid.options.domain;
  const double width = box.xmax - box.xmin, height = box.ymax - box.ymin;
  double squares = 0;
  for (const Point& v : fluid.state.velocity) squares += v.x * v.x + v.y * v.y;
  const auto count = static_cast<double>(std::max<std::size_t>(1, fluid.state.velocity.size()));
  const Point pull = fluid.options.gravity;
  const double fall = std::sqrt(std::abs(pull.x) * width + std::abs(pull.y) * height);
  const double speed = std::max(std::sqrt(squares / count), fall);
  return speed > 0 ? speed : std::min(width, height);
}

RenderOptions ofWhiteCells(RenderOptions options) {
  options.color = ColorBy::site;
  options.color_scale = ColorScale::automatic;
  options.color_range.reset();
  options.legend = options.fill = false;
  return options;
}

Sites valuesOf(const FluidState& state, FlowColor by) {
  Sites values = state.sites;
  values.weight.assign(values.size(), 1);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (by == FlowColor::speed) {
      values.weight[i] = std::hypot(state.velocity[i].x, state.velocity[i].y);
    } else if (!state.density.empty()) {
      values.weight[i] = state.density[i];
    }
  }
  return values;
}

Result<void> colorFlow(const FluidState& state, FlowColor by, const RenderOptions& options, Image& image) {
  RenderOptions scaled = options;
  scaled.color = ColorBy::weight;
  if (scaled.color_scale == ColorScale::automatic) scaled.color_scale = ColorScale::linear;
  VORPIPE_LET(colors, siteColors(valuesOf(state, by), {}, scaled));
  for (std::size_t at = 0; at < image.ids.size(); ++at) {
    if (image.ids[at] != no_site) image.rgba[at] = through(colors.rgba[image.ids[at]], image.rgba[at]);
  }
  return {};
}

}  // namespace vorpipe::view

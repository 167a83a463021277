#include "view/flowing.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "view/opened.h"

namespace vorpipe::view {
namespace {

/// A stroke is summed over pieces of at most this fraction of the radius.
constexpr double longest_piece = 0.125;

/// Brush profile, smoothly from 1 at the center to 0 at the radius; takes the squared ratio of distance to
/// radius.
double brush(double squared) { return squared < 1 ? (1 - squared) * (1 - squared) : 0; }

double leastImage(double difference, bool repeats, double period) {
  return repeats ? std::remainder(difference, period) : difference;
}

}  // namespace

FixedFluid toBegin(FluidSetup setup) {
  auto flowing = std::make_shared<Flowing>();
  flowing->setup = std::move(setup);
  flowing->last.step = flowing->setup.state.step;
  flowing->last.time = flowing->setup.state.time;
  flowing->sites = std::make_shared<const Sites>(flowing->setup.state.sites);
  return flowing;
}

FlowColor usualFlowColor(const FluidState& state, ColorBy color) {
  const auto differs = [&](double density) { return density != state.density.front(); };
  const bool are_several = std::ranges::any_of(state.density, differs);
  return color == ColorBy::site && are_several ? FlowColor::density : FlowColor::none;
}

std::vector<Point> pushOf(const Stroke& stroke, const FluidSetup& fluid) {
  const Sites& sites = fluid.state.sites;
  const FluidOptions& options = fluid.options;
  const Box& box = options.domain;
  const bool in_x = options.periodic == Periodic::x || options.periodic == Periodic::xy;
  const bool in_y = options.periodic == Periodic::y || options.periodic == Periodic::xy;
  const Point way{stroke.to.x - stroke.from.x, stroke.to.y - stroke.from.y};
  const double length = std::hypot(way.x, way.y) / stroke.radius;
  const double pieces = std::max(1.0, std::ceil(length / longest_piece));
  std::vector<Point> push(sites.size(), Point{0, 0});
  for (std::size_t i = 0; i < sites.size(); ++i) {
    double felt = 0;
    for (double k = 0.5; k < pieces; ++k) {
      const double part = k / pieces;
      const double dx =
          leastImage(sites.x[i] - (stroke.from.x + part * way.x), in_x, box.xmax - box.xmin) / stroke.radius;
      const double dy =
          leastImage(sites.y[i] - (stroke.from.y + part * way.y), in_y, box.ymax - box.ymin) / stroke.radius;
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

Opened openedFluid(FixedFluid fluid, std::string name) {
  Opened opened;
  opened.sites = *fluid->sites;
  opened.domain = fluid->setup.options.domain;
  opened.periodic = fluid->setup.options.periodic;
  opened.fluid = std::move(fluid);
  opened.fluid_name = std::move(name);
  return opened;
}

}  // namespace vorpipe::view

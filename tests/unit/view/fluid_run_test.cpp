// Fluids on the thread that draws their pictures.
#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <utility>

#include "unit/fixtures/cpu_session.h"
#include "view/flowing.h"
#include "view/painter.h"

namespace vorpipe::view {
namespace {

const Outdated still_wanted = [] { return false; };

FrameRequest flowRequest(FixedFluid fluid, Motion motion, std::uint64_t gesture = 1) {
  FrameRequest request{gesture, gesture, fluid->sites};
  request.picture.domain = fluid->setup.options.domain;
  request.picture.periodic = fluid->setup.options.periodic;
  request.picture.width = 64;
  request.picture.height = 48;
  request.backend.name = "cpu";
  request.motion = motion;
  request.fluid = std::move(fluid);
  return request;
}

FixedFluid begun(FluidCase which) { return toBegin(fluidCase(which, 64)); }

/// What the library has after as many steps.
FluidState stateAfter(FluidCase which, int steps) {
  Session session = test::cpuSession();
  FluidSetup setup = fluidCase(which, 64);
  auto fluid = Fluid::begin(session, setup.state, setup.options);
  for (int step = 0; step < steps; ++step) EXPECT_TRUE(*fluid->step());
  return fluid->state();
}

void expectEqual(const FluidState& a, const FluidState& b) {
  EXPECT_EQ(a.sites.x, b.sites.x);
  EXPECT_EQ(a.sites.y, b.sites.y);
  EXPECT_EQ(a.sites.weight, b.sites.weight);
  EXPECT_EQ(a.step, b.step);
  EXPECT_EQ(a.time, b.time);
}

Frame painted(Painter& painter, const FrameRequest& request) {
  RenderResult result = painter.paint(request, still_wanted);
  EXPECT_TRUE(result.frame) << (result.error ? result.error->message : "");
  return result.frame ? std::move(*result.frame) : Frame{};
}

TEST(FluidRun, FlowsAsTheLibraryHasIt) {
  for (const FluidCase which : {FluidCase::shear, FluidCase::dam_break}) {
    Painter painter;
    FixedFluid now = begun(which);
    for (int step = 0; step < 3; ++step) {
      const Frame frame = painted(painter, flowRequest(now, Motion::runs));
      EXPECT_EQ(frame.fluid_from, now);
      EXPECT_TRUE(frame.flowed);
      now = frame.fluid;
    }
    expectEqual(now->setup.state, stateAfter(which, 3));
    EXPECT_EQ(now->last.step, 3U);
    // Another painter, as after another backend was chosen, goes on to the same.
    Painter other;
    expectEqual(painted(other, flowRequest(now, Motion::steps_once)).fluid->setup.state,
                stateAfter(which, 4));
  }
}

TEST(FluidRun, BeginsWhereItRestsAndIsDrawnAgain) {
  Painter painter;
  const FixedFluid first = begun(FluidCase::gresho);
  const Frame frame = painted(painter, flowRequest(first, Motion::rests));
  EXPECT_FALSE(first->is_begun);
  EXPECT_TRUE(frame.fluid->is_begun);
  EXPECT_FALSE(frame.flowed);
  EXPECT_EQ(frame.fluid->last.step, 0U);
  const Frame again = painted(painter, flowRequest(frame.fluid, Motion::rests, 2));
  EXPECT_EQ(again.fluid, frame.fluid);
  EXPECT_EQ(again.rendering->image.rgba, frame.rendering->image.rgba);
}

TEST(FluidRun, TakesEachStrokeOnce) {
  Painter painter;
  const FixedFluid first = painted(painter, flowRequest(begun(FluidCase::shear), Motion::rests)).fluid;
  const Stroke strokes[] = {{1, {0.2, 0.5}, {0.4, 0.5}, 0.2, 1}, {2, {0.4, 0.5}, {0.6, 0.7}, 0.2, 1}};
  FrameRequest request = flowRequest(first, Motion::rests);
  request.strokes = {strokes[0]};
  const FixedFluid stirred = painted(painter, request).fluid;
  EXPECT_EQ(stirred->stirred, 1U);
  EXPECT_EQ(stirred->sites, first->sites);
  EXPECT_NE(stirred->last.kinetic, first->last.kinetic);
  const auto push = pushOf(strokes[0], first->setup);
  for (std::size_t i = 0; i < push.size(); ++i) {
    EXPECT_EQ(stirred->setup.state.velocity[i].x, first->setup.state.velocity[i].x + push[i].x);
  }
  // The same request again, before its result was known.
  request.strokes = {strokes[0], strokes[1]};
  const Frame frame = painted(painter, request);
  EXPECT_EQ(frame.fluid_from, stirred);
  EXPECT_EQ(frame.fluid->stirred, 2U);
  Painter other;
  const FixedFluid at_once = painted(other, request).fluid;
  for (std::size_t i = 0; i < push.size(); ++i) {
    EXPECT_EQ(at_once->setup.state.velocity[i].x, frame.fluid->setup.state.velocity[i].x);
    EXPECT_EQ(at_once->setup.state.velocity[i].y, frame.fluid->setup.state.velocity[i].y);
  }
}

TEST(FluidRun, GoesOnAfterAStepThatWasGivenUp) {
  Painter painter;
  const FixedFluid now = painted(painter, flowRequest(begun(FluidCase::shear), Motion::runs)).fluid;
  EXPECT_EQ(painter.paint(flowRequest(now, Motion::runs, 2), [] { return true; }).error->code,
            ErrorCode::cancelled);
  expectEqual(painted(painter, flowRequest(now, Motion::runs, 3)).fluid->setup.state,
              stateAfter(FluidCase::shear, 2));
}

TEST(FluidRun, Ends) {
  Painter painter;
  FluidSetup setup = fluidCase(FluidCase::shear, 64);
  setup.options.until = 1e-3;
  const FixedFluid last = painted(painter, flowRequest(toBegin(setup), Motion::runs)).fluid;
  EXPECT_EQ(last->last.time, 1e-3);
  const Frame frame = painted(painter, flowRequest(last, Motion::runs));
  EXPECT_EQ(frame.ended, FluidEnd::time);
  EXPECT_EQ(frame.fluid, last);
  // Areas that cannot be found with so few diagrams.
  setup = fluidCase(FluidCase::dam_break, 64);
  const FixedFluid calm = painted(painter, flowRequest(toBegin(setup), Motion::rests)).fluid;
  FluidSnapshot hurried = *calm;
  hurried.setup.options.diagrams = 1;
  const Frame lost =
      painted(painter, flowRequest(std::make_shared<const FluidSnapshot>(hurried), Motion::runs));
  EXPECT_EQ(lost.ended, FluidEnd::areas);
  EXPECT_TRUE(lost.rendering);
}

TEST(FluidRun, SaysWhatCannotBegin) {
  Painter painter;
  FluidSetup setup = fluidCase(FluidCase::dam_break, 64);
  setup.options.scheme = FluidScheme::projection;
  const RenderResult result = painter.paint(flowRequest(toBegin(setup), Motion::rests), still_wanted);
  ASSERT_TRUE(result.error);
  EXPECT_EQ(result.error->code, ErrorCode::input);
}

TEST(FluidRun, AirIsWhiteAndNoCell) {
  Painter painter;
  const Frame frame = painted(painter, flowRequest(begun(FluidCase::dam_break), Motion::rests));
  const Image& image = frame.rendering->image;
  // The column has a fourth of the box's width, and two thirds of its height.
  EXPECT_EQ(image.ids[63], no_site);
  EXPECT_EQ(image.rgba[63], 0xFFFFFFFFU);
  EXPECT_NE(image.ids[47 * 64], no_site);
  const auto measures = painter.measure(still_wanted);
  ASSERT_TRUE(measures);
  EXPECT_EQ(measures->area, frame.fluid->setup.state.volume);
}

TEST(FlowColors, AreThoseOfDensities) {
  Painter painter;
  FrameRequest request = flowRequest(begun(FluidCase::rayleigh_taylor), Motion::rests);
  request.flow_color = FlowColor::density;
  const Frame frame = painted(painter, request);
  const Image& image = frame.rendering->image;
  std::set<std::uint32_t> colors(image.rgba.begin(), image.rgba.end());
  EXPECT_EQ(colors.size(), 2U);
  EXPECT_EQ(image.rgba.front(), image.rgba[100]) << "heavy above";
  EXPECT_NE(image.rgba.front(), image.rgba.back());
  request.flow_color = FlowColor::speed;
  EXPECT_EQ(painted(painter, request).rendering->image.rgba.front(),
            painted(painter, request).rendering->image.rgba.back())
      << "all rest";
  request.flow_color = FlowColor::none;
  EXPECT_NE(painted(painter, request).rendering->image.rgba, image.rgba);
}

}  // namespace
}  // namespace vorpipe::view

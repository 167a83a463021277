// Fluids in a document, and what the pointer does to them.
#include "view/flowing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "view/document.h"
#include "view/pointer.h"

namespace vorpipe::view {
namespace {

FluidSetup square(Periodic periodic = Periodic::none) {
  FluidSetup fluid;
  fluid.options.domain = {0, 0, 1, 1};
  fluid.options.periodic = periodic;
  fluid.state.sites = generate(Pattern::random, 200, 3);
  return fluid;
}

Opened opened() { return openedFluid(toBegin(fluidCase(FluidCase::shear, 64)), "shear"); }

TEST(Stroke, PushesWhatIsNearAlongIt) {
  const FluidSetup fluid = square();
  const Stroke stroke{1, {0.3, 0.5}, {0.7, 0.5}, 0.2, 3};
  const auto push = pushOf(stroke, fluid);
  ASSERT_EQ(push.size(), fluid.state.sites.size());
  double most = 0;
  for (std::size_t i = 0; i < push.size(); ++i) {
    const double x = fluid.state.sites.x[i], y = fluid.state.sites.y[i];
    const double along = std::max({0.0, 0.3 - x, x - 0.7}), away = std::hypot(along, y - 0.5);
    EXPECT_EQ(push[i].y, 0);
    EXPECT_GE(push[i].x, 0);
    EXPECT_TRUE(away <= 0.2 || push[i].x == 0);
    EXPECT_TRUE(away >= 0.15 || push[i].x > 0);
    most = std::max(most, push[i].x);
  }
  // Its whole brush went over them: the integral of (1 - t^2)^2 is 16/15.
  EXPECT_GT(most, 2.5);
  EXPECT_LE(most, 3 * 16.0 / 15 * 1.01);
}

TEST(Stroke, IsTheSameInPieces) {
  const FluidSetup fluid = square();
  const auto whole = pushOf({1, {0.1, 0.2}, {0.9, 0.6}, 0.15, 1}, fluid);
  std::vector<Point> sum(whole.size(), Point{0, 0});
  for (int piece = 0; piece < 100; ++piece) {
    const double from = piece / 100.0, to = (piece + 1) / 100.0;
    const auto part =
        pushOf({1, {0.1 + 0.8 * from, 0.2 + 0.4 * from}, {0.1 + 0.8 * to, 0.2 + 0.4 * to}, 0.15, 1}, fluid);
    for (std::size_t i = 0; i < sum.size(); ++i) {
      sum[i].x += part[i].x;
      sum[i].y += part[i].y;
    }
  }
  for (std::size_t i = 0; i < sum.size(); ++i) {
    EXPECT_NEAR(sum[i].x, whole[i].x, 5e-3);
    EXPECT_NEAR(sum[i].y, whole[i].y, 5e-3);
  }
}

TEST(Stroke, GoesOnBeyondAnEndThatRepeats) {
  const auto alike = pushOf({1, {0.98, 0.5}, {1.02, 0.5}, 0.1, 1}, square(Periodic::x));
  const auto walled = pushOf({1, {0.98, 0.5}, {1.02, 0.5}, 0.1, 1}, square());
  const Sites sites = square().state.sites;
  bool any = false;
  for (std::size_t i = 0; i < alike.size(); ++i) {
    if (sites.x[i] > 0.2) {
      EXPECT_EQ(alike[i].x, walled[i].x);
    } else {
      EXPECT_EQ(walled[i].x, 0);
      any = any || alike[i].x > 0;
    }
  }
  EXPECT_TRUE(any);
}

TEST(UsualSpeed, IsThatOfSitesOrOfAFall) {
  EXPECT_NEAR(usualSpeed(fluidCase(FluidCase::taylor_green, 1024)), std::sqrt(0.5), 1e-3);
  EXPECT_NEAR(usualSpeed(fluidCase(FluidCase::dam_break, 64)), std::sqrt(9.81 * 3), 1e-12);
  EXPECT_EQ(usualSpeed(square()), 1);
}

TEST(UsualFlowColor, TellsFluidsApart) {
  EXPECT_EQ(usualFlowColor(fluidCase(FluidCase::rayleigh_taylor, 64).state, ColorBy::site),
            FlowColor::density);
  EXPECT_EQ(usualFlowColor(fluidCase(FluidCase::rayleigh_taylor, 64).state, ColorBy::area), FlowColor::none);
  EXPECT_EQ(usualFlowColor(fluidCase(FluidCase::shear, 64).state, ColorBy::site), FlowColor::none);
}

TEST(FluidDocument, FlowsAndComesBackWhenWhatTookItsPlaceIsUndone) {
  Document document(opened());
  const FixedFluid first = document.fluid();
  ASSERT_TRUE(first);
  EXPECT_EQ(document.sites(), first->sites);
  const FixedFluid second = toBegin(fluidCase(FluidCase::shear, 64));
  EXPECT_TRUE(document.flow(first, second));
  EXPECT_FALSE(document.flow(first, second)) << "it has gone on already";
  EXPECT_EQ(document.sites(), second->sites);
  EXPECT_FALSE(document.isAsOpened());
  EXPECT_FALSE(document.canUndo());
  document.open({generate(Pattern::random, 5, 1)});
  EXPECT_FALSE(document.fluid());
  EXPECT_EQ(document.sites()->size(), 5U);
  document.undo();
  EXPECT_EQ(document.fluid(), second);
  document.redo();
  EXPECT_FALSE(document.fluid());
}

TEST(FluidPointer, StirsAndEditsNothing) {
  Document document(opened());
  Camera camera({0, 0, 1, 1}, 104, 104);
  Pointer pointer;
  const FixedFluid before = document.fluid();
  const auto take = [&](const Event& event) { return pointer.take(event, document, camera, 7); };
  EXPECT_EQ(take(Move{{22, 52}}), Changed::nothing);
  EXPECT_EQ(take(Press{}), Changed::nothing);
  EXPECT_EQ(take(Move{{42, 52}}), Changed::stroke);
  EXPECT_NEAR(pointer.stroke().first.x, 0.2, 1e-12);
  EXPECT_NEAR(pointer.stroke().second.x, 0.4, 1e-12);
  EXPECT_NEAR(pointer.stroke().second.y, 0.5, 1e-12);
  EXPECT_EQ(take(Release{}), Changed::nothing);
  EXPECT_EQ(take(Move{{52, 52}}), Changed::nothing);
  EXPECT_EQ(take(Press{}), Changed::nothing);
  EXPECT_EQ(take(Release{}), Changed::nothing) << "a click adds nothing";
  EXPECT_EQ(take(Press{Button::right}), Changed::refused);
  EXPECT_EQ(take(Release{Button::right}), Changed::nothing);
  EXPECT_EQ(take(Scroll{1, {.control = true}}), Changed::refused);
  EXPECT_EQ(take(Press{Button::middle}), Changed::nothing);
  EXPECT_EQ(take(Move{{72, 52}}), Changed::view);
  EXPECT_EQ(take(Release{Button::middle}), Changed::nothing);
  EXPECT_EQ(document.fluid(), before);
  EXPECT_EQ(document.sites(), before->sites);
}

}  // namespace
}  // namespace vorpipe::view

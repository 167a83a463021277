// Fluids in `vorpipe view`, but for its window.
#include "unit/view/app_fixture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "io/cells/fluid_state.h"

namespace vorpipe::view {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class FluidAppTest : public AppTest {
 protected:
  FluidAppTest() { options.viewer.opened = openedFluid(toBegin(fluidCase(FluidCase::shear, 64)), "shear"); }
};

TEST_F(FluidAppTest, FlowsIsStirredAndBeginsAgain) {
  const std::string stirs = "move " + at(0.3, 0.5) + "\npress left\nmove " + at(0.5, 0.5) + "\nmove " +
                            at(0.7, 0.6) + "\nrelease left\n";
  const auto end =
      play("wait\nscreenshot a.png\nkey n\nwait\nscreenshot b.png\nwait 0.1\nwait\nscreenshot c.png\n" +
           stirs + "wait\nkey n\nwait\nscreenshot d.png\n" + "key r\nwait\nscreenshot e.png\nkey n\nwait\n" +
           stirs + "wait\nkey n\nwait\nscreenshot f.png\nkey r\nwait\nkey n\nwait\nkey n\nwait\n" +
           "screenshot g.png\nclose\n");
  ASSERT_TRUE(end) << end.error().message;
  EXPECT_NE(shot("a.png").rgba, shot("b.png").rgba);
  EXPECT_EQ(shot("b.png").rgba, shot("c.png").rgba) << "it pauses";
  EXPECT_EQ(shot("a.png").rgba, shot("e.png").rgba);
  EXPECT_EQ(shot("d.png").rgba, shot("f.png").rgba) << "the same strokes";
  EXPECT_NE(shot("d.png").rgba, shot("g.png").rgba) << "none";
}

TEST_F(FluidAppTest, WithoutAGpuIsDrawnByTheDriverThatTheWindowHasOpen) {
  const auto backendOf = [](const char* name) {
    BackendOptions named;
    named.name = name;
    const auto session = Session::open(named);
    return session ? session->device().backend : std::string();
  };
  const std::string vulkan = backendOf("vulkan");
  if (backendOf("auto") != "cpu" || vulkan.empty()) GTEST_SKIP() << "no software driver alone";
  options.viewer.settings.backend.name = "auto";
  options.viewer.shown_by = "vulkan";
  const auto end = play("wait\nkey c control\nwait\nclose\n");
  ASSERT_TRUE(end) << end.error().message;
  EXPECT_THAT(end->computed_by, StartsWith(vulkan));
  EXPECT_THAT(screen.copied, HasSubstr("--backend " + vulkan));
  // Sites without weights are the processor's, up to the first weight.
  options.viewer.opened = {{{0.25, 0.5, 0.75}, {0.5, 0.5, 0.5}, {}}, {0, 0, 1, 1}};
  const auto plain = play("wait\nclose\n");
  ASSERT_TRUE(plain) << plain.error().message;
  EXPECT_THAT(plain->computed_by, StartsWith("cpu"));
  const auto weighted = play("wait\nmove 200 150\nscroll 1 control\nwait\nclose\n");
  ASSERT_TRUE(weighted) << weighted.error().message;
  EXPECT_THAT(weighted->computed_by, StartsWith(vulkan));
}

TEST_F(FluidAppTest, IsSavedAndGoesOn) {
  const auto end = play(
      "wait\nkey n\nwait\nkey e control shift\nkey e control\nkey s control shift\nwait\nkey c "
      "control\nwait\n"
      "key c control\nwait\nclose\n");
  ASSERT_TRUE(end) << end.error().message;
  for (const char* name : {"fluid.npz", "vorpipe-fluid.npz"}) {
    const auto saved = readFluid(path(name));
    ASSERT_TRUE(saved) << saved.error().message;
    EXPECT_EQ(saved->state.step, 1U);
  }
  EXPECT_THAT(contents(path("sites.csv")), StartsWith("x,y,weight\n"));
  EXPECT_THAT(contents(path("vorpipe.svg")), HasSubstr("<svg"));
  EXPECT_THAT(screen.copied, StartsWith("vorpipe fluid --resume vorpipe-fluid.npz --steps 100 --view"));
  EXPECT_FALSE(std::filesystem::exists(path("vorpipe-fluid-2.npz")));
}

TEST_F(FluidAppTest, IsNotEditedAndComesBack) {
  write("one.csv", "x,y\n0.5,0.5\n");
  const auto end =
      play("wait\nkey n\nwait\nscreenshot a.png\nmove " + at(0.4, 0.4) +
           "\npress left\nrelease left\npress right\nrelease right\nscroll 1 control\nkey z control\n"
           "wait\nscreenshot b.png\ndrop one.csv\nwait\nscreenshot c.png\nkey space\nkey space\nwait\nkey z "
           "control\n"
           "wait\nscreenshot d.png\nkey n\nwait\nscreenshot e.png\nclose\n");
  ASSERT_TRUE(end) << end.error().message;
  EXPECT_EQ(shot("a.png").rgba, shot("b.png").rgba);
  EXPECT_NE(shot("a.png").rgba, shot("c.png").rgba);
  EXPECT_EQ(shot("a.png").rgba, shot("d.png").rgba);
  EXPECT_NE(shot("a.png").rgba, shot("e.png").rgba);
}

TEST_F(FluidAppTest, IsDrawnWhileItRuns) {
  const auto stepped = play("wait\nkey n\nwait\nkey n\nwait\nkey n\nwait\nscreenshot a.png\nclose\n");
  ASSERT_TRUE(stepped) << stepped.error().message;
  options.script.reset();
  options.screenshot = path("b.png");
  options.frames = 3;
  options.viewer.settings.motion = Motion::runs;
  const auto end = run(screen, options);
  ASSERT_TRUE(end) << end.error().message;
  EXPECT_EQ(shot("a.png").rgba, shot("b.png").rgba);
}

TEST_F(AppTest, SaysThatThereIsNoFluid) {
  const auto end =
      play("wait\nscreenshot a.png\nkey r\nkey e control shift\nwait\nscreenshot b.png\nclose\n");
  ASSERT_TRUE(end) << end.error().message;
  EXPECT_EQ(shot("a.png").rgba, shot("b.png").rgba);
  EXPECT_FALSE(std::filesystem::exists(path("fluid.npz")));
}

}  // namespace
}  // namespace vorpipe::view

// What is set and asked for by the panel.
#include "unit/view/panel_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "view/keys.h"

namespace vorpipe::view {
namespace {

TEST_F(PanelTest, SwitchesAreSwitched) {
  const Settings& settings = input_.settings;
  const std::array<std::pair<std::string, const bool*>, 6> switches{{{"Cells", &settings.cells},
                                                                     {"Edges", &settings.picture.edges},
                                                                     {"Sites", &settings.picture.show_sites},
                                                                     {"Dual", &settings.picture.dual},
                                                                     {"Labels", &settings.picture.labels},
                                                                     {"Legend", &settings.picture.legend}}};
  for (const auto& [name, value] : switches) {
    const bool before = *value;
    click(name);
    EXPECT_NE(*value, before) << name;
    click(name);
    EXPECT_EQ(*value, before) << name;
  }
}

TEST_F(PanelTest, SizesFollowTheirSliders) {
  EXPECT_FALSE(panel_.placements().contains("Edge width"));
  click("Edges");
  click("Sites");
  click("Labels");
  for (const std::string name : {"Edge width", "Site size", "Label size"}) click(name);
  const RenderOptions& picture = input_.settings.picture;
  EXPECT_NEAR(picture.edge_width, 5.5, 0.3);
  EXPECT_NEAR(picture.dot_size, 15, 1);
  EXPECT_NEAR(picture.label_size, 22.5, 1);
  // Dragged beyond its end a slider has its last value.
  take(middleOf("Edge width"), true);
  draw();
  panel_.take(Move{{1000, 10}});
  panel_.take(Release{});
  EXPECT_EQ(draw().settings.picture.edge_width, 10);
}

TEST_F(PanelTest, ANumberIsTypedIntoASlider) {
  click("Edges");
  const Position at = middleOf("Edge width");
  panel_.take(Move{at});
  panel_.take(Press{Button::left, {.control = true}});
  panel_.take(Release{});
  EXPECT_TRUE(draw().takes_keys);
  EXPECT_TRUE(panel_.take(Key{"a", {.control = true}}));
  EXPECT_TRUE(panel_.take(Text{"7.5"}));
  EXPECT_TRUE(panel_.take(Key{"enter", {}}));
  const PanelResult result = draw();
  EXPECT_EQ(result.settings.picture.edge_width, 7.5);
  EXPECT_FALSE(result.takes_keys);
}

TEST_F(PanelTest, ColorsAreChosen) {
  click("Color/neighbors");
  EXPECT_EQ(input_.settings.picture.color, ColorBy::neighbors);
  click("Scale/log");
  EXPECT_EQ(input_.settings.picture.color_scale, ColorScale::log);
  click("Antialias/4\u00d74");
  EXPECT_EQ(input_.settings.picture.antialias, 4);
  for (const std::string& name : colormaps()) {
    click("Colormap");
    EXPECT_TRUE(panel_.take(Move{{900, 500}})) << "an open list keeps the pointer";
    click("Colormap/" + name);
    EXPECT_EQ(input_.settings.picture.colormap, name);
  }
  click("Colormap");
  EXPECT_TRUE(take({900, 500}, true)) << "this closes the list, and is no click beside the panel";
  EXPECT_TRUE(take({900, 500}, false));
  EXPECT_FALSE(draw().takes_pointer);
}

TEST_F(PanelTest, ColorsBySiteHaveNeitherScaleNorLegend) {
  click("Legend");
  click("Scale/linear");
  click("Color/site");
  const RenderOptions& picture = input_.settings.picture;
  EXPECT_EQ(picture.color, ColorBy::site);
  EXPECT_EQ(picture.color_scale, ColorScale::automatic);
  EXPECT_FALSE(picture.legend);
  click("Legend");
  EXPECT_FALSE(picture.legend);
  click("Scale/log");
  EXPECT_EQ(picture.color_scale, ColorScale::automatic);
}

TEST_F(PanelTest, ButtonsAskForActions) {
  input_.can_undo = true;
  const std::array<std::pair<std::string, Action>, 8> buttons{{{"Undo", Action::undo},
                                                               {"Fit", Action::fit},
                                                               {"Run", Action::run},
                                                               {"Step", Action::step},
                                                               {"PNG", Action::save_png},
                                                               {"SVG", Action::save_svg},
                                                               {"Save sites", Action::save_sites},
                                                               {"Copy command", Action::copy_command}}};
  for (const auto& [name, action] : buttons) EXPECT_EQ(click(name).actions, std::vector{action}) << name;
  EXPECT_TRUE(click("Redo").actions.empty()) << "there is nothing to redo";
  input_.settings.motion = Motion::runs;
  EXPECT_EQ(click("Run").actions, std::vector{Action::pause});
  EXPECT_TRUE(click("Step").actions.empty());
  EXPECT_TRUE(draw().actions.empty()) << "once alone";
}

TEST_F(PanelTest, SeveralClicksOfOneFrameAllCount) {
  for (const char* name : {"Fit", "Step", "Fit"}) {
    take(middleOf(name), true);
    take(middleOf(name), false);
  }
  EXPECT_EQ(draw().actions, (std::vector{Action::fit, Action::step, Action::fit}));
}

TEST_F(PanelTest, RelaxingIsSetUpAndTold) {
  click("Method/Lloyd");
  EXPECT_EQ(input_.settings.method, RelaxMethod::lloyd);
  click("Method/L-BFGS");
  EXPECT_EQ(input_.settings.method, RelaxMethod::lbfgs);
  const std::size_t without = triangles_.vertices.size();
  for (std::uint64_t i = 0; i < 5; ++i) {
    input_.relaxed = RelaxStep{.diagram = i, .energy = 1, .hexagonal = 1.2 - 0.01 * static_cast<double>(i)};
    draw();
  }
  EXPECT_GT(triangles_.vertices.size(), without);
  // With weights there is no lattice to compare with.
  const std::size_t compared = triangles_.vertices.size();
  input_.relaxed->hexagonal = std::nan("");
  input_.relaxed->energy = 0.0123456;
  draw();
  EXPECT_GT(triangles_.vertices.size(), compared);
  input_.settings.density = {1, 1, {1}};
  input_.settings.density_path = "/pictures/a picture with a name that is longer than the panel is wide.png";
  draw();
  click("No density");
  EXPECT_TRUE(input_.settings.density_path.empty());
  EXPECT_TRUE(input_.settings.density.values.empty());
}

TEST_F(PanelTest, BackendsAreChosenButThoseThatCannotBeUsed) {
  const BackendOptions& backend = input_.settings.backend;
  const auto choose = [&](const std::string& name) {
    click("Backend");
    click(name);
  };
  choose("Backend/cpu");
  EXPECT_EQ(backend.name, "cpu");
  EXPECT_EQ(backend.device, "") << "it has no other";
  choose("Backend/opengl");
  EXPECT_EQ(backend.name, "cpu");
  panel_.take(Move{{900, 500}});
  take({900, 500}, true);
  take({900, 500}, false);
  draw();
  choose("Backend/vulkan-geometry/Radeon 2");
  EXPECT_EQ(backend.name, "vulkan-geometry");
  EXPECT_EQ(backend.device, "Radeon 2");
  choose("Backend/auto");
  EXPECT_EQ(backend.name, "auto");
  EXPECT_EQ(backend.device, "");
}

TEST_F(PanelTest, ABackendIsComparedWith) {
  click("Compare");
  click("Compare/cpu");
  ASSERT_TRUE(input_.settings.compared);
  EXPECT_EQ(input_.settings.compared->name, "cpu");
  const std::size_t without = triangles_.vertices.size();
  input_.compared = Compared{12, 1280 * 1000, "cpu on 2 threads"};
  draw();
  EXPECT_GT(triangles_.vertices.size(), without) << "there is no line";
  click("Compare");
  click("Compare/none");
  EXPECT_FALSE(input_.settings.compared);
}

TEST_F(PanelTest, AFluidIsBegunAndChanged) {
  EXPECT_FALSE(panel_.placements().contains("Brush"));
  click("Case");
  EXPECT_EQ(click("Case/dam-break").begins, FluidCase::dam_break);
  input_.fluid = FluidShown{"rayleigh-taylor", fluidCase(FluidCase::rayleigh_taylor, 64).options};
  draw();
  EXPECT_FALSE(panel_.placements().contains("Method")) << "it does not relax";
  EXPECT_EQ(click("Run").actions, std::vector{Action::run});
  EXPECT_EQ(click("Step").actions, std::vector{Action::step});
  EXPECT_EQ(click("Begin again").actions, std::vector{Action::begin_again});
  EXPECT_EQ(click("Scheme/springs").flows_by->scheme, FluidScheme::springs);
  EXPECT_FALSE(click("Scheme/projection").flows_by) << "it is so by default";
  EXPECT_NEAR(click("Gravity").flows_by->gravity.y, 0, 0.5);
  click("Brush");
  EXPECT_NEAR(input_.settings.brush.radius, 0.25, 0.03);
  click("Push");
  EXPECT_NEAR(input_.settings.brush.push, 2.5, 0.3);
  EXPECT_EQ(click("Parcels/512").begins, FluidCase::rayleigh_taylor);
  EXPECT_EQ(input_.settings.parcels, 512U);
  click("Flow/speed");
  EXPECT_EQ(input_.settings.flow_color, FlowColor::speed);
  click("Color/area");
  EXPECT_EQ(input_.settings.flow_color, FlowColor::none);
  input_.fluid->options.surface = Surface::free;
  EXPECT_FALSE(click("Scheme/projection").flows_by) << "it has a free surface";
}

}  // namespace
}  // namespace vorpipe::view

#include "view/panel/panel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "view/document/keys.h"

namespace vorpipe::view {
namespace {

DeviceInfo device(const std::string& backend, const std::string& name, const std::string& reason = "") {
  DeviceInfo info;
  info.backend = backend;
  info.name = name;
  info.usable = reason.empty();
  info.reason = reason;
  return info;
}

/// A panel, in front of what a window would be.
class PanelTest : public ::testing::Test {
 protected:
  PanelTest() {
    input_.width = 1280;
    input_.height = 1000;
    input_.settings.picture.color = ColorBy::area;
    input_.devices = {device("vulkan-compute", "llvmpipe"), device("opengl", "", "libEGL.so.1 is missing"),
                      device("vulkan-geometry", "Radeon 1"), device("vulkan-geometry", "Radeon 2"),
                      device("cpu", "2 threads")};
    input_.sites = 1234;
    input_.keys = {{"E", "edges"}, {"?", "this list"}};
    draw();
  }

  PanelAnswer draw() {
    PanelAnswer answer = panel_.draw(input_, triangles_);
    expectSound();
    return answer;
  }

  /// Indices within vertices, parts within indices and the window, texture coordinates within the texture.
  void expectSound() const {
    std::size_t next = 0;
    for (const PanelPart& part : triangles_.parts) {
      EXPECT_EQ(part.first_index, next);
      EXPECT_EQ(part.indices % 3, 0U);
      EXPECT_GT(part.indices, 0U);
      next += part.indices;
      EXPECT_TRUE(0 <= part.left && part.left < part.right && part.right <= input_.width);
      EXPECT_TRUE(0 <= part.top && part.top < part.bottom && part.bottom <= input_.height);
    }
    EXPECT_EQ(next, triangles_.indices.size());
    for (const std::uint32_t index : triangles_.indices) ASSERT_LT(index, triangles_.vertices.size());
    for (const PanelVertex& vertex : triangles_.vertices) {
      EXPECT_TRUE(vertex.u >= 0 && vertex.u <= 1 && vertex.v >= 0 && vertex.v <= 1);
    }
  }

  [[nodiscard]] Place middleOf(const std::string& name) const {
    const auto found = panel_.places().find(name);
    EXPECT_NE(found, panel_.places().end()) << name;
    if (found == panel_.places().end()) return {-1, -1};
    const Placement& at = found->second;
    return {at.left + at.width / 2, at.top + at.height / 2};
  }

  bool take(Place to, bool press) {
    panel_.take(Move{to});
    return press ? panel_.take(Press{}) : panel_.take(Release{});
  }

  /// Presses and lets go in the middle of what has a name; what changes is what the next frame begins with.
  PanelAnswer click(const std::string& name) {
    const Place at = middleOf(name);
    EXPECT_TRUE(take(at, true)) << name;
    EXPECT_TRUE(take(at, false)) << name;
    PanelAnswer answer = draw();
    input_.settings = answer.settings;
    return answer;
  }

  Panel panel_;
  PanelInput input_;
  PanelTriangles triangles_;
};

TEST_F(PanelTest, TheTextureHasLettersAndWhite) {
  const PanelTexture& texture = panel_.texture();
  ASSERT_EQ(texture.alpha.size(),
            static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height));
  EXPECT_EQ(*std::max_element(texture.alpha.begin(), texture.alpha.end()), 255);
  EXPECT_EQ(*std::min_element(texture.alpha.begin(), texture.alpha.end()), 0);
}

TEST_F(PanelTest, ThePointerIsThePanelsOverItAlone) {
  EXPECT_TRUE(panel_.take(Move{middleOf("Show")}));
  EXPECT_TRUE(panel_.take(Scroll{1}));
  EXPECT_TRUE(draw().takes_pointer);
  EXPECT_FALSE(panel_.take(Move{{900, 500}}));
  EXPECT_FALSE(panel_.take(Scroll{1}));
  EXPECT_FALSE(draw().takes_pointer);
  // What begins beside the panel stays the window's over it, and the other way round.
  EXPECT_FALSE(take({900, 500}, true));
  EXPECT_FALSE(take(middleOf("Edges"), false));
  EXPECT_FALSE(draw().settings.picture.edges);
  EXPECT_TRUE(take(middleOf("Edges"), true));
  EXPECT_TRUE(panel_.take(Move{{900, 500}}));
  EXPECT_TRUE(draw().takes_pointer);
  EXPECT_TRUE(panel_.take(Release{}));
  EXPECT_FALSE(draw().settings.picture.edges);
}

TEST_F(PanelTest, KeysAreTheWindows) {
  draw();
  EXPECT_FALSE(panel_.take(Key{"e", {}}));
  EXPECT_FALSE(panel_.take(Text{"e"}));
  EXPECT_FALSE(draw().takes_keys);
}

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
  EXPECT_FALSE(panel_.places().contains("Edge width"));
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
  const Place at = middleOf("Edge width");
  panel_.take(Move{at});
  panel_.take(Press{Button::left, {.control = true}});
  panel_.take(Release{});
  EXPECT_TRUE(draw().takes_keys);
  EXPECT_TRUE(panel_.take(Key{"a", {.control = true}}));
  EXPECT_TRUE(panel_.take(Text{"7.5"}));
  EXPECT_TRUE(panel_.take(Key{"enter", {}}));
  const PanelAnswer answer = draw();
  EXPECT_EQ(answer.settings.picture.edge_width, 7.5);
  EXPECT_FALSE(answer.takes_keys);
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

TEST_F(PanelTest, ReasonsAreTold) {
  click("Backend");
  panel_.take(Move{middleOf("Backend/cpu")});
  draw();
  const std::size_t without = triangles_.parts.size();
  panel_.take(Move{middleOf("Backend/opengl")});
  draw();
  EXPECT_GT(triangles_.parts.size(), without);
}

TEST_F(PanelTest, HiddenItIsNotThereButForMessages) {
  click("Hide");
  EXPECT_FALSE(input_.settings.panel);
  input_.hovered = Hovered{};
  EXPECT_FALSE(draw().takes_pointer);
  EXPECT_TRUE(triangles_.vertices.empty() && triangles_.indices.empty() && triangles_.parts.empty());
  EXPECT_TRUE(panel_.places().empty());
  EXPECT_FALSE(take({100, 100}, true));
  EXPECT_FALSE(take({100, 100}, false));
  input_.message = "Saved.";
  EXPECT_FALSE(draw().takes_pointer);
  EXPECT_FALSE(triangles_.parts.empty());
  const Place at = middleOf("Message");
  EXPECT_NEAR(at.x, 640, 1);
  EXPECT_GT(at.y, 950);
  EXPECT_FALSE(panel_.take(Move{at})) << "a message is no obstacle";
}

TEST_F(PanelTest, HelpOpensAndCloses) {
  click("Help");
  EXPECT_TRUE(input_.settings.help);
  EXPECT_TRUE(panel_.take(Move{{780, 500}}));
  click("Close help");
  EXPECT_FALSE(input_.settings.help);
  draw();
  EXPECT_FALSE(panel_.take(Move{{780, 500}}));
}

TEST_F(PanelTest, EscapeClosesWhatIsOpen) {
  const Key escape{"escape", {}};
  EXPECT_FALSE(panel_.take(escape)) << "it is the window's";
  draw();
  click("Help");
  click("Colormap");
  EXPECT_TRUE(panel_.places().contains("Colormap/viridis"));
  EXPECT_TRUE(panel_.take(escape));
  EXPECT_TRUE(draw().settings.help);
  EXPECT_FALSE(panel_.places().contains("Colormap/viridis"));
  EXPECT_TRUE(panel_.take(escape));
  input_.settings = draw().settings;
  EXPECT_FALSE(input_.settings.help);
  EXPECT_FALSE(panel_.take(escape));
}

TEST_F(PanelTest, GroupsClose) {
  const double height = panel_.places().at("Panel").height;
  click("Show");
  EXPECT_FALSE(panel_.places().contains("Edges"));
  EXPECT_LT(panel_.places().at("Panel").height, height);
  click("Show");
  EXPECT_TRUE(panel_.places().contains("Edges"));
  EXPECT_EQ(panel_.places().at("Panel").height, height);
}

TEST_F(PanelTest, TheCellIsToldBesideThePointer) {
  input_.hovered = Hovered{7, {0.25, 0.5}, 0.5, 0.125, 6};
  panel_.take(Move{{900, 500}});
  draw();
  const auto there = [&] {
    return std::any_of(triangles_.vertices.begin(), triangles_.vertices.end(),
                       [](const PanelVertex& at) { return at.x > 890 && at.x < 1100 && at.y > 490; });
  };
  EXPECT_TRUE(there());
  // In the corner of the window it stays inside.
  panel_.take(Move{{1279, 999}});
  draw();
  for (const PanelVertex& at : triangles_.vertices) EXPECT_TRUE(at.x < 1282 && at.y < 1002);
  input_.hovered.reset();
  panel_.take(Move{{900, 500}});
  draw();
  EXPECT_FALSE(there());
}

TEST_F(PanelTest, ItIsMovedAndStaysAtItsEdge) {
  const auto left = [&] { return panel_.places().at("Panel").left; };
  EXPECT_EQ(left(), 10);
  click("Other side");
  EXPECT_EQ(left(), 1280 - 284 - 10);
  input_.width = 800;
  draw();
  EXPECT_EQ(left(), 800 - 284 - 10);
  click("Other side");
  EXPECT_EQ(left(), 10);
  // By its name, where nothing is to be pressed.
  const Place at{left() + 20, panel_.places().at("Panel").top + 20};
  const auto drag = [&](Place from, double by) {
    EXPECT_TRUE(take(from, true));
    EXPECT_TRUE(panel_.take(Move{{from.x + by, from.y}}));
    EXPECT_TRUE(take({from.x + by, from.y}, false));
    draw();
  };
  drag(at, 200);
  EXPECT_EQ(left(), 210);
  draw();
  EXPECT_EQ(left(), 210);
  drag({at.x + 200, at.y}, 290);
  EXPECT_EQ(left(), 800 - 284 - 10) << "near the edge it is at the edge";
}

TEST_F(PanelTest, ItTellsWhatItCoversUnlessItIsHeld) {
  EXPECT_EQ(draw().covers, (std::pair{294.0, 0.0}));
  EXPECT_EQ(click("Other side").covers, (std::pair{0.0, 294.0}));
  const Placement at = panel_.places().at("Panel");
  take({at.left + 20, at.top + 20}, true);
  EXPECT_FALSE(draw().covers);
  take({at.left + 20, at.top + 20}, false);
  EXPECT_TRUE(draw().covers);
  input_.settings.panel = false;
  EXPECT_EQ(draw().covers, (std::pair{0.0, 0.0}));
}

TEST_F(PanelTest, ItEndsAboveALegend) {
  input_.height = 720;
  draw();
  input_.legend = Placement{6, 480, 120, 234};
  draw();
  const auto bottom = [&] { return panel_.places().at("Panel").top + panel_.places().at("Panel").height; };
  EXPECT_LE(bottom(), 480);
  EXPECT_GT(bottom(), 400);
  click("Other side");
  EXPECT_GT(bottom(), 480) << "there the legend is seen";
}

TEST_F(PanelTest, TheListOfKeysFitsIntoTheUsualWindow) {
  input_.height = 720;
  input_.keys.clear();
  for (const HelpLine& line : helpLines()) input_.keys.emplace_back(line.keys, line.what);
  input_.settings.help = true;
  draw();
  const Placement list = panel_.places().at("Keys");
  const Placement last = panel_.places().at("Keys/" + input_.keys.back().first);
  EXPECT_GE(list.top, 0);
  EXPECT_LT(last.top + last.height, list.top + list.height);
}

TEST_F(PanelTest, ASmallWindowScrolls) {
  input_.width = 320;
  input_.height = 200;
  draw();
  EXPECT_LE(panel_.places().at("Panel").height, 180);
  const double before = panel_.places().at("Show").top;
  panel_.take(Move{{100, 100}});
  EXPECT_TRUE(panel_.take(Scroll{-2}));
  draw();
  EXPECT_LT(panel_.places().at("Show").top, before);
  // Of the smallest, and of a minimized one, something sound.
  for (const int size : {1, 0}) {
    input_.width = input_.height = size;
    input_.message = "x";
    input_.settings.help = true;
    draw();
  }
}

TEST_F(PanelTest, AnotherScaleHasOtherLetters) {
  const int before = panel_.texture().width * panel_.texture().height;
  EXPECT_FALSE(draw().new_texture);
  input_.scale = 2;
  EXPECT_TRUE(draw().new_texture);
  EXPECT_GT(panel_.texture().width * panel_.texture().height, before);
  EXPECT_EQ(panel_.places().at("Panel").width, 2 * 284);
  EXPECT_FALSE(draw().new_texture);
  click("Edges");
  EXPECT_TRUE(input_.settings.picture.edges);
}

TEST_F(PanelTest, TheSameIsDrawnAlike) {
  input_.times.history = {1, 30, 200, 0};
  input_.times.frame = 20;
  draw();
  const PanelTriangles before = triangles_;
  draw();
  EXPECT_EQ(before.indices, triangles_.indices);
  ASSERT_EQ(before.vertices.size(), triangles_.vertices.size());
  for (std::size_t i = 0; i < before.vertices.size(); ++i) {
    EXPECT_EQ(before.vertices[i].x, triangles_.vertices[i].x);
    EXPECT_EQ(before.vertices[i].y, triangles_.vertices[i].y);
    EXPECT_EQ(before.vertices[i].rgba, triangles_.vertices[i].rgba);
  }
}

TEST_F(PanelTest, AFluidIsBegunAndChanged) {
  EXPECT_FALSE(panel_.places().contains("Brush"));
  click("Case");
  EXPECT_EQ(click("Case/dam-break").begins, FluidCase::dam_break);
  input_.fluid = FluidShown{"rayleigh-taylor", fluidCase(FluidCase::rayleigh_taylor, 64).options};
  draw();
  EXPECT_FALSE(panel_.places().contains("Method")) << "it does not relax";
  EXPECT_EQ(click("Run").actions, std::vector{Action::run});
  EXPECT_EQ(click("Step").actions, std::vector{Action::step});
  EXPECT_EQ(click("Begin again").actions, std::vector{Action::begin_again});
  EXPECT_EQ(click("Scheme/projection").flows_by->scheme, FluidScheme::projection);
  EXPECT_FALSE(click("Scheme/springs").flows_by);
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

TEST_F(PanelTest, TheBrushIsSeenBesideThePanelAlone) {
  input_.fluid = FluidShown{"shear", fluidCase(FluidCase::shear, 64).options};
  draw();
  panel_.take(Move{{900, 500}});
  draw();
  const std::size_t without = triangles_.indices.size();
  input_.fluid->brush = BrushShown{{900, 500}, 40};
  draw();
  EXPECT_GT(triangles_.indices.size(), without);
  panel_.take(Move{middleOf("Show")});
  draw();
  const std::size_t over_panel = triangles_.indices.size();
  input_.fluid->brush.reset();
  draw();
  EXPECT_EQ(triangles_.indices.size(), over_panel);
}

}  // namespace
}  // namespace vorpipe::view

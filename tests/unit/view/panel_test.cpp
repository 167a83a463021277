// Where the panel is and what it shows: places, windows, messages.
#include "unit/view/panel_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "view/keys.h"

namespace vorpipe::view {
namespace {

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
  EXPECT_TRUE(panel_.placements().empty());
  EXPECT_FALSE(take({100, 100}, true));
  EXPECT_FALSE(take({100, 100}, false));
  input_.message = "Saved.";
  EXPECT_FALSE(draw().takes_pointer);
  EXPECT_FALSE(triangles_.parts.empty());
  const Position at = middleOf("Message");
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
  EXPECT_TRUE(panel_.placements().contains("Colormap/viridis"));
  EXPECT_TRUE(panel_.take(escape));
  EXPECT_TRUE(draw().settings.help);
  EXPECT_FALSE(panel_.placements().contains("Colormap/viridis"));
  EXPECT_TRUE(panel_.take(escape));
  input_.settings = draw().settings;
  EXPECT_FALSE(input_.settings.help);
  EXPECT_FALSE(panel_.take(escape));
}

TEST_F(PanelTest, GroupsClose) {
  const double height = panel_.placements().at("Panel").height;
  click("Show");
  EXPECT_FALSE(panel_.placements().contains("Edges"));
  EXPECT_LT(panel_.placements().at("Panel").height, height);
  click("Show");
  EXPECT_TRUE(panel_.placements().contains("Edges"));
  EXPECT_EQ(panel_.placements().at("Panel").height, height);
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

TEST_F(PanelTest, TheCellUnderThePointerHasALineAroundIt) {
  input_.hovered = Hovered{7, {0.25, 0.5}, 0.5, 0.125, 6, {{500, 300}, {600, 300}, {600, 400}}};
  panel_.take(Move{{900, 800}});
  draw();
  const auto there = [&] {
    return std::any_of(triangles_.vertices.begin(), triangles_.vertices.end(), [](const PanelVertex& at) {
      return std::abs(at.x - 600) < 5 && std::abs(at.y - 300) < 5;
    });
  };
  EXPECT_TRUE(there());
  input_.hovered.reset();
  draw();
  EXPECT_FALSE(there());
}

TEST_F(PanelTest, TheHintFadesAndAMessageTakesItsPlace) {
  const auto alpha = [&] {
    unsigned most = 0;
    for (const PanelVertex& at : triangles_.vertices) {
      if (at.y > 900 && at.x > 400) most = std::max(most, static_cast<unsigned>(at.rgba >> 24));
    }
    return most;
  };
  input_.hint = "Click somewhere";
  draw();
  const unsigned whole = alpha();
  input_.hint_shows = 0.5;
  draw();
  EXPECT_GT(alpha(), 0u);
  EXPECT_LT(alpha(), whole);
  input_.hint_shows = 0;
  draw();
  EXPECT_FALSE(panel_.placements().contains("Message"));
  EXPECT_EQ(alpha(), 0u);
  input_.message = "Saved it";
  draw();
  EXPECT_EQ(alpha(), whole);
}

TEST_F(PanelTest, ItIsMovedAndStaysAtItsEdge) {
  const auto left = [&] { return panel_.placements().at("Panel").left; };
  EXPECT_EQ(left(), 10);
  click("Other side");
  EXPECT_EQ(left(), 1280 - 284 - 10);
  input_.width = 800;
  draw();
  EXPECT_EQ(left(), 800 - 284 - 10);
  click("Other side");
  EXPECT_EQ(left(), 10);
  // By its name, where nothing is to be pressed.
  const Position at{left() + 20, panel_.placements().at("Panel").top + 20};
  const auto drag = [&](Position from, double by) {
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
  const Placement at = panel_.placements().at("Panel");
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
  const auto bottom = [&] {
    return panel_.placements().at("Panel").top + panel_.placements().at("Panel").height;
  };
  EXPECT_LE(bottom(), 480);
  EXPECT_GT(bottom(), 400);
  click("Other side");
  EXPECT_GT(bottom(), 480) << "there the legend is seen";
}

TEST_F(PanelTest, TheListOfKeysFitsIntoTheUsualWindow) {
  input_.height = 720;
  input_.keys = helpLines();
  input_.settings.help = true;
  draw();
  const Placement list = panel_.placements().at("Keys");
  const Placement last = panel_.placements().at("Keys/" + input_.keys.back().first);
  EXPECT_GE(list.top, 0);
  EXPECT_LT(last.top + last.height, list.top + list.height);
}

TEST_F(PanelTest, ASmallWindowScrolls) {
  input_.width = 320;
  input_.height = 200;
  draw();
  EXPECT_LE(panel_.placements().at("Panel").height, 180);
  const double before = panel_.placements().at("Show").top;
  panel_.take(Move{{100, 100}});
  EXPECT_TRUE(panel_.take(Scroll{-2}));
  draw();
  EXPECT_LT(panel_.placements().at("Show").top, before);
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
  EXPECT_EQ(panel_.placements().at("Panel").width, 2 * 284);
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
  EXPECT_TRUE(before == triangles_);
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

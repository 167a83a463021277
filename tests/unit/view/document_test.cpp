#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "io/base/quoted.h"
#include "io/sites/outline_file.h"
#include "io/sites/sites_file.h"
#include "unit/fixtures/temporary_directory.h"
#include "view/camera.h"
#include "view/command.h"
#include "view/document.h"
#include "view/keys.h"
#include "view/pointer.h"
#include "view/script.h"

namespace vorpipe::view {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Opened threeSites() {
  return {
      {{0.25, 0.5, 0.75}, {0.5, 0.5, 0.5}, {}}, {0, 0, 1, 1}, {}, Periodic::none, {"--sites", "three.csv"}};
}

TEST(Document, UndoesAndDoesAgain) {
  Document document(threeSites());
  EXPECT_FALSE(document.canUndo());
  EXPECT_EQ(document.add({0.1, 0.2}), 3U);
  document.remove(0);
  EXPECT_THAT(document.sites()->x, ElementsAre(0.5, 0.75, 0.1));
  EXPECT_FALSE(document.isAsOpened());
  document.undo();
  EXPECT_THAT(document.sites()->x, ElementsAre(0.25, 0.5, 0.75, 0.1));
  document.undo();
  EXPECT_THAT(document.sites()->x, ElementsAre(0.25, 0.5, 0.75));
  EXPECT_TRUE(document.isAsOpened());
  EXPECT_FALSE(document.canUndo());
  document.redo();
  document.redo();
  EXPECT_THAT(document.sites()->x, ElementsAre(0.5, 0.75, 0.1));
  EXPECT_FALSE(document.canRedo());
  document.undo();
  document.move(1, {0, 0});
  EXPECT_FALSE(document.canRedo());
}

TEST(Document, TakesADragAsOneEdit) {
  Document document(threeSites());
  document.move(1, {0.5, 0.6});
  document.move(1, {0.5, 0.7});
  document.settle();
  document.move(1, {0.5, 0.8});
  document.move(2, {0.9, 0.9});
  document.undo();
  EXPECT_EQ(document.position(1), (Point{0.5, 0.8}));
  document.undo();
  EXPECT_EQ(document.position(1), (Point{0.5, 0.7}));
  document.undo();
  EXPECT_EQ(document.position(1), (Point{0.5, 0.5}));
  EXPECT_FALSE(document.canUndo());
  document.redo();
  EXPECT_EQ(document.position(1), (Point{0.5, 0.7}));
}

TEST(Document, TakesWeightsBackToNone) {
  Document document(threeSites());
  document.addWeight(2, 0.5);
  document.addWeight(2, 0.25);
  document.addWeight(0, 1);
  EXPECT_THAT(document.sites()->weight, ElementsAre(1, 0, 0.75));
  document.undo();
  EXPECT_THAT(document.sites()->weight, ElementsAre(0, 0, 0.75));
  document.undo();
  EXPECT_THAT(document.sites()->weight, IsEmpty());
  document.redo();
  EXPECT_THAT(document.sites()->weight, ElementsAre(0, 0, 0.75));
  document.remove(2);
  document.undo();
  EXPECT_THAT(document.sites()->weight, ElementsAre(0, 0, 0.75));
}

TEST(Document, LosesItsLastSite) {
  Opened one{{{0.5}, {0.5}, {2}}};
  Document document(one);
  document.remove(0);
  EXPECT_EQ(document.sites()->size(), 0U);
  document.undo();
  EXPECT_THAT(document.sites()->weight, ElementsAre(2));
}

TEST(Document, TakesARelaxationAsOneEdit) {
  Document document(threeSites());
  const FixedSites begin = document.sites();
  const auto first = std::make_shared<const Sites>(Sites{{0, 1, 2}, {0, 0, 0}, {}});
  const auto second = std::make_shared<const Sites>(Sites{{3, 4, 5}, {0, 0, 0}, {}});
  EXPECT_TRUE(document.relax(begin, first));
  EXPECT_FALSE(document.relax(begin, second));
  EXPECT_TRUE(document.relax(first, second));
  document.undo();
  EXPECT_EQ(document.sites(), begin);
  document.redo();
  EXPECT_EQ(document.sites(), second);
}

TEST(Document, OpensAndComesBack) {
  Document document(threeSites());
  document.add({0.1, 0.1});
  document.open({{{5}, {5}, {}}, {0, 0, 10, 10}, {}, Periodic::xy, {"--sites", "one.csv"}});
  EXPECT_TRUE(document.isAsOpened());
  EXPECT_EQ(document.opened().periodic, Periodic::xy);
  EXPECT_EQ(document.inDomain({-1, 21}), (Point{9, 1}));
  document.undo();
  EXPECT_FALSE(document.isAsOpened());
  EXPECT_EQ(document.sites()->size(), 4U);
  EXPECT_EQ(document.inDomain({-1, 21}), (Point{-1, 21}));
}

TEST(Camera, ShowsAllOfTheDomainWithTheWindowsAspect) {
  Camera camera({0, 0, 2, 1}, 800, 200);
  const Box view = camera.view();
  EXPECT_LT(view.ymin, 0);
  EXPECT_GT(view.ymax, 1);
  EXPECT_NEAR((view.xmax - view.xmin) / (view.ymax - view.ymin), 4, 1e-12);
  camera.resize(200, 800);
  EXPECT_LT(camera.view().xmin, 0);
  EXPECT_NEAR(camera.view().ymax - camera.view().ymin, 4 * (camera.view().xmax - camera.view().xmin), 1e-12);
}

TEST(Camera, FitsADomainBesideThePanel) {
  const Box wide{-1, 0, 3, 1}, square{0, 0, 1, 1};
  for (const auto& [left, right] : {std::pair{294.0, 0.0}, {0.0, 294.0}, {100.0, 200.0}}) {
    Camera camera(wide, 1280, 720);
    camera.setCovered(left, right);
    EXPECT_GE(camera.positionOf({wide.xmin, 0}).x, left);
    EXPECT_LE(camera.positionOf({wide.xmax, 0}).x, 1280 - right);
    EXPECT_NEAR(camera.positionOf({wide.xmax, 0}).x - camera.positionOf({wide.xmin, 0}).x,
                (1280 - left - right) / 1.04, 1e-9);
    // What is beside it anyway stays in the middle; else it goes no farther than it has to.
    camera.setDomain({0, 0, 1, 2});
    EXPECT_NEAR(camera.positionOf({0.5, 0.5}).x, 640, 1e-9);
    camera.setDomain(square);
    EXPECT_NEAR(camera.positionOf({0.5, 0.5}).x, 640, 14 + 1e-9);
    camera.resize(1000, 720);
    EXPECT_GE(camera.positionOf({0, 0}).x, left);
    EXPECT_LE(camera.positionOf({1, 0}).x, 1000 - right);
    EXPECT_NEAR(camera.positionOf({1, 0}).x - camera.positionOf({0, 0}).x,
                std::min((1000 - left - right), 720.0) / 1.04, 1e-9);
    // Half of a window is the least that is used.
    camera.resize(500, 720);
    EXPECT_NEAR(camera.positionOf({0.5, 0.5}).x, 250, 1e-9);
    camera.resize(1280, 720);
    camera.setCovered(0, 0);
    EXPECT_NEAR(camera.positionOf({0.5, 0.5}).x, 640, 1e-9);
    camera.pan(10, 0);
    camera.setCovered(left, right);
    EXPECT_NEAR(camera.positionOf({0.5, 0.5}).x, 650, 1e-9) << "what was moved by hand stays";
  }
}

TEST(Camera, ZoomsToThePointerAndPans) {
  Camera camera({0, 0, 1, 1}, 400, 400);
  const Position pointer{100, 50};
  const Point before = camera.pointAt(pointer);
  const double scale = camera.unitsPerPixel();
  camera.zoom(pointer, 8);
  EXPECT_NEAR(camera.pointAt(pointer).x, before.x, 1e-15);
  EXPECT_NEAR(camera.pointAt(pointer).y, before.y, 1e-15);
  EXPECT_DOUBLE_EQ(camera.unitsPerPixel(), scale / 8);
  const Box zoomed = camera.view();
  camera.pan(10, -20);
  EXPECT_NEAR(camera.pointAt({110, 30}).x, before.x, 1e-15);
  EXPECT_NEAR(camera.pointAt({110, 30}).y, before.y, 1e-15);
  const Placement stands = camera.placementOf(zoomed);
  EXPECT_NEAR(stands.left, 10, 1e-9);
  EXPECT_NEAR(stands.top, -20, 1e-9);
  EXPECT_NEAR(stands.width, 400, 1e-9);
  const Placement whole = camera.placementOf(camera.view());
  EXPECT_EQ(std::tuple(whole.left, whole.top, whole.width, whole.height), std::tuple(0, 0, 400, 400));
  camera.resize(300, 200);
  EXPECT_DOUBLE_EQ(camera.unitsPerPixel(), scale / 8);
  camera.zoom(pointer, 1e300);
  EXPECT_GT(camera.view().xmax, camera.view().xmin);
  camera.zoom(pointer, 1e-300);
  EXPECT_DOUBLE_EQ(camera.unitsPerPixel(), 1);
}

class Pointing : public ::testing::Test {
 protected:
  Document document{threeSites()};
  Camera camera{{0, 0, 1, 1}, 400, 400};
  Pointer pointer;
  std::uint32_t owner = no_site;

  Position at(Point point) const { return camera.positionOf(point); }
  Changed take(const Event& event) { return pointer.take(event, document, camera, owner); }
};

TEST_F(Pointing, ClickAddsASiteWhereThereIsNone) {
  take(Move{at({0.1, 0.9})});
  EXPECT_EQ(take(Press{}), Changed::nothing);
  EXPECT_EQ(take(Release{}), Changed::sites);
  ASSERT_EQ(document.sites()->size(), 4U);
  EXPECT_NEAR(document.position(3).x, 0.1, 1e-12);
  EXPECT_NEAR(document.position(3).y, 0.9, 1e-12);
  take(Press{});
  EXPECT_EQ(take(Release{}), Changed::nothing);
  EXPECT_EQ(document.sites()->size(), 4U);
  take(Move{{1, 1}});
  take(Press{});
  EXPECT_EQ(take(Release{}), Changed::nothing) << "beyond the domain";
}

TEST_F(Pointing, DragMovesASite) {
  const Position start = at({0.5, 0.5});
  take(Move{{start.x + 4, start.y}});
  take(Press{});
  EXPECT_EQ(take(Move{{start.x + 5, start.y}}), Changed::nothing);
  const Position end = at({0.6, 0.3});
  EXPECT_EQ(take(Move{{end.x + 4, end.y}}), Changed::drag);
  EXPECT_EQ(take(Release{}), Changed::sites);
  EXPECT_NEAR(document.position(1).x, 0.6, 1e-12);
  EXPECT_NEAR(document.position(1).y, 0.3, 1e-12);
  document.undo();
  EXPECT_EQ(document.position(1), (Point{0.5, 0.5}));
}

TEST_F(Pointing, DragElsewherePans) {
  const Point grabbed{0.1, 0.1};
  take(Move{at(grabbed)});
  take(Press{});
  EXPECT_EQ(take(Move{{200, 200}}), Changed::view);
  EXPECT_EQ(take(Move{{210, 220}}), Changed::view);
  EXPECT_EQ(take(Release{}), Changed::nothing);
  EXPECT_NEAR(camera.pointAt({210, 220}).x, grabbed.x, 1e-12);
  EXPECT_NEAR(camera.pointAt({210, 220}).y, grabbed.y, 1e-12);
  EXPECT_EQ(document.sites()->size(), 3U);
}

TEST_F(Pointing, RightClickRemovesTheSiteOrThatOfTheCell) {
  take(Move{at({0.25, 0.5})});
  owner = 2;
  EXPECT_EQ(take(Press{Button::right}), Changed::sites);
  take(Release{Button::right});
  EXPECT_THAT(document.sites()->x, ElementsAre(0.5, 0.75));
  owner = 1;
  take(Press{Button::right});
  EXPECT_THAT(document.sites()->x, ElementsAre(0.5));
  owner = no_site;
  EXPECT_EQ(take(Press{Button::right}), Changed::nothing);
}

TEST_F(Pointing, WheelZoomsAndChangesWeights) {
  take(Move{{100, 100}});
  EXPECT_EQ(take(Scroll{1}), Changed::view);
  owner = 1;
  EXPECT_EQ(take(Scroll{2, {.control = true}}), Changed::drag);
  EXPECT_NEAR(document.weight(1), 0.2 / 3, 1e-12);
}

TEST_F(Pointing, FindsSitesOfAPeriodicDomain) {
  document.open({{{1.25}, {-0.5}, {}}, {0, 0, 1, 1}, {}, Periodic::xy, {}});
  EXPECT_EQ(siteNear(document, camera, at({0.25, 0.5})), 0U);
  EXPECT_EQ(siteNear(document, camera, at({0.75, 0.5})), no_site);
}

TEST(Keys, AreKnownToScriptsAndEachDoesOneThing) {
  std::set<std::string> labels;
  for (const KeyBinding& binding : keyBindings()) {
    EXPECT_EQ(std::ranges::count(keyNames(), binding.key), 1) << binding.key;
    EXPECT_TRUE(labels.insert(labelOf(binding)).second) << labelOf(binding);
  }
  EXPECT_TRUE(labels.contains("Ctrl+Shift+Z"));
  EXPECT_TRUE(labels.contains("?"));
  const auto help = helpLines();
  EXPECT_TRUE(std::ranges::any_of(help, [](const auto& line) { return line.first == "Home or F"; }));
}

TEST(Keys, ChangeSettings) {
  Settings settings;
  const auto press = [&](const Key& key) {
    const KeyBinding* const binding = bindingOf(key);
    ASSERT_NE(binding, nullptr) << key.name;
    if (const auto* const change = std::get_if<void (*)(Settings&)>(&binding->does)) (*change)(settings);
  };
  press({"e"});
  press({"2"});
  press({"question", {.shift = true}});
  press({"space"});
  EXPECT_TRUE(settings.picture.edges && settings.help);
  EXPECT_EQ(settings.picture.color, ColorBy::area);
  EXPECT_EQ(settings.motion, Motion::runs);
  press({"m"});
  const std::string first = settings.picture.colormap;
  for (std::size_t i = 0; i < colormaps().size(); ++i) press({"m"});
  EXPECT_EQ(settings.picture.colormap, first);
  EXPECT_EQ(bindingOf({"x"}), nullptr);
  EXPECT_EQ(bindingOf({"e", {.alt = true}}), nullptr);
}

class Command : public test::InTemporaryDirectory {};

TEST_F(Command, NamesWhatWasOpened) {
  const Document document(threeSites());
  RenderOptions picture{};
  picture.width = 800;
  picture.height = 600;
  picture.view = Box{-0.5, 0, 1.5, 1.5};
  const auto text = shellLine(commandFor(document, picture, {}, {"it's.csv", "", "a b.png"}));
  EXPECT_EQ(
      text,
      "vorpipe render --sites three.csv --view=-0.5,0,1.5,1.5 --size 800x600 --fit stretch -o 'a b.png'");
}

TEST_F(Command, NamesFilesOfWhatWasEdited) {
  Document document(threeSites());
  document.addWeight(0, 0.1);
  RenderOptions picture{};
  picture.width = picture.height = 100;
  picture.color = ColorBy::weight;
  picture.edges = picture.legend = true;
  BackendOptions backend;
  backend.name = "cpu";
  const auto text = shellLine(commandFor(document, picture, backend, {"it's.csv", "", "a.png"}));
  EXPECT_EQ(
      text,
      "vorpipe render --sites 'it'\\''s.csv' --domain 0,0,1,1 --size 100x100 --fit stretch --color weight "
      "--legend --edges --backend cpu -o a.png");
  ASSERT_TRUE(writeSites(path("sites.csv"), *document.sites()));
  const auto read = readSites(path("sites.csv"));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->sites.x, document.sites()->x);
  EXPECT_EQ(read->sites.weight, document.sites()->weight);
}

TEST_F(Command, WritesOutlinesThatAreRead) {
  const std::string text =
      "MULTIPOLYGON (((0 0, 4 0, 4 4, 0 4, 0 0), (1 1, 1 2, 2 2, 1 1)), ((5 5, 6 5, 6 6, 5 5)))";
  const auto outline = readOutline(write("a.wkt", text));
  ASSERT_TRUE(outline) << outline.error().message;
  ASSERT_TRUE(writeOutline(path("b.wkt"), outline->outline));
  const auto again = readOutline(path("b.wkt"));
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->outline.points, outline->outline.points);
  EXPECT_EQ(again->outline.ring_offsets, outline->outline.ring_offsets);
  EXPECT_EQ(again->outline.polygon_offsets, outline->outline.polygon_offsets);
}

}  // namespace
}  // namespace vorpipe::view

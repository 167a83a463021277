#include "io/sites/site_domain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vorpipe::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

PlacedSites inDegrees() {
  PlacedSites placed;
  placed.sites = {{12, 13, 12.5}, {42, 42.5, 43}, {}};
  placed.system = wgs84();
  return placed;
}

PlacedSites ofGenerator() {
  PlacedSites placed;
  placed.sites = {{0.25, 0.75}, {0.5, 0.5}, {}};
  placed.from = SitesFrom::generator;
  return placed;
}

/// What is wrong, in the library's own words.
std::string refusal(const DomainSettings& settings, PlacedSites placed) {
  const auto found = findDomain(settings, placed);
  if (found) return "accepted";
  EXPECT_EQ(found.error().code, ErrorCode::input);
  return found.error().message;
}

TEST(SiteDomain, generatorsFillTheUnitSquareAndFilesTheirBoxWithAMargin) {
  PlacedSites placed = ofGenerator();
  ASSERT_TRUE(findDomain({}, placed));
  EXPECT_EQ(placed.domain.xmin, 0);
  EXPECT_EQ(placed.domain.xmax, 1);
  placed.from = SitesFrom::caller;
  ASSERT_TRUE(findDomain({.margin = Margin{2, false}}, placed));
  EXPECT_EQ(placed.domain.xmin, -1.75);
  EXPECT_EQ(placed.domain.ymax, 2.5);
  EXPECT_THAT(placed.notes, IsEmpty());
}

TEST(SiteDomain, degreesBecomeAPlaneInKilometersAndComeBack) {
  PlacedSites placed = inDegrees();
  ASSERT_TRUE(findDomain({.project = ProjectChoice{}}, placed));
  ASSERT_TRUE(placed.projection);
  EXPECT_EQ(placed.system.kind, CoordinateKind::plane);
  EXPECT_TRUE(placed.system.equal_area_center);
  EXPECT_NEAR(placed.sites.x[1] - placed.sites.x[0], 82.5, 1);
  Diagram diagram;
  diagram.status = {Status::ok, Status::empty, Status::empty};
  diagram.centroid = {{0, 0}, {0, 0}, {0, 0}};
  const Point center = placed.projection->center();
  backToDegrees(placed, diagram);
  EXPECT_THAT(placed.sites.x, ElementsAre(12, 13, 12.5));
  EXPECT_EQ(placed.system.code, 4326);
  EXPECT_NEAR(diagram.centroid[0].y, center.y, 1e-12);
  EXPECT_EQ(diagram.centroid[1], (Point{13, 42.5}));
}

TEST(SiteDomain, coordinatesThatLookLikeDegreesAreNotedOnce) {
  PlacedSites placed = inDegrees();
  ASSERT_TRUE(findDomain({}, placed, {.sites = "towns.csv", .project_amid = "project='auto'"}));
  EXPECT_THAT(placed.notes, ElementsAre(AllOf(HasSubstr("towns.csv: "), HasSubstr("project='auto' makes"))));
}

TEST(SiteDomain, settingsThatContradictEachOtherAreNamedInTheCallersWords) {
  const Outline square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {0, 4}, {0, 1}};
  const Outline bow{{{0, 0}, {1, 1}, {1, 0}, {0, 1}}, {0, 4}, {0, 1}};
  PlacedSites periodic = inDegrees();
  periodic.periodic = Periodic::x;
  EXPECT_THAT(refusal({.outline = square, .margin = Margin{}}, inDegrees()),
              HasSubstr("margin: domain names"));
  EXPECT_THAT(refusal({.margin = Margin{}}, ofGenerator()), HasSubstr("margin: generators fill"));
  EXPECT_THAT(refusal({.margin = Margin{-1}}, inDegrees()), HasSubstr("margin: -1 is not"));
  EXPECT_THAT(refusal({.repair = true}, inDegrees()), HasSubstr("repair: is for the polygons"));
  EXPECT_THAT(refusal({}, periodic), HasSubstr("periodic: name the period by a box"));
  EXPECT_THAT(refusal({.hull = true}, periodic), HasSubstr("does not repeat itself"));
  EXPECT_THAT(refusal({.project = ProjectChoice{}}, ofGenerator()),
              HasSubstr("project: is for files in degrees"));
  EXPECT_THAT(refusal({.outline = bow}, ofGenerator()), HasSubstr("; repair mends it"));
  EXPECT_EQ(refusal({.outline = bow, .repair = true}, ofGenerator()), "accepted");
}

TEST(SiteDomain, sitesAndAnOutlineInDifferentSystemsAreRefusedByName) {
  const Outline square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {0, 4}, {0, 1}};
  DomainSettings settings{.outline = square, .outline_name = "city.gpkg"};
  settings.outline_system = systemOfCode(25832);
  EXPECT_THAT(refusal(settings, inDegrees()),
              HasSubstr("domain: city.gpkg is in EPSG:25832, the sites in EPSG:4326; "));
  EXPECT_EQ(refusal(settings, ofGenerator()), "accepted");
  PlacedSites unnamed = inDegrees();
  unnamed.system = {};
  EXPECT_EQ(refusal(settings, unnamed), "accepted");
  settings.project = ProjectChoice{};
  EXPECT_THAT(refusal(settings, unnamed),
              HasSubstr("project: city.gpkg says that its coordinates are those"));
  settings = {.outline = square};
  settings.outline_system = systemOfCode(4258);
  PlacedSites near = inDegrees();
  ASSERT_TRUE(findDomain(settings, near));
  EXPECT_THAT(near.notes,
              testing::Contains(HasSubstr("the outline is in EPSG:4258, the sites in EPSG:4326")));
  settings.outline_system = systemOfCode(4314);
  EXPECT_THAT(refusal(settings, inDegrees()), HasSubstr("EPSG:4314"));
}

TEST(SiteDomain, sitesAdoptTheSystemOfTheirOutlineOrTheOneThatIsNamed) {
  const Outline square{{{0, 0}, {90, 0}, {90, 90}, {0, 90}}, {0, 4}, {0, 1}};
  DomainSettings settings{.outline = square, .outline_name = "city.gpkg"};
  settings.outline_system = systemOfCode(25832);
  PlacedSites placed = inDegrees();
  placed.system = {};
  placed.from = SitesFrom::file;
  ASSERT_TRUE(findDomain(settings, placed, {.sites = "towns.csv"}));
  EXPECT_EQ(placed.system.code, 25832);
  EXPECT_THAT(placed.notes, testing::Contains(HasSubstr("towns.csv: names no coordinate system")));
  settings.crs = systemOfCode(25833);
  placed.system = {};
  EXPECT_THAT(refusal(settings, placed),
              HasSubstr("crs: EPSG:25833 is named, and city.gpkg is in EPSG:25832"));
  // Degrees are adopted by coordinates that may be some.
  settings = {.outline = square};
  settings.outline_system = wgs84();
  placed.sites.x[0] = 1000;
  placed.system = {};
  ASSERT_TRUE(findDomain(settings, placed));
  EXPECT_FALSE(hasName(placed.system));
}

TEST(SiteDomain, thatNoSiteLiesInTheDomainIsSaidWithBothBoxes) {
  const auto notes = [](const DomainSettings& settings, PlacedSites placed) {
    EXPECT_TRUE(findDomain(settings, placed));
    return placed.notes;
  };
  PlacedSites plane;
  plane.sites = {{100, 300}, {200, 250}, {}};
  EXPECT_THAT(
      notes({.box = Box{0, 0, 1, 1}}, plane),
      ElementsAre("domain: no site lies in the box 0,0,1,1; those of the sites lie in 100,200,300,250"));
  EXPECT_THAT(notes({.box = Box{0, 0, 150, 225}}, plane), IsEmpty());
  EXPECT_THAT(notes({}, plane), IsEmpty());
  EXPECT_THAT(notes({.box = Box{200, 210, 220, 220}, .of_corners = true}, plane), IsEmpty());
  EXPECT_THAT(notes({.box = Box{20, 21, 22, 22}, .of_corners = true}, plane), testing::SizeIs(1));
  plane.periodic = Periodic::xy;
  EXPECT_THAT(notes({.box = Box{0, 0, 1, 1}}, plane), IsEmpty());
  EXPECT_THAT(notes({.box = Box{100, 0, 101, 1}, .project = ProjectChoice{}}, inDegrees()),
              testing::Contains(HasSubstr("no site lies in the box 100,0,101,1; those of the sites lie in "
                                          "12,42,13,43")));
}

TEST(SiteDomain, theBoxOfSitesInDegreesEndsAtThePoles) {
  PlacedSites placed = inDegrees();
  placed.sites.y = {89, 42, -89.5};
  ASSERT_TRUE(findDomain({}, placed));
  EXPECT_EQ(placed.domain.ymax, 90);
  EXPECT_EQ(placed.domain.ymin, -90);
  EXPECT_THAT(placed.notes, testing::Contains(HasSubstr("would reach latitude -98")));
  placed.system = {};
  placed.notes.clear();
  ASSERT_TRUE(findDomain({}, placed));
  EXPECT_GT(placed.domain.ymax, 90);
}

TEST(SiteDomain, sitesThatStayKeepTheirNumbersInDegrees) {
  PlacedSites placed = inDegrees();
  placed.sites.y[1] = 40.85;
  placed.sites.x[1] = 14.25;
  ASSERT_TRUE(findDomain({.project = ProjectChoice{}}, placed));
  Sites moved = placed.sites;
  moved.x[0] += 1;
  const Sites shown = sitesInDegrees(placed, moved);
  EXPECT_EQ(shown.x[1], 14.25);
  EXPECT_EQ(shown.y[1], 40.85);
  EXPECT_EQ(shown.x[2], 12.5);
  EXPECT_NEAR(shown.x[0], 12 + 1 / 82.5, 1e-3);
}

TEST(SiteDomain, picturesKeepTheAspectOfWhatHasOne) {
  EXPECT_EQ(usualFit(ofGenerator()), Fit::stretch);
  EXPECT_EQ(usualFit(inDegrees()), Fit::stretch);
  PlacedSites of_file = inDegrees(), outlined = ofGenerator();
  of_file.from = SitesFrom::file;
  EXPECT_EQ(usualFit(of_file), Fit::letterbox);
  outlined.outline = {{{0, 0}, {1, 0}, {0, 1}}, {0, 3}, {0, 1}};
  EXPECT_EQ(usualFit(outlined), Fit::letterbox);
}

}  // namespace
}  // namespace vorpipe::test

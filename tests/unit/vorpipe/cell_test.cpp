/// Cells read in place, and the names of walls.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/fixtures/checked_runs.h"
#include "unit/fixtures/outlines.h"

namespace vorpipe::test {
namespace {

using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::IsEmpty;
using testing::SizeIs;

Sites pair() { return {{0.25, 0.75, 0.25}, {0.5, 0.5, 0.5}, {}}; }

TEST(Walls, areToldFromSites) {
  EXPECT_FALSE(isWall(0));
  for (const auto wall :
       {Wall::xmin, Wall::xmax, Wall::ymin, Wall::ymax, Wall::outline, Wall::zmin, Wall::zmax}) {
    EXPECT_TRUE(isWall(static_cast<std::int64_t>(wall)));
  }
}

TEST(Walls, haveNames) {
  EXPECT_EQ(nameOf(Wall::xmin), "xmin");
  EXPECT_EQ(nameOf(Wall::ymax), "ymax");
  EXPECT_EQ(nameOf(Wall{-5}), "outline");
  EXPECT_EQ(nameOf(Wall{-6}), "zmin");
  EXPECT_EQ(nameOf(Wall{-7}), "zmax");
}

TEST(Cell, hasWhatTheDiagramSays) {
  const Diagram diagram = cellsOf(pair(), unit_cells);
  ASSERT_EQ(diagram.size(), 3u);
  const Cell cell = diagram.cell(1);
  EXPECT_EQ(cell.index(), 1u);
  EXPECT_EQ(cell.status(), Status::ok);
  EXPECT_EQ(cell.owner(), 1u);
  EXPECT_EQ(cell.area(), 0.5);
  EXPECT_EQ(cell.perimeter(), 3);
  EXPECT_EQ(cell.centroid(), (Point{0.75, 0.5}));
  EXPECT_NEAR(cell.secondMoments()[2], 1.0 / 24, 1e-15);
  EXPECT_EQ(cell.edges(), 4u);
  EXPECT_THAT(cell.neighbors(), testing::UnorderedElementsAre(0, wall_xmax, wall_ymin, wall_ymax));
  EXPECT_THAT(cell.vertices(),
              testing::UnorderedElementsAre(Point{0.5, 0}, Point{1, 0}, Point{1, 1}, Point{0.5, 1}));
  EXPECT_THAT(cell.edgeLengths(), SizeIs(4));
  EXPECT_THAT(cell.shifts(), IsEmpty());
  ASSERT_EQ(cell.rings().size(), 1u);
  EXPECT_THAT(cell.rings()[0], ElementsAreArray(cell.vertices()));
  EXPECT_FALSE(cell.rings().isHole(0));
}

TEST(Cell, ofADuplicateIsEmptyAndNamesItsOwner) {
  const Diagram diagram = cellsOf(pair(), unit_cells);
  EXPECT_EQ(diagram.cell(2).status(), Status::duplicate);
  EXPECT_EQ(diagram.cell(2).owner(), 0u);
  EXPECT_EQ(diagram.cell(2).edges(), 0u);
  EXPECT_TRUE(diagram.cell(2).rings().empty());
}

TEST(Cell, hasNoListsThatWereNotAskedFor) {
  CellsOptions options = unit_cells;
  options.detail = Detail::measures;
  const Diagram diagram = cellsOf(pair(), options);
  EXPECT_EQ(diagram.cell(0).edges(), 4u);
  EXPECT_THAT(diagram.cell(0).neighbors(), SizeIs(4));
  EXPECT_THAT(diagram.cell(0).vertices(), IsEmpty());
  EXPECT_THAT(diagram.cell(0).edgeLengths(), IsEmpty());
  EXPECT_TRUE(diagram.cell(0).rings().empty());
}

TEST(Cell, hasTheShiftsOfAPeriodicDomainAndTheMassOfADensity) {
  CellsOptions options = unit_cells;
  options.periodic = Periodic::x;
  options.density = {1, 1, {2}};
  const Diagram diagram = cellsOf(pair(), options);
  const Cell cell = diagram.cell(0);
  EXPECT_THAT(cell.shifts(), SizeIs(4));
  EXPECT_THAT(cell.shifts(), testing::Contains(ElementsAre(-1, 0)));
  EXPECT_NEAR(cell.mass(), 1, 1e-12);
  EXPECT_NEAR(cell.massCentroid().x, 0.25, 1e-12);
}

TEST(Cell, hasTheRingsOfAnOutline) {
  Sites one;
  one.x = {0.5};
  one.y = {0.5};
  const Diagram diagram =
      cellsOf(one, inside(outlineOf({{rectangle(0, 0, 0.5, 0.5), rectangle(0.125, 0.125, 0.25, 0.25)},
                                     {rectangle(0.75, 0.75, 1, 1)}})));
  const CellRings rings = diagram.cell(0).rings();
  ASSERT_EQ(rings.size(), 3u);
  std::vector<double> areas;
  int holes = 0;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    EXPECT_THAT(rings[r], SizeIs(4));
    EXPECT_EQ(rings.isHole(r), ringArea(rings[r]) < 0);
    areas.push_back(ringArea(rings[r]));
    holes += rings.isHole(r) ? 1 : 0;
  }
  EXPECT_THAT(areas, testing::UnorderedElementsAre(0.25, -0.015625, 0.0625));
  EXPECT_EQ(holes, 1);
}

TEST(Diagram, isARangeOfItsCells) {
  const Sites sites = mixedSites();
  const Diagram diagram = cellsOf(sites, unit_cells);
  std::size_t count = 0;
  double area = 0;
  for (const Cell cell : diagram) {
    EXPECT_EQ(cell.index(), count++);
    area += cell.area();
  }
  EXPECT_EQ(count, sites.size());
  EXPECT_NEAR(area, 1, 1e-12);
}

}  // namespace
}  // namespace vorpipe::test

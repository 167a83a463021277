#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/io/sites/sites_fixture.h"

namespace vorpipe::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class WktSites : public SitesOfFiles {};

TEST_F(WktSites, arePointsOneAfterTheOther) {
  const SiteTable table = good("a.wkt", "point(1 2)\nMULTIPOINT ((3 4),(5 6)) MULTIPOINT(7 8,9 10)\n");
  EXPECT_THAT(table.sites.x, ElementsAre(1, 3, 5, 7, 9));
  EXPECT_THAT(table.sites.y, ElementsAre(2, 4, 6, 8, 10));
  EXPECT_EQ(table.system.kind, CoordinateKind::unknown);
  EXPECT_THAT(table.notes, IsEmpty());
}

TEST_F(WktSites, mayHaveHeightsAndASystem) {
  const SiteTable table = good("a.wkt", "SRID=4326;POINT Z (1 2 3)\nPOINTZM(4 5 6 7) POINT M(7 8 1)");
  EXPECT_THAT(table.sites.x, ElementsAre(1, 4, 7));
  EXPECT_EQ(table.system.kind, CoordinateKind::degrees);
  EXPECT_EQ(notes(table), ": of positions x and y are taken, and nothing of their other numbers\n");
  EXPECT_EQ(good("a.wkt", "SRID=25832;POINT (400000 5000000)").system.kind, CoordinateKind::plane);
}

TEST_F(WktSites, areRefusedWithTheirPlace) {
  EXPECT_EQ(bad("a.wkt", "POINT (1 2)\nPOLYGON ((0 0,1 0,1 1,0 0))"),
            "2:1: \"POLYGON\", where POINT or MULTIPOINT is needed");
  EXPECT_EQ(bad("a.wkt", "POINT (1 x)"), "1:10: \"x\" is not a number");
  EXPECT_EQ(bad("a.wkt", "POINT (1)"), "1:9: \")\", where a number is needed");
  EXPECT_EQ(bad("a.wkt", "POINT (1 2"), "1:11: the text ends, where \",\" or \")\" is needed");
  EXPECT_EQ(bad("a.wkt", "POINT (1 2, 3 4)"), "1:17: a POINT of several positions ends before this");
  EXPECT_EQ(bad("a.wkt", "MULTIPOINT ((1 2, 3 4))"), "1:23: a point of several positions ends before this");
  EXPECT_EQ(bad("a.wkt", "POINT (1 2)\nPOINT EMPTY"), "2:1: has no place: it is EMPTY");
  EXPECT_EQ(good("a.wkt", "POINT (1 2)\nPOINT EMPTY", skipping()).skipped, 1u);
  EXPECT_EQ(bad("a.wkt", "SRID=4326;POINT (1 2) SRID=1;POINT (1 2)"),
            "1:23: is of SRID 1, and those before it of 4326");
  EXPECT_EQ(bad("a.wkt", "SRID=x;POINT (1 2)"), "1:1: \"x\" is no number of a coordinate system");
  EXPECT_EQ(bad("a.wkt", " \n"), " holds no sites");
}

}  // namespace
}  // namespace vorpipe::test

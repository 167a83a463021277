// Tables as people have them: separators, headers, columns, attributes, and what is said of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "io/sites/site_domain.h"
#include "unit/io/sites/sites_fixture.h"

namespace vorpipe::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class SiteTables : public SitesOfFiles {};

TEST_F(SiteTables, areSeparatedByWhatTheFirstLineHas) {
  for (const char* bytes :
       {"x,y,name\n1.5,2,a\n-3,4,b\n", "x;y;name\n1,5;2;a\n-3;4;b\n", "x;y;name\n1.5;2;a\n-3;4;b\n",
        "x\ty\tname\n1,5\t2\ta\n-3\t4\tb\n", "sep=;\r\nx;y;name\r\n1,5;2;a\r\n-3;4;b\r\n",
        "sep=\t\nx\ty\tname\n1,5\t2\ta\n-3\t4\tb\n", "\"sep=;\"\nx;y;name\n1,5;2;a\n-3;4;b\n",
        "# of 2020, with a comma\nx;y;name\n1,5;2;a\n-3;4;b\n",
        "\"x\";\"y\";\"name, or code, or both\"\n1,5;2;a\n-3;4;b\n"}) {
    SCOPED_TRACE(bytes);
    const SiteTable table = good("a.csv", bytes);
    EXPECT_THAT(table.sites.x, ElementsAre(1.5, -3));
    EXPECT_THAT(table.sites.y, ElementsAre(2, 4));
    ASSERT_EQ(table.attributes.size(), 1u);
    EXPECT_EQ(table.attributes[0].at(1), "b");
    EXPECT_THAT(table.notes, IsEmpty());
  }
  EXPECT_THAT(good("a.tsv", "x\ty\n1\t2,5\n").sites.y, ElementsAre(2.5));
  EXPECT_THAT(bad("a.tsv", "x,y\n1,2\n"), HasSubstr("1:1: the header \"x,y\" names no column \"x\""));
}

TEST_F(SiteTables, refuseARowInOneLineWhateverItsColumnIsNamed) {
  EXPECT_EQ(bad("a.csv", "\"x\n1\",y\na,1\n", columns({"1", "2"})),
            "3:1: \"a\" is not a number (column x\\x0a1)");
}

TEST_F(SiteTables, withDecimalCommasAreNotGuessedAt) {
  EXPECT_EQ(bad("a.csv", "x;y\n1.234,5;2\n"),
            "2:1: \"1.234,5\" has a comma and a point: only one can be before a fraction (column x)");
  EXPECT_EQ(bad("a.csv", "x;y\n1,234,567;2\n"), "2:1: \"1,234,567\" has several commas (column x)");
  EXPECT_EQ(bad("a.csv", "x;y\n1,5;2\n3;1.234\n"),
            "3:3: \"1.234\" has a decimal point, and line 2 a decimal comma (column y)");
  EXPECT_EQ(bad("a.csv", "x;y\n1,5a;2\n"), "2:1: \"1,5a\" is not a number (column x)");
  EXPECT_EQ(bad("a.csv", "x,y\n1,\"2,5\"\n"), "2:3: \"2,5\" is not a number (column y)");
}

TEST_F(SiteTables, withoutAHeaderAreColumnsByNumber) {
  const SiteTable two = good("a.csv", "1,2\n3,4\n");
  EXPECT_THAT(two.sites.x, ElementsAre(1, 3));
  EXPECT_EQ(notes(two), ": there is no header: columns 1 and 2 are taken as x and y\n");
  const SiteTable three = good("a.csv", "1,5;2;7\n3;4;8,5\n");
  EXPECT_THAT(three.sites.x, ElementsAre(1.5, 3));
  EXPECT_THAT(three.sites.weight, ElementsAre(7, 8.5));
  EXPECT_THAT(notes(three), HasSubstr("3 are taken as x, y and weights; --columns 1,2 leaves 3 out"));
  const SiteTable named = good("a.csv", "1,2,a\n3,4,b\n");
  EXPECT_TRUE(named.sites.weight.empty());
  EXPECT_THAT(textsOf(named), ElementsAre("column_3 (text): a, b"));
  const SiteTable chosen = good("a.csv", "a,1,2,9\nb,3,4,8\n", columns({"3", "2", "4"}));
  EXPECT_THAT(chosen.sites.x, ElementsAre(2, 4));
  EXPECT_THAT(chosen.sites.weight, ElementsAre(9, 8));
  EXPECT_THAT(textsOf(chosen), ElementsAre("column_1 (text): a, b"));
  EXPECT_THAT(chosen.notes, IsEmpty());
}

TEST_F(SiteTables, namesInAnyCaseAreTakenAndSaid) {
  struct Case {
    const char *header, *note;
  };
  for (const auto& [header, note] :
       std::array<Case, 6>{{{"lon,lat", "\"lon\", \"lat\" are taken as x, y"},
                            {"LONG,Latitude", "\"LONG\", \"Latitude\" are taken as x, y"},
                            {"lng,LAT", "are taken as x, y"},
                            {"Longitude,y", "\"Longitude\" is taken as x;"},
                            {"easting,Northing", "\"easting\", \"Northing\" are taken as x, y"},
                            {"x,Y", ""}}}) {
    SCOPED_TRACE(header);
    const SiteTable table = good("a.csv", std::string(header) + "\n1,2\n");
    EXPECT_THAT(table.sites.x, ElementsAre(1));
    EXPECT_THAT(table.sites.y, ElementsAre(2));
    EXPECT_THAT(notes(table), HasSubstr(note));
    EXPECT_EQ(table.notes.empty(), *note == '\0');
  }
  const SiteTable exact = good("a.csv", "lon,lat,x,y\n1,2,3,4\n");
  EXPECT_THAT(exact.sites.x, ElementsAre(3));
  EXPECT_EQ(exact.attributes.size(), 2u);
}

TEST_F(SiteTables, weightsInAnyCaseAreNoSecret) {
  for (const char* name : {"Weight", "WEIGHT", "w", "W"}) {
    const SiteTable table = good("a.csv", std::string("x,y,") + name + "\n1,2,3\n");
    EXPECT_THAT(table.sites.weight, ElementsAre(3)) << name;
    EXPECT_EQ(notes(table), std::string(": \"") + name + "\" is taken as weight; --columns names others\n");
  }
  for (const char* name : {"Radius", "RADIUS", "r", "R"}) {
    const SiteTable table = good("a.csv", std::string("x,y,") + name + "\n1,2,3\n");
    EXPECT_THAT(table.sites.weight, ElementsAre(9)) << name;
    EXPECT_EQ(notes(table),
              std::string(": \"") + name +
                  "\" is taken as radius, whose square is the weight; --columns names others\n");
  }
  EXPECT_THAT(good("a.csv", "x,y,weight\n1,2,3\n").notes, IsEmpty());
  EXPECT_THAT(good("a.csv", "x,y,radius\n1,2,3\n").notes, IsEmpty());
  EXPECT_TRUE(good("a.csv", "x,y,r\n1,2,3\n", columns({"x", "y"})).sites.weight.empty());
}

TEST_F(SiteTables, withTwoCandidatesAreRefused) {
  EXPECT_EQ(bad("a.csv", "lon,lat,easting\n1,2,3\n"),
            "1:9: the header names both \"lon\" and \"easting\"; --columns says which");
  EXPECT_EQ(bad("a.csv", "x,y,weight,Radius\n1,2,3,4\n"),
            "1:12: the header names both \"weight\" and \"Radius\"; --columns says which");
  EXPECT_EQ(bad("a.csv", "X,lon,lat\n1,2,3\n"),
            "1:3: the header names both \"X\" and \"lon\"; --columns says which");
}

TEST_F(SiteTables, columnsAreChosenByNameOrNumber) {
  const std::string bytes = "name,Lon,y,Lat,r\na,1,2,3,4\n";
  EXPECT_THAT(good("a.csv", bytes, columns({"lon", "LAT"})).sites.y, ElementsAre(3));
  EXPECT_THAT(good("a.csv", bytes, columns({"2", "4", "3"})).sites.weight, ElementsAre(2));
  const SiteTable radius = good("a.csv", bytes, columns({"2", "4", "r"}));
  EXPECT_THAT(radius.sites.weight, ElementsAre(16));
  EXPECT_THAT(notes(radius), HasSubstr("column \"r\" is taken as radius, whose square is the weight"));
  EXPECT_THAT(bad("a.csv", bytes, columns({"Lon", "z"})),
              HasSubstr("1:1: the header \"name,Lon,y,Lat,r\" names no"));
  EXPECT_EQ(bad("a.csv", bytes, columns({"1", "6"})), "1:1: there is no column 6; there are 5");
  EXPECT_EQ(bad("a.csv", bytes, columns({"0", "1"})), "1:1: there is no column 0; there are 5");
  EXPECT_EQ(bad("a.csv", bytes, columns({"y", "Y"})), "1:10: column \"y\" is chosen twice");
  EXPECT_EQ(bad("a.csv", bytes, columns({"name", "y"})), "2:1: \"a\" is not a number (column name)");
}

TEST_F(SiteTables, otherColumnsAreAttributes) {
  const SiteTable table =
      good("a.csv",
           "id,code,x,name,y,share,ok,none\n1,007,1,\"a \"\"b\"\", c\",2,0.50,true,\n2,8,3,,4,1e3,false,\n");
  EXPECT_THAT(textsOf(table),
              ElementsAre("id (integer): 1, 2", "code (text): 007, 8", "name (text): a \"b\", c, -",
                          "share (real): 0.50, 1e3", "ok (boolean): true, false", "none (text): -, -"));
  EXPECT_THAT(textsOf(good("a.csv", "x;y;share;size;text\n1,5;2;0,50;1,234;1,5\n3;4;2;2;a\n")),
              ElementsAre("share (real): 0.50, 2", "size (real): 1.234, 2", "text (text): 1,5, a"));
  EXPECT_THAT(textsOf(good("a.csv", "x;y;share;people\n1;2;0,5;1,234\n3;4;2;2,000\n")),
              ElementsAre("share (real): 0.5, 2", "people (text): 1,234, 2,000"));
  EXPECT_THAT(textsOf(good("a.csv", "x;y;people\n1.5;2;1,23\n")), ElementsAre("people (text): 1,23"));
  EXPECT_THAT(textsOf(good("a.csv", ",x,a,y,a\n0,1,2,3,4\n")),
              ElementsAre("column_1 (integer): 0", "a (integer): 2", "a_2 (integer): 4"));
}

TEST_F(SiteTables, textOfAnotherEncodingIsTakenAndSaid) {
  const SiteTable table = good("a.csv", "x,y,n\n1,2,K\xF6ln \x80\n3,4,K\xC3\xB6ln\n");
  EXPECT_THAT(textsOf(table), ElementsAre("n (text): K\xC3\xB6ln \xE2\x82\xAC, K\xC3\xB6ln"));
  EXPECT_EQ(notes(table), ": line 2 is not UTF-8: such text is taken as Windows-1252\n");
  EXPECT_EQ(bad("a.csv", std::string("\xFF\xFEx\0,\0y\0\n\0", 10)),
            "1:1: the text is UTF-16; UTF-8 is needed");
}

TEST_F(SiteTables, whatIsNotKeptIsSaid) {
  ReadOptions options;
  options.attributes = false;
  const SiteTable table = good("a.csv", "x,y,a,b,c,d,e,f\n1,2,3,4,5,6,7,8\n", options);
  EXPECT_TRUE(table.attributes.empty());
  EXPECT_EQ(notes(table), ": not used: a, b, c, d, e and 1 more\n");
}

TEST_F(SiteTables, missingFieldsAreErrorsOrLeftOut) {
  const std::string bytes = "x,y,weight,n\n1,2,3,a\n,2,3,b\n4,,5,c\n4,5, ,d\n6,7,8,\n";
  EXPECT_EQ(bad("a.csv", bytes), "3:1: empty field; --missing skip leaves such rows out (column x)");
  const SiteTable table = good("a.csv", bytes, skipping());
  EXPECT_THAT(table.sites.x, ElementsAre(1, 6));
  EXPECT_THAT(table.sites.weight, ElementsAre(3, 8));
  EXPECT_THAT(textsOf(table), ElementsAre("n (text): a, -"));
  EXPECT_EQ(table.skipped, 3u);
  EXPECT_EQ(notes(table), ": 3 rows without a place or a weight are left out\n");
  EXPECT_EQ(bad("a.csv", "x,y\n1,\n", skipping()),
            " holds no sites: what a site needs is missing in every row");
  EXPECT_EQ(bad("a.csv", "x,y\n1,\n2,b\n", skipping()), "3:3: \"b\" is not a number (column y)");
}

TEST_F(SiteTables, missingValuesAreThoseThatRAndNumPyWrite) {
  for (const std::string missing : {"NA", "N/A", "nan", "NaN", "NULL", "None", "-", "."}) {
    const std::string what = "\"" + missing + "\" is no value; --missing skip leaves such rows out (column ";
    const std::string table = "x,y,weight\n1,2,3\n4,5," + missing + "\n" + missing + ",7,8\n";
    EXPECT_EQ(bad("a.csv", table), "3:5: " + what + "weight)");
    EXPECT_THAT(good("a.csv", table, skipping()).sites.x, ElementsAre(1));
    const std::string text = "1 2\n3 " + missing + "\n5 6\n";
    EXPECT_EQ(bad("a.txt", text), "2:3: " + what + "y)");
    EXPECT_THAT(good("a.txt", text, skipping()).sites.x, ElementsAre(1, 5));
  }
  EXPECT_EQ(bad("a.csv", "x,y\n1,na\n", skipping()), "2:3: \"na\" is not a number (column y)");
}

TEST_F(SiteTables, commentsAreCounted) {
  const SiteTable table = good("a.csv", "# of a survey\nx,y\n# 1,2\n3,4\n  # and\n5,\"6\"\n");
  EXPECT_THAT(table.sites.x, ElementsAre(3, 5));
  EXPECT_EQ(notes(table), ": 3 lines begin with # and are left out\n");
  EXPECT_EQ(notes(good("a.csv", "# of a survey\nx,y\n3,4\n5,6\n")), "");
  EXPECT_THAT(textsOf(good("a.csv", "n,x,y\n\"a\n#b\",3,4\n")), ElementsAre("n (text): a\n#b"));
}

TEST_F(SiteTables, pointsMayBeWkt) {
  const SiteTable table =
      good("a.csv", "id,WKT,r\n1,POINT (1 2),2\n2,\"SRID=3857;MULTIPOINT (3 4, 5 6)\",3\n");
  EXPECT_THAT(table.sites.x, ElementsAre(1, 3, 5));
  EXPECT_THAT(table.sites.weight, ElementsAre(4, 9, 9));
  EXPECT_THAT(textsOf(table), ElementsAre("id (integer): 1, 2, 2"));
  EXPECT_EQ(table.system.code, 3857);
  EXPECT_THAT(notes(table),
              HasSubstr("\"WKT\", \"r\" are taken as points in WKT, radius, whose square is the weight"));
  EXPECT_THAT(good("a.csv", "x,y,geom\n1,2,POINT (3 4)\n").sites.x, ElementsAre(1));
  EXPECT_THAT(good("a.csv", "x,y,geom\n1,2,POINT (3 4)\n", columns({"geom"})).sites.x, ElementsAre(3));
  EXPECT_EQ(bad("a.csv", "n,wkt\n1,POINT (3 a)\n"),
            "2:3: its WKT at 1:10: \"a\" is not a number (column wkt)");
  EXPECT_EQ(bad("a.csv", "n,wkt\n1,POINT (3 4) 5\n"),
            "2:3: its WKT at 1:13: \"5\", where the end of the field is needed (column wkt)");
  EXPECT_EQ(bad("a.csv", "wkt\nPOINT EMPTY\n"), "2:1: has no place: it is EMPTY (column wkt)");
}

TEST_F(SiteTables, aThirdColumnWithoutANameIsSaid) {
  const std::string says = ": the third column is taken as weights; --columns 1,2 leaves it out\n";
  const SiteTable text = good("points.xyz", "1 2 100\n3 4 200\n");
  EXPECT_THAT(text.sites.weight, ElementsAre(100, 200));
  EXPECT_EQ(notes(text), says);
  const SiteTable flat = good("points.xyz", "1 2 100 7\n3 4 200 8\n", columns({"1", "2"}));
  EXPECT_TRUE(flat.sites.weight.empty());
  EXPECT_THAT(textsOf(flat), ElementsAre("column_3 (integer): 100, 200", "column_4 (integer): 7, 8"));
  EXPECT_THAT(flat.notes, IsEmpty());
  EXPECT_EQ(bad("points.xyz", "1 2\n", columns({"x", "y"})),
            " its columns have no names, as \"x\"; they have numbers from 1");
  EXPECT_EQ(bad("points.xyz", "1 2\n", columns({"1", "3"})), " has no column 3; it has 2");
  if (!numpy("np.save('a.npy', np.array([[1, 2, 3, 9], [4, 5, 6, 9.]])[:, :3])\n"
             "np.save('b.npy', np.array([[1, 2, 3, 9], [4, 5, 6, 9.]]))\n")) {
    GTEST_SKIP() << without_numpy;
  }
  EXPECT_EQ(notes(goodFile(path("a.npy"))), says);
  const SiteTable chosen = goodFile(path("b.npy"), columns({"4", "2", "1"}));
  EXPECT_THAT(chosen.sites.x, ElementsAre(9, 9));
  EXPECT_THAT(chosen.sites.weight, ElementsAre(1, 4));
  EXPECT_THAT(chosen.notes, IsEmpty());
}

TEST_F(SiteTables, degreesAreToldByNamesAndRanges) {
  const auto degrees = [](const SiteTable& table) { return looksLikeDegrees(table.sites, table.system); };
  EXPECT_TRUE(degrees(good("a.csv", "lon,lat\n1,2\n")));
  EXPECT_TRUE(degrees(good("a.csv", "Lng,Latitude\n1,2\n", columns({"1", "2"}))));
  EXPECT_TRUE(degrees(good("a.csv", "x,y\n-100,2\n100,80\n")));
  EXPECT_FALSE(degrees(good("a.csv", "x,y\n-80,2\n100,80\n")));
  EXPECT_FALSE(degrees(good("a.csv", "x,y\n-100,2\n100,91\n")));
  EXPECT_FALSE(degrees(good("a.csv", "easting,northing\n-100,2\n100,80\n")));
  const SiteTable plane = good("a.csv", "lon,lat\n500000,2\n");
  EXPECT_FALSE(degrees(plane));
  EXPECT_THAT(notes(plane), HasSubstr("reaches beyond 360 or 90: it is taken as a plane"));
}

TEST_F(SiteTables, optionsThatAFileCannotFollowAreRefused) {
  EXPECT_THAT(bad("a.wkt", "POINT (1 2)", columns({"1", "2"})), HasSubstr("its columns cannot be chosen"));
  ReadOptions options;
  options.layer = "a";
  EXPECT_EQ(bad("a.csv", "x,y\n1,2\n", options), " has no layers for --layer; a .gpkg has");
  options = {};
  options.format = "csv";
  EXPECT_THAT(good("a.data", "x,y\n1,2\n", options).sites.x, ElementsAre(1));
}

}  // namespace
}  // namespace vorpipe::test

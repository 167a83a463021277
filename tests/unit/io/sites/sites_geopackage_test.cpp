// GeoPackages that Python's sqlite3 makes; tests/cli/formats.sh has those of GDAL.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "io/sites/outline_file.h"
#include "unit/io/sites/sites_fixture.h"

namespace vorpipe::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Makes a.gpkg: `layers` are tuples of a name, a type of geometry, an srs_id, SQL of further columns, and
/// rows.
std::string script(const std::string& layers) {
  return R"(
import os, sqlite3, struct
def wkb(order, kind, *numbers): return struct.pack(order + 'BI%dd' % len(numbers), order == '<', kind, *numbers)
def many(order, *parts): return struct.pack(order + 'BII', order == '<', 4, len(parts)) + b''.join(parts)
def gp(body, envelope=0): return b'GP\0' + bytes([1 | envelope << 1]) + struct.pack('<i', 4326) + b'\7' * [0, 32, 48, 48, 64][envelope] + body
nan = float('nan')
if os.path.exists('a.gpkg'): os.remove('a.gpkg')
db = sqlite3.connect('a.gpkg')
db.execute('PRAGMA synchronous = OFF')
db.executescript('''
CREATE TABLE gpkg_spatial_ref_sys (srs_name TEXT, srs_id INTEGER, organization TEXT, organization_coordsys_id INTEGER, definition TEXT);
INSERT INTO gpkg_spatial_ref_sys VALUES ('WGS 84', 4326, 'EPSG', 4326, 'GEOGCS["WGS 84"]');
INSERT INTO gpkg_spatial_ref_sys VALUES ('UTM', 25832, 'epsg', 25832, 'PROJCS["UTM",GEOGCS["ETRS89"]]');
CREATE TABLE gpkg_contents (table_name TEXT, data_type TEXT);
CREATE TABLE gpkg_geometry_columns (table_name TEXT, column_name TEXT, geometry_type_name TEXT, srs_id INTEGER, z INT, m INT);
''')
def layer(name, kind, srs, columns, rows):
    table = '"%s"' % name.replace('"', '""')
    db.execute('CREATE TABLE %s (fid INTEGER PRIMARY KEY, geom BLOB%s)' % (table, columns))
    db.execute('INSERT INTO gpkg_contents VALUES (?, "features")', (name,))
    db.execute('INSERT INTO gpkg_geometry_columns VALUES (?, "geom", ?, ?, 0, 0)', (name, kind, srs))
    for row in rows: db.execute('INSERT INTO %s VALUES (%s)' % (table, ','.join('?' * len(row))), row)
)" + layers +
         "\ndb.commit()\ndb.close()\n";
}

class GeoPackage : public SitesOfFiles {
 protected:
  void SetUp() override {
    if (!hasModule("sqlite3")) GTEST_SKIP() << "there is no python3 with sqlite3";
  }
  [[nodiscard]] SiteTable read(const std::string& layers, const ReadOptions& options = {}) const {
    python(script(layers));
    return goodFile(path("a.gpkg"), options);
  }
  [[nodiscard]] std::string refusal(const std::string& layers, const ReadOptions& options = {}) const {
    python(script(layers));
    return badFile(path("a.gpkg"), options);
  }
};

TEST_F(GeoPackage, anotherColumnOfGeometriesIsNoAttribute) {
  const SiteTable table = read(R"(layer('towns', 'POINT', 4326, ', area POLYGON, name TEXT', [
    (1, gp(wkb('<', 1, 1, 2)), gp(wkb('<', 1, 1, 2)), 'a')]))");
  EXPECT_THAT(textsOf(table), ElementsAre("fid (integer): 1", "name (text): a"));
  EXPECT_EQ(notes(table), ": columns of bytes are left out: area\n");
}

TEST_F(GeoPackage, polygonsAreAnOutline) {
  python(script(R"(
def ring(order, *points): return struct.pack(order + 'I', len(points)) + b''.join(struct.pack(order + '2d', *p) for p in points)
def polygon(order, *rings): return struct.pack(order + 'BII', order == '<', 3, len(rings)) + b''.join(rings)
def group(order, kind, *parts): return struct.pack(order + 'BII', order == '<', kind, len(parts)) + b''.join(parts)
square, hole = [(0, 0), (4, 0), (4, 4), (0, 4), (0, 0)], [(1, 1), (2, 1), (2, 2), (1, 1)]
far = [(8, 8), (9, 8), (9, 9), (8, 8)]
layer('towns', 'POINT', 4326, '', [])
layer('land', 'MULTIPOLYGON', 25832, '', [
  (1, gp(polygon('<', ring('<', *square), ring('<', *hole)))), (2, None),
  (3, gp(group('>', 6, polygon('>', ring('>', *far)), polygon('<', ring('<', *far)))))]))"));
  const auto read = readOutline(path("a.gpkg"));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_THAT(read->outline.ring_offsets, ElementsAre(0, 4, 7, 10, 13));
  EXPECT_THAT(read->outline.polygon_offsets, ElementsAre(0, 2, 3, 4));
  EXPECT_EQ(read->outline.points[2], (Point{4, 4}));
  EXPECT_EQ(nameOf(read->system), "EPSG:25832");
  EXPECT_THAT(readOutline(path("a.gpkg"), "towns").error().message, HasSubstr("holds no polygon"));
  EXPECT_THAT(readOutline(path("a.gpkg"), "sea").error().message,
              HasSubstr("has no layer \"sea\"; it has land (MULTIPOLYGON), towns (POINT)"));
  python(script(R"(layer('a', 'POLYGON', 0, '', []); layer('b', 'POLYGON', 0, '', []))"));
  EXPECT_THAT(readOutline(path("a.gpkg")).error().message, HasSubstr("--domain-layer says which"));
  python(script(R"(layer('a', 'GEOMETRY', 0, '', [(1, gp(wkb('<', 1, 1, 2)))]))"));
  EXPECT_THAT(readOutline(path("a.gpkg")).error().message,
              HasSubstr("layer a, row 1: a Point where a Polygon is needed"));
  python(script(R"(layer('a', 'POLYGON', 0, '', [(1, gp(struct.pack('<BII', 1, 3, 4000000000)))]))"));
  EXPECT_THAT(readOutline(path("a.gpkg")).error().message, HasSubstr("is damaged"));
}

TEST_F(GeoPackage, pointsOfAllKindsHaveAttributes) {
  const SiteTable table = read(
      R"(layer('my "towns"', 'POINT', 4326, ', name TEXT(20), n MEDIUMINT, q DOUBLE, ok BOOLEAN, photo BLOB, mixed INTEGER', [
    (1, gp(wkb('<', 1, 1, 2)), 'a', 5, 1.5, 1, b'x', 1),
    (2, gp(wkb('>', 1, 3, 4), 1), 'b', None, 2.0, 0, None, 'y'),
    (3, gp(wkb('<', 1001, 5, 6, 7), 2), None, None, None, None, None, None),
    (4, gp(wkb('>', 3001, 7, 8, 9, 9), 4), None, None, None, None, None, None),
    (5, gp(wkb('<', 0xC0000001, 9, 10, 9, 9)), None, None, None, None, None, None),
    (9, gp(many('>', wkb('<', 1, 11, 12), wkb('>', 1, 13, 14))), 'c', 1, 1, 1, None, 2)]))");
  EXPECT_THAT(table.sites.x, ElementsAre(1, 3, 5, 7, 9, 11, 13));
  EXPECT_THAT(table.sites.y, ElementsAre(2, 4, 6, 8, 10, 12, 14));
  EXPECT_THAT(
      textsOf(table),
      ElementsAre("fid (integer): 1, 2, 3, 4, 5, 9, 9", "name (text): a, b, -, -, -, c, c",
                  "n (integer): 5, -, -, -, -, 1, 1", "q (real): 1.5, 2, -, -, -, 1, 1",
                  "ok (boolean): true, false, -, -, -, true, true", "mixed (json): 1, \"y\", -, -, -, 2, 2"));
  EXPECT_EQ(table.system.kind, CoordinateKind::degrees);
  EXPECT_EQ(table.system.code, 4326);
  EXPECT_EQ(table.system.definition, "GEOGCS[\"WGS 84\"]");
  EXPECT_EQ(notes(table),
            ": columns of bytes are left out: photo\n"
            ": of positions x and y are taken, and nothing of their other numbers\n");
}

TEST_F(GeoPackage, weightsAndMissingValuesAreAsElsewhere) {
  const std::string layers = R"(layer('a', 'POINT', 25832, ', Radius REAL', [
    (1, gp(wkb('<', 1, 1, 2)), 3.0), (2, None, 1.0), (3, gp(wkb('<', 1, nan, nan)), 1.0), (4, gp(wkb('<', 1, 3, 4)), None)]))";
  EXPECT_EQ(refusal(layers), " layer a, row 2: has no place; --missing skip leaves such out");
  const SiteTable table = read(layers, skipping());
  EXPECT_THAT(table.sites.weight, ElementsAre(9));
  EXPECT_EQ(table.skipped, 3u);
  EXPECT_EQ(table.system.kind, CoordinateKind::plane);
  EXPECT_EQ(table.system.organization, "EPSG");
  EXPECT_THAT(notes(table),
              HasSubstr("the column \"Radius\" is taken as radius, whose square is the weight"));
}

TEST_F(GeoPackage, oneOfSeveralLayersIsChosen) {
  const std::string row = "[(1, gp(wkb('<', 1, 1, 2)))])\n";
  const std::string points = "layer('a', 'POINT', 0, '', " + row,
                    more = "layer('b', 'MULTIPOINT', -1, '', " + row;
  const std::string polygons = "layer('c', 'POLYGON', 0, '', [(1, gp(wkb('<', 3)))])\n";
  EXPECT_EQ(read(points + polygons).system.kind, CoordinateKind::degrees);
  EXPECT_EQ(refusal(points + more + polygons),
            " has several layers of points: a (POINT), b (MULTIPOINT); --layer says which");
  ReadOptions options;
  options.layer = "b";
  EXPECT_EQ(read(points + more + polygons, options).sites.size(), 1u);
  options.layer = "d";
  EXPECT_EQ(refusal(points + polygons, options), " has no layer \"d\"; it has a (POINT), c (POLYGON)");
  options.layer = "c";
  EXPECT_EQ(refusal(points + polygons, options), " layer c, row 1: a Polygon where a Point is needed");
  EXPECT_EQ(refusal(polygons), " has no layer of points; it has c (POLYGON)");
  EXPECT_EQ(refusal("layer('c\\n', 'POLYGON\\n', 0, '', [])\n"),
            " has no layer of points; it has c\\x0a (POLYGON\\x0a)");
  EXPECT_EQ(refusal(""), " has no layers of features");
}

TEST_F(GeoPackage, brokenOnesAreRefusedInOneLine) {
  const auto geometry = [&](const std::string& bytes) {
    return refusal("layer('a', 'POINT', 0, '', [(1, " + bytes + ")])");
  };
  EXPECT_EQ(geometry("b'PG'"), " layer a, row 1: its geometry does not begin as a GeoPackage's do");
  EXPECT_EQ(geometry("b'GP'"), " layer a, row 1: the header of its geometry is damaged");
  EXPECT_EQ(geometry("gp(wkb('<', 1, 1))"), " layer a, row 1: its geometry is damaged: it ends too early");
  EXPECT_EQ(geometry("gp(many('<', wkb('<', 1, 1, 2))[:-9] + b'x')"),
            " layer a, row 1: its geometry is damaged: it ends too early");
  EXPECT_EQ(geometry("gp(struct.pack('<BII', 1, 4, 4294967295))"),
            " layer a, row 1: its geometry is damaged: it ends too early");
  EXPECT_EQ(geometry("gp(wkb('<', 1, float('inf'), 1))"), " layer a, row 1: its place inf, 1 is not finite");
  EXPECT_EQ(bad("b.gpkg", "x,y\n1,2\n"), " is no GeoPackage: it does not begin with \"SQLite format 3\"");
  EXPECT_THAT(bad("c.gpkg", "SQLite format 3" + std::string(2000, '\0')), HasSubstr(" cannot be read: "));
  const std::string whole = contents(path("a.gpkg"));
  EXPECT_THAT(bad("d.gpkg", whole.substr(0, whole.size() / 2)), HasSubstr(" cannot be read: "));
  python(
      "import os, sqlite3\ndb = sqlite3.connect('e.gpkg')\ndb.execute('CREATE TABLE a (b)')\ndb.commit()\n");
  EXPECT_EQ(badFile(path("e.gpkg")), " cannot be read: no such table: gpkg_contents");
}

/// A view of a table a of points.
std::string viewOf(const std::string& sql) {
  return R"(layer('a', 'LINESTRING', 0, ', name TEXT', [(k, gp(wkb('<', 1, k, -k)), ' n%d ' % k) for k in range(200)])
db.execute('INSERT INTO gpkg_contents VALUES ("v", "features")')
db.execute('INSERT INTO gpkg_geometry_columns VALUES ("v", "geom", "POINT", 0, 0, 0)')
db.execute("""CREATE VIEW v AS )" +
         sql + R"(""")
)";
}

TEST_F(GeoPackage, viewsAreLayersAsWell) {
  const SiteTable table = read(viewOf(R"(SELECT row_number() OVER () AS n, geom, name FROM a
    WHERE name LIKE ' n1%' AND fid < 12 AND replace(trim(name), 'n', '') < '2' ORDER BY upper(name) DESC)"));
  EXPECT_THAT(table.sites.x, ElementsAre(11, 10, 1));
  EXPECT_THAT(textsOf(table), ElementsAre("name (text):  n11 ,  n10 ,  n1 "));
}

TEST_F(GeoPackage, viewsThatAskForMuchAreRefused) {
  EXPECT_EQ(refusal(viewOf("WITH RECURSIVE c(n) AS (SELECT 1 UNION ALL SELECT n + 1 FROM c) "
                           "SELECT geom, n FROM c, a ORDER BY n")),
            " cannot be read: a view in it is recursive, and may never end; save the layer as a table");
  EXPECT_EQ(
      refusal(viewOf("SELECT geom, randomblob(1000000) AS r FROM a")),
      " cannot be read: SQL in it calls randomblob, which is left to no file; save the layer as a table");
  // What is sorted would go to files beside memory.
  EXPECT_EQ(refusal(viewOf("SELECT a.geom, replace(a.name || b.name || c.name, 'n', 'm') AS t "
                           "FROM a, a b, a c ORDER BY t")),
            " cannot be read: it asks for more memory than a file of its size has");
  EXPECT_EQ(refusal(viewOf(
                "SELECT geom FROM a WHERE trim(name, printf('%3000s', 1) || printf('%3000s', 1)) <> ''")),
            " cannot be read: string or blob too big");
}

TEST_F(GeoPackage, modeWalLeavesNothingBesideIt) {
  python(script(R"(db.execute('PRAGMA journal_mode = WAL')
layer('a', 'POINT', 0, '', [(1, gp(wkb('<', 1, 1, 2)))]))"));
  EXPECT_THAT(goodFile(path("a.gpkg")).sites.x, ElementsAre(1));
  EXPECT_FALSE(std::filesystem::exists(path("a.gpkg-wal")));
  EXPECT_FALSE(std::filesystem::exists(path("a.gpkg-shm")));
}

}  // namespace
}  // namespace vorpipe::test

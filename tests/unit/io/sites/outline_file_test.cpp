#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/base/output_file.h"
#include "io/pictures/png_file.h"
#include "io/sites/density_file.h"
#include "io/sites/outline_file.h"
#include "unit/fixtures/temporary_directory.h"

namespace vorpipe::test {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

class OutlineFile : public InTemporaryDirectory {
 protected:
  [[nodiscard]] Outline read(std::string_view name, std::string_view text) const {
    const auto outline = readOutline(write(name, text));
    EXPECT_TRUE(outline) << outline.error().message;
    return outline ? outline->outline : Outline{};
  }

  /// What is wrong, after the file's name.
  [[nodiscard]] std::string refusal(std::string_view name, std::string_view text) const {
    const std::string file = write(name, text);
    const auto outline = readOutline(file);
    if (outline) return "accepted";
    EXPECT_EQ(outline.error().code, ErrorCode::input);
    EXPECT_THAT(outline.error().message, testing::StartsWith(file + ":"));
    EXPECT_THAT(outline.error().message, testing::Not(HasSubstr("\n")));
    return outline.error().message.substr(file.size() + 1);
  }
};

using Offsets = std::vector<std::uint64_t>;

TEST_F(OutlineFile, geoJsonPolygonsAndWhatHoldsThem) {
  const std::string ring = "[[0,0],[4,0],[4,4.5,100],[0,0]]", hole = "[[1,1],[2,1],[2,2],[1,1]]";
  const std::string polygon = "{\"type\":\"Polygon\",\"coordinates\":[" + ring + "," + hole + "]}";
  const Outline one = read("a.geojson", polygon);
  EXPECT_EQ(one.ring_offsets, (Offsets{0, 3, 6}));
  EXPECT_EQ(one.polygon_offsets, (Offsets{0, 2}));
  EXPECT_EQ(one.points[2].x, 4);
  EXPECT_EQ(one.points[2].y, 4.5);
  const Outline several =
      read("b.JSON", "{\"type\":\"MultiPolygon\",\"coordinates\":[[" + ring + "],[" + hole + "]]}");
  EXPECT_EQ(several.polygon_offsets, (Offsets{0, 1, 2}));
  const std::string feature = "{\"type\":\"Feature\",\"properties\":{},\"geometry\":" + polygon + "}";
  EXPECT_EQ(read("c.json", feature).ring_offsets, one.ring_offsets);
  const Outline all =
      read("d.json", "{\"type\":\"FeatureCollection\",\"features\":[" + feature +
                         ",{\"type\":\"Feature\",\"geometry\":{\"type\":\"GeometryCollection\","
                         "\"geometries\":[" +
                         polygon + "]}}]}");
  EXPECT_EQ(all.polygon_offsets, (Offsets{0, 2, 4}));
}

TEST_F(OutlineFile, aByteOrderMarkIsNoPartOfIt) {
  const std::string mark = "\xEF\xBB\xBF", ring = "((0 0, 1 0, 1 1, 0 0))";
  EXPECT_EQ(read("a.wkt", mark + "POLYGON " + ring).points.size(), 3u);
  EXPECT_THAT(refusal("a.wkt", mark + "POINT " + ring), testing::StartsWith("1:1: \"POINT\""));
  EXPECT_EQ(
      read("a.json", mark + R"({"type":"Polygon","coordinates":[[[0,0],[4,0],[4,4],[0,0]]]})").points.size(),
      3u);
}

TEST_F(OutlineFile, featuresWithoutAPlaceAreSkipped) {
  const std::string none = R"({"type":"Feature","properties":{},"geometry":null})";
  const std::string some = R"({"type":"Feature","geometry":{"type":"Polygon","coordinates":)"
                           R"([[[0,0],[4,0],[4,4],[0,0]]]}})";
  const auto collection = [](const std::string& features) {
    return R"({"type":"FeatureCollection","features":[)" + features + "]}";
  };
  EXPECT_EQ(read("a.geojson", collection(none + "," + some + "," + none)).polygon_offsets, (Offsets{0, 1}));
  EXPECT_THAT(refusal("a.geojson", collection(none)), EndsWith("holds no polygon"));
  EXPECT_THAT(refusal("a.geojson", none), EndsWith("holds no polygon"));
}

TEST_F(OutlineFile, geoJsonErrorsNameThePlace) {
  EXPECT_EQ(refusal("a.json", "{\"type\":\n  \"Polygon\",]"), "2:13: is no JSON from here on");
  EXPECT_EQ(refusal("a.json", ""), "1:1: is no JSON from here on");
  EXPECT_THAT(refusal("a.json", "[1]"), HasSubstr("the top object: a array, not an object"));
  EXPECT_THAT(refusal("a.json", R"({"type":"Point","coordinates":[1,2]})"), HasSubstr("is a \"Point\""));
  EXPECT_THAT(refusal("a.json", R"({"type":"Polygon"})"), HasSubstr("has no \"coordinates\""));
  EXPECT_THAT(refusal("a.json", R"({"type":"Polygon","coordinates":[[[0,0],[1,0],["x",1],[0,0]]]})"),
              HasSubstr("coordinates[0][2]: no position"));
  EXPECT_THAT(refusal("a.json", R"({"type":"Polygon","coordinates":[[[0,0],[1,0],[0,0]]]})"),
              HasSubstr("coordinates[0]: the ring has 3 positions"));
  EXPECT_THAT(refusal("a.json", R"({"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1],[0,1]]]})"),
              HasSubstr("coordinates[0]: the ring is not closed: it begins at 0 0 and ends at 0 1"));
  EXPECT_THAT(
      refusal("a.json", R"({"type":"FeatureCollection","features":[{"type":"Feature","geometry":1}]})"),
      HasSubstr("features[0].geometry: a number, not an object"));
  EXPECT_THAT(refusal("a.json", R"({"type":"Feature"})"), HasSubstr("has no \"geometry\""));
  EXPECT_THAT(refusal("a.json", R"({"type":"FeatureCollection","features":[]})"),
              EndsWith("holds no polygon"));
  EXPECT_EQ(refusal("a.json", "{\"type\":\"Polygon\",\n \"coordinates\":[[[0,0],[-1e999,0],[1,1],[0,0]]]}"),
            "2:25: the number is too large for a double");
  std::string deep;
  for (int k = 0; k < 50; ++k) deep += R"({"type":"GeometryCollection","geometries":[)";
  for (int k = 0; k < 50; ++k) deep += "]}";
  EXPECT_THAT(refusal("a.json", deep), HasSubstr("stands in more than 32 collections"));
  EXPECT_EQ(refusal("a.json", std::string(100000, '[')), "1:201: stands in more than 200 lists and objects");
}

TEST_F(OutlineFile, wktPolygons) {
  const Outline one = read("a.wkt", "polygon z((0 0 7,4 0 7,4 4.5e0 7,0 0 7),\n(1 1 7,2 1 7,2 2 7,1 1 7))\n");
  EXPECT_EQ(one.ring_offsets, (Offsets{0, 3, 6}));
  EXPECT_EQ(one.polygon_offsets, (Offsets{0, 2}));
  EXPECT_EQ(one.points[2].y, 4.5);
  const Outline several =
      read("a.wkt",
           "SRID=4326;MULTIPOLYGON (((0 0, 1 0, 1 1, 0 0)), EMPTY, ((5 5, 6 5, 6 6, 5 5)))\n"
           "POLYGON((8 8,9 8,9 9,8 8))");
  EXPECT_EQ(several.polygon_offsets, (Offsets{0, 1, 2, 3}));
  EXPECT_EQ(several.points[6].x, 8);
}

TEST_F(OutlineFile, wktErrorsNameThePlace) {
  EXPECT_EQ(refusal("a.wkt", "LINESTRING (0 0, 1 1)"),
            "1:1: \"LINESTRING\", where POLYGON or MULTIPOLYGON is needed");
  EXPECT_THAT(refusal("a.wkt", "POLYGON ((0 0, 1 x, 1 1, 0 0))"), testing::StartsWith("1:18: "));
  EXPECT_EQ(refusal("a.wkt", "POLYGON\n ((0 0, 1 0, 1 1, 0 0"),
            "2:22: the text ends, where \",\" or \")\" is needed");
  EXPECT_EQ(refusal("a.wkt", "POLYGON ((0 0, 1, 1 1, 0 0))"), "1:17: \",\", where a number is needed");
  EXPECT_THAT(refusal("a.wkt", "POLYGON ((0 0, 1 0, 1 1, 0 1))"), HasSubstr("1:10: the ring is not closed"));
  EXPECT_THAT(refusal("a.wkt", "POLYGON EMPTY"), EndsWith("holds no polygon"));
  EXPECT_THAT(refusal("a.txt", ""), HasSubstr("unknown kind of file"));
  EXPECT_THAT(readOutline(path("none.wkt")).error().message, HasSubstr("cannot be read"));
}

TEST_F(OutlineFile, wktCollectionsAreWhatIsInThem) {
  const Outline all = read("a.wkt",
                           "GEOMETRYCOLLECTION (\nPOLYGON ((0 0, 1 0, 1 1, 0 0)),\nPOLYGON EMPTY,\n"
                           "GEOMETRYCOLLECTION (MULTIPOLYGON (((5 5, 6 5, 6 6, 5 5))))\n)\n");
  EXPECT_EQ(all.polygon_offsets, (Offsets{0, 1, 2}));
  EXPECT_THAT(refusal("a.wkt", "GEOMETRYCOLLECTION (POINT (1 1))"), HasSubstr("1:21: \"POINT\""));
  std::string deep;
  for (int k = 0; k < 50; ++k) deep += "GEOMETRYCOLLECTION (";
  EXPECT_THAT(refusal("a.wkt", deep), HasSubstr("stands in more than 32 collections"));
}

TEST_F(OutlineFile, geoJsonLinesHaveAnObjectEach) {
  const std::string polygon = R"({"type":"Polygon","coordinates":[[[0,0],[4,0],[4,4],[0,0]]]})";
  const std::string feature = R"({"type":"Feature","properties":{},"geometry":)" + polygon + "}";
  for (const char* name : {"a.geojsonl", "a.geojsons", "a.ndjson"}) {
    EXPECT_EQ(read(name, "\x1E" + feature + "\n\n" + polygon + "\n").polygon_offsets, (Offsets{0, 1, 2}));
  }
  EXPECT_THAT(refusal("a.geojsonl", feature + "\n{\"type\":\"Point\"}\n"),
              testing::StartsWith("2: the top object: is a \"Point\""));
}

TEST_F(OutlineFile, theirSystemIsWhatTheySayOrAFileBesideThem) {
  const auto system = [&](const std::string& name, const std::string& text) {
    const auto outline = readOutline(write(name, text));
    EXPECT_TRUE(outline) << outline.error().message;
    return outline ? nameOf(outline->system) : std::string();
  };
  const std::string members = R"("type":"Polygon","coordinates":[[[0,0],[4,0],[4,4],[0,0]]])";
  const std::string crs = R"("crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::25832"}},)";
  const std::string ring = "POLYGON ((0 0, 1 0, 1 1, 0 0))";
  EXPECT_EQ(system("a.json", "{" + members + "}"), "EPSG:4326");
  EXPECT_EQ(system("a.json", "{" + crs + members + "}"), "EPSG:25832");
  EXPECT_EQ(system("a.geojsonl", "{" + members + "}"), "EPSG:4326");
  EXPECT_EQ(system("a.json", R"({"type":"Polygon","coordinates":[[[0,0],[400,0],[4,4],[0,0]]]})"),
            "a system that nothing names");
  EXPECT_EQ(system("a.wkt", "SRID=25832;" + ring), "EPSG:25832");
  EXPECT_EQ(system("a.wkt", ring), "a system that nothing names");
  write("a.prj", R"(PROJCS["ETRS_1989_UTM_Zone_32N",GEOGCS["GCS_ETRS_1989",DATUM["D"]],UNIT["Meter",1.0]])");
  EXPECT_EQ(system("a.wkt", ring), "EPSG:25832");
  EXPECT_THAT(refusal("a.wkt", "SRID=1;" + ring + "SRID=2;" + ring), HasSubstr("is of SRID 2"));
  write("b.prj", "nothing of the kind");
  EXPECT_THAT(readOutline(write("b.wkt", ring)).error().message, EndsWith("is no coordinate system in WKT"));
}

TEST_F(OutlineFile, itsFeaturesArePartsByName) {
  const auto feature = [](const std::string& name, int x, const std::string& more = {}) {
    const std::string ring = fmt::format("[[{0},0],[{1},0],[{1},1],[{0},0]]", x, x + 1);
    return R"({"type":"Feature","properties":{"name":)" + name +
           R"(},"geometry":{"type":"MultiPolygon","coordinates":[[)" + ring + "]" + more + "]}}";
  };
  const std::string file =
      write("a.geojsonl", feature(R"("a")", 0) + "\n" + feature("null", 2, ",[[[9,9],[10,9],[9,10],[9,9]]]") +
                              "\n" + feature(R"("a")", 4) + "\n" +
                              R"({"type":"Feature","properties":{"name":"b"},"geometry":null})");
  const auto read = readOutline(file, {}, FeatureAttributes::kept);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->feature_polygons, (Offsets{0, 1, 3, 4, 4}));
  const auto parts = outlinesBy(*read, "name");
  ASSERT_TRUE(parts) << parts.error().message;
  ASSERT_EQ(parts->outlines.size(), 2u);
  EXPECT_EQ(parts->names.at(0), "a");
  EXPECT_EQ(parts->names.at(1), std::nullopt);
  EXPECT_EQ(parts->same, 1u);
  EXPECT_EQ(parts->empty, 1u);
  EXPECT_EQ(outlinesBy(*read, "NAME")->names.name(), "name");
  EXPECT_EQ(parts->outlines[0].polygon_offsets, (Offsets{0, 1, 2}));
  EXPECT_EQ(parts->outlines[0].ring_offsets, (Offsets{0, 3, 6}));
  EXPECT_EQ(parts->outlines[0].points[3], (Point{4, 0}));
  EXPECT_EQ(parts->outlines[1].polygon_offsets, (Offsets{0, 1, 2}));
  EXPECT_EQ(outlinesBy(*read, "nam").error().message,
            "its features have no attribute \"nam\"; they have \"name\"");
  EXPECT_TRUE(readOutline(file)->attributes.empty());
}

class DensityFile : public InTemporaryDirectory {
 protected:
  /// A .npy of 2 rows and 4 columns.
  [[nodiscard]] std::string eightPixels(const std::string& name) const {
    std::string header = "{'descr': '|u1', 'fortran_order': False, 'shape': (2, 4), }";
    header.resize(117, ' ');
    return write(name, std::string("\x93NUMPY\x01\x00\x76\x00", 10) + header + "\n" +
                           std::string("\x01\x02\x03\x04\x05\x06\x07\x08"));
  }
};

TEST_F(DensityFile, aWorldFileBesideItSaysWhereItsPixelsLie) {
  const std::string file = eightPixels("a.npy");
  ASSERT_TRUE(readDensity(file)) << readDensity(file).error().message;
  EXPECT_FALSE(readDensity(file)->density.box);
  write("a.wld", "100\n0\n0\n-50\n1050\n1975\n");
  const auto placed = readDensity(file);
  ASSERT_TRUE(placed) << placed.error().message;
  ASSERT_TRUE(placed->density.box);
  const auto [xmin, ymin, xmax, ymax] = *placed->density.box;
  EXPECT_EQ(xmin, 1000);
  EXPECT_EQ(xmax, 1400);
  EXPECT_EQ(ymax, 2000);
  EXPECT_EQ(ymin, 1900);
  const auto refused = [&](const std::string& text) {
    write("a.wld", text);
    const auto density = readDensity(file);
    return density ? std::string("accepted") : density.error().message;
  };
  EXPECT_THAT(refused("100\n1\n0\n-50\n0\n0\n"), EndsWith("a.wld: turns the pixels"));
  EXPECT_THAT(refused("100\n0\n0\n50\n0\n0\n"), HasSubstr("rows count from the top"));
  EXPECT_THAT(refused("100\n0\n0\n"), EndsWith("has 3 numbers; a world file has 6"));
  EXPECT_THAT(refused("100\n0\nx\n"), HasSubstr("a.wld:3:1: "));
  // A box that is named stands for what lies beside.
  EXPECT_EQ(readDensity(file, Box{1, 2, 3, 4})->density.box->xmin, 1);
  EXPECT_THAT(readDensity(path("a.tif")).error().message, HasSubstr("gdal_translate"));
}

TEST_F(DensityFile, whatGdalWritesBesideItSaysWhereItsPixelsLie) {
  const std::string file = eightPixels("b.npy");
  const std::string head = "<PAMDataset>\n  <PAMRasterBand band=\"1\"><SRSX/></PAMRasterBand>\n";
  const auto withAux = [&](const std::string& text) {
    write("b.npy.aux.xml", head + text + "</PAMDataset>\n");
    return readDensity(file);
  };
  EXPECT_FALSE(withAux("")->density.box);
  const std::string transform =
      "<GeoTransform>  1.0e+03,  1e+02, 0.0,\n 2.0e+03, 0.0, -5.0e+01</GeoTransform>";
  const auto placed = withAux(
      "<SRS dataAxisToSRSAxisMapping=\"1,2\">PROJCS[&quot;ETRS89 / UTM zone "
      "32N&quot;,GEOGCS[&quot;ETRS89&quot;],"
      "AUTHORITY[&quot;EPSG&quot;,&quot;25832&quot;]]</SRS>" +
      transform);
  ASSERT_TRUE(placed) << placed.error().message;
  ASSERT_TRUE(placed->density.box);
  const auto [xmin, ymin, xmax, ymax] = *placed->density.box;
  EXPECT_EQ((std::array{xmin, ymin, xmax, ymax}), (std::array{1000.0, 1900.0, 1400.0, 2000.0}));
  EXPECT_EQ(placed->system.code, 25832);
  EXPECT_THAT(withAux(transform + "<SRS>apples</SRS>").error().message,
              HasSubstr("b.npy.aux.xml: its SRS: \"apples\" is no system"));
  EXPECT_THAT(withAux("<GeoTransform>1,1,0</GeoTransform>").error().message,
              HasSubstr("b.npy.aux.xml: its GeoTransform: empty field"));
  EXPECT_THAT(withAux("<GeoTransform>1,1,0.5,1,0,-1</GeoTransform>").error().message,
              HasSubstr("turns the pixels"));
  // A world file is what people make; the system is GDAL's all the same.
  write("b.wld", "1\n0\n0\n-1\n0.5\n1.5\n");
  EXPECT_EQ(withAux("<SRS>EPSG:25832</SRS>" + transform)->density.box->xmax, 4);
  EXPECT_EQ(readDensity(file)->system.code, 25832);
}

TEST_F(DensityFile, darkPixelsAreDense) {
  auto file = OutputFile::create(path("a.png"));
  ASSERT_TRUE(file &&
              writePng(*file, 3, 2,
                       std::vector<std::uint32_t>{0xFF000000u, 0xFFFFFFFFu, 0xFF333333u, 0x00000000u,
                                                  0x80000000u, 0xFF0000FFu}) &&
              file->commit());
  const auto density = readDensity(path("a.png"));
  ASSERT_TRUE(density) << density.error().message;
  EXPECT_EQ(density->density.width, 3);
  EXPECT_EQ(density->density.height, 2);
  EXPECT_EQ(density->density.values[0], 1);
  EXPECT_EQ(density->density.values[1], 0);
  EXPECT_DOUBLE_EQ(density->density.values[2], 0.8);
  EXPECT_EQ(density->density.values[3], 0);
  EXPECT_DOUBLE_EQ(density->density.values[4], 128 / 255.0);
  EXPECT_DOUBLE_EQ(density->density.values[5], 1 - 0.2126);
}

TEST_F(DensityFile, sixteenBitsAreKept) {
  if (!numpy(
          "import zlib, struct\n"
          "def chunk(kind, data):\n"
          "  return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))\n"
          "rows = b'\\0' + struct.pack('>HH', 65535, 1) + b'\\0' + struct.pack('>HH', 0, 32768)\n"
          "open('b.png', 'wb').write(b'\\x89PNG\\r\\n\\x1a\\n' + chunk(b'IHDR', struct.pack('>IIBBBBB', 2, "
          "2, 16, "
          "0, 0, 0, 0)) + chunk(b'IDAT', zlib.compress(rows)) + chunk(b'IEND', b''))\n")) {
    GTEST_SKIP() << without_numpy;
  }
  const auto density = readDensity(path("b.png"));
  ASSERT_TRUE(density) << density.error().message;
  EXPECT_EQ(density->density.values[0], 0);
  EXPECT_DOUBLE_EQ(density->density.values[1], 65534 / 65535.0);
  EXPECT_EQ(density->density.values[2], 1);
  EXPECT_DOUBLE_EQ(density->density.values[3], 32767 / 65535.0);
}

TEST_F(DensityFile, arraysAreTakenAsTheyAre) {
  if (!numpy("np.save('a.npy', np.array([[1, 2.5, 3], [4, 5, 6]]))\n"
             "np.save('b.npy', np.asfortranarray(np.array([[1, 2, 3], [4, 5, 6]], dtype=np.uint16)))\n"
             "np.save('c.npy', np.array([[1, -2.5]], dtype=np.float32))\n"
             "np.save('d.npy', np.array([1, 2, 3.0]))\n")) {
    GTEST_SKIP() << without_numpy;
  }
  const auto a = readDensity(path("a.npy"));
  ASSERT_TRUE(a) << a.error().message;
  EXPECT_EQ(a->density.width, 3);
  EXPECT_EQ(a->density.height, 2);
  EXPECT_EQ(a->density.values, (std::vector<double>{1, 2.5, 3, 4, 5, 6}));
  const auto b = readDensity(path("b.npy"));
  ASSERT_TRUE(b) << b.error().message;
  EXPECT_EQ(b->density.values, (std::vector<double>{1, 2, 3, 4, 5, 6}));
  EXPECT_THAT(readDensity(path("c.npy")).error().message,
              HasSubstr("element [0, 1] (counted from 0) is -2.5"));
  EXPECT_THAT(readDensity(path("d.npy")).error().message, HasSubstr("(H, W)"));
  EXPECT_THAT(readDensity(path("d.txt")).error().message, HasSubstr("unknown kind"));
}

}  // namespace
}  // namespace vorpipe::test

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "io/sites/site_source.h"
#include "io/sites/sites_file.h"
#include "support/sites/real_sets.h"
#include "unit/fixtures/another_user.h"
#include "unit/fixtures/temporary_directory.h"

namespace vorpipe::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr auto unknown_kind =
    " unknown kind of file; known are .csv, .tsv, .xyz, .txt, .npy, .geojson, .json, .geojsonl, .geojsons, "
    ".ndjson, "
    ".wkt, .gpkg, .shp";

class SitesFile : public InTemporaryDirectory {
 protected:
  [[nodiscard]] std::string bad(std::string_view name, std::string_view bytes) const {
    const std::string file = write(name, bytes);
    const auto sites = readSites(file);
    if (sites) {
      ADD_FAILURE() << "was accepted: " << bytes;
      return "";
    }
    EXPECT_EQ(sites.error().code, ErrorCode::input);
    return sites.error().message.substr(std::min(file.size() + 1, sites.error().message.size()));
  }
};

TEST_F(SitesFile, ReadsTextOfTwoColumns) {
  const auto sites = readSites(write("a.txt", "# note\n1 2\n\n\t3,4 # note\r\n  +5 ,\t6\n7\t8"));
  ASSERT_TRUE(sites) << sites.error().message;
  EXPECT_THAT(sites->sites.x, ElementsAre(1, 3, 5, 7));
  EXPECT_THAT(sites->sites.y, ElementsAre(2, 4, 6, 8));
  EXPECT_TRUE(sites->sites.weight.empty());
}

TEST_F(SitesFile, TheThirdColumnOfTextIsTheWeight) {
  const auto sites = readSites(write("a.XYZ", "1 2 -3\n4 5 6\n"));
  ASSERT_TRUE(sites) << sites.error().message;
  EXPECT_THAT(sites->sites.weight, ElementsAre(-3, 6));
}

TEST_F(SitesFile, AFirstLineOfTextWithoutNumbersNamesItsColumns) {
  const auto sites = readSites(write("a.txt", "# note\nname  LAT lon radius\nA 1 2 3\nB 4 5 6\n"));
  ASSERT_TRUE(sites) << sites.error().message;
  EXPECT_THAT(sites->sites.x, ElementsAre(2, 5));
  EXPECT_THAT(sites->sites.y, ElementsAre(1, 4));
  EXPECT_THAT(sites->sites.weight, ElementsAre(9, 36));
  EXPECT_EQ(sites->system.kind, CoordinateKind::degrees);
  ASSERT_EQ(sites->attributes.size(), 1u);
  EXPECT_EQ(sites->attributes[0].name(), "name");
  EXPECT_EQ(sites->attributes[0].at(1), "B");
  const auto chosen = readSites(write("b.txt", "east,north\n1,2\n3,4\n"), {.columns = {"north", "east"}});
  ASSERT_TRUE(chosen) << chosen.error().message;
  EXPECT_THAT(chosen->sites.x, ElementsAre(2, 4));
}

TEST_F(SitesFile, TheSystemBesideAFileIsItsOwn) {
  const std::string file = write("a.csv", "x,y\n1,2\n3,4\n");
  write("a.prj", R"(PROJCS["ETRS89 / UTM zone 33N",GEOGCS["ETRS89"],AUTHORITY["EPSG","25833"]])");
  const auto sites = readSites(file);
  ASSERT_TRUE(sites) << sites.error().message;
  EXPECT_EQ(nameOf(sites->system), "EPSG:25833");
  write("a.csv", "lon,lat\n1,2\n3,4\n");
  const auto other = readSites(file);
  ASSERT_FALSE(other);
  EXPECT_THAT(other.error().message, testing::HasSubstr("a.prj: says EPSG:25833, and "));
}

TEST_F(SitesFile, RefusesTextWithFileLineAndColumn) {
  EXPECT_THAT(bad("a.txt", "here there\n1 2\n"), testing::StartsWith("1:1: "));
  EXPECT_EQ(bad("a.txt", "1 2\n3  four\n"), "2:4: \"four\" is not a number (column y)");
  EXPECT_EQ(bad("a.txt", "1 2\n# x\n nan 4\n"),
            "3:2: \"nan\" is no value; --missing skip leaves such rows out (column x)");
  EXPECT_EQ(bad("a.txt", "1 2 1e999\n"), "1:5: \"1e999\" is out of the range of a double (column weight)");
  EXPECT_EQ(bad("a.txt", "1,,2\n"), "1:3: empty field; --missing skip leaves such rows out (column y)");
  EXPECT_EQ(bad("a.txt", "1, #2\n"), "1:3: empty field; --missing skip leaves such rows out (column y)");
  EXPECT_EQ(bad("a.txt", ",1\n"), "1:1: empty field; --missing skip leaves such rows out (column x)");
  EXPECT_EQ(bad("a.txt", "1\n"), "1:1: the row has 1 field; x y or x y weight is needed, or --columns");
  EXPECT_EQ(bad("a.txt", "1 2 3 4\n"),
            "1:1: the row has 4 fields; x y or x y weight is needed, or --columns");
  EXPECT_EQ(bad("a.txt", "1 2\n1 2 3\n"), "2:1: the row has 3 fields, the rows before it 2");
  EXPECT_EQ(bad("a.txt", ""), " holds no sites");
  EXPECT_EQ(bad("a.txt", "# nothing\n"), " holds no sites");
}

TEST_F(SitesFile, RefusesTextWhoseCommasMayBeDecimal) {
  const std::string both =
      "the row has commas and blanks between its fields, so that nothing tells which commas are decimal; "
      "keep one of them, and write 1.5, not 1,5";
  EXPECT_EQ(bad("a.txt", "1,5 2,5\n"), "1:4: " + both);
  EXPECT_EQ(bad("a.xyz", "1 2\n 1,5 2\n"), "2:5: " + both);
  EXPECT_EQ(bad("a.xyz", "1\t2,5\n"), "1:4: " + both);
}

TEST_F(SitesFile, RefusesPaths) {
  EXPECT_EQ(readSites(path("no.csv")).error().message,
            path("no.csv") + ": cannot be read: No such file or directory");
  EXPECT_EQ(readSites(path("")).error().message, path("") + ": is a directory; a file is needed");
  EXPECT_EQ(bad("a.dat", "1 2\n"), unknown_kind);
  EXPECT_EQ(bad("csv", "x,y\n1,2\n"), unknown_kind);
}

TEST_F(SitesFile, RefusesAFileWithoutPermission) {
  const AnotherUser user(directory());
  if (!user.whyNot().empty()) GTEST_SKIP() << user.whyNot();
  const std::string file = write("a.csv", "x,y\n1,2\n");
  ::chmod(file.c_str(), 0);
  EXPECT_EQ(readSites(file).error().message, file + ": cannot be read: Permission denied");
}

TEST_F(SitesFile, ReadsFromAPipe) {
  const std::string fifo = path("sites.csv");
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  ASSERT_EQ(std::system(("printf 'x,y\\n1,2\\n' > '" + fifo + "' &").c_str()), 0);
  const auto sites = readSites(fifo);
  ASSERT_TRUE(sites) << sites.error().message;
  EXPECT_THAT(sites->sites.x, ElementsAre(1));
}

TEST_F(SitesFile, ReadsTheRealSets) {
  for (const RealSet& set : realSets()) {
    SCOPED_TRACE(set.path);
    std::ifstream in(set.path);
    std::size_t lines = 0;
    for (std::string line; std::getline(in, line);) lines += line.find_first_not_of(" \t\r") != line.npos;
    const auto sites = readSites(set.path);
    ASSERT_TRUE(sites) << sites.error().message;
    EXPECT_EQ(sites->sites.size(), lines - 1);
  }
}

TEST_F(SitesFile, LoadSitesTakesGeneratorsAndFiles) {
  const auto generated = loadSites("random:7", 3);
  ASSERT_TRUE(generated) << generated.error().message;
  EXPECT_EQ(generated->table.sites.size(), 7u);
  EXPECT_EQ(generated->generator->seed, 3u);
  EXPECT_EQ(generated->table.sites.x, generate(Pattern::random, 7, 3).x);
  for (const char* spec : {"square:9", "hex:9", "jitter:9", "clusters:9", "circle:9"}) {
    EXPECT_TRUE(loadSites(spec, 1)) << spec;
  }
  const auto read = loadSites(write("a.csv", "x,y\n1,2\n"), 3);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_FALSE(read->generator);
}

TEST_F(SitesFile, LoadSitesRefusesNumbersOfSites) {
  for (const char* count :
       {"0", "-1", "+5", "1e6", "1.5", "", " 5", "5 ", "abc", "4294967295", "99999999999999999999"}) {
    const auto loaded = loadSites(std::string("random:") + count, 1);
    ASSERT_FALSE(loaded) << count;
    EXPECT_EQ(loaded.error().code, ErrorCode::input);
    EXPECT_EQ(loaded.error().message, std::string("random:") + count + ": \"" + count +
                                          "\" is not a number of sites; it must be a whole number from 1 to "
                                          "2147483647");
  }
}

TEST_F(SitesFile, LoadSitesExplainsOtherNames) {
  EXPECT_EQ(loadSites("hex", 1).error().message, "hex: a generator needs a number of sites, as in hex:1000");
  EXPECT_EQ(loadSites("randm:5", 1).error().message,
            "randm:5: is neither a file nor a generator (random, square, hex, jitter, clusters, circle; "
            "icosahedral, fibonacci with --globe)");
  EXPECT_THAT(loadSites("./random:5", 1).error().message, HasSubstr("is neither a file"));
}

TEST(GeneratedCount, IsKnownBeforeTheSites) {
  EXPECT_EQ(generatedCount("random:12"), 12u);
  EXPECT_EQ(generatedCount("hex:2000000000"), 2'000'000'000u);
  for (const char* spec : {"random:", "random:0", "random:x", "random", "other:3", "a.csv", "-", ""}) {
    EXPECT_EQ(generatedCount(spec), std::nullopt) << spec;
  }
}

}  // namespace
}  // namespace vorpipe::test

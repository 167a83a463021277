#include "io/base/input_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <string>
#include <string_view>

#include "io/base/extension.h"
#include "io/sites/outline_file.h"
#include "io/sites/weights_file.h"
#include "unit/io/sites/sites_fixture.h"

namespace vorpipe::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Gzip : public SitesOfFiles {
 protected:
  /// What gzip makes of bytes.
  [[nodiscard]] std::string packed(std::string_view bytes) const {
    const std::string file = path("packed");
    gzFile to = gzopen(file.c_str(), "wb");
    gzwrite(to, bytes.data(), static_cast<unsigned>(bytes.size()));
    gzclose(to);
    return contents(file);
  }
};

TEST_F(Gzip, isInflatedWhateverTheName) {
  const std::string table = packed("x,y\n1,2\n3,4\n");
  for (const char* name : {"a.csv", "a.csv.gz", "A.CSV.GZ"}) {
    EXPECT_THAT(good(name, table).sites.x, ElementsAre(1, 3)) << name;
  }
  EXPECT_THAT(bad("a.gz", table), HasSubstr("unknown kind of file"));
  EXPECT_THAT(good("a.csv", packed("x,y\n1,2\n") + packed("3,4\n")).sites.x, ElementsAre(1, 3));
  EXPECT_THAT(good("a.geojson.gz", packed(R"({"type":"Point","coordinates":[1,2]})")).sites.x,
              ElementsAre(1));
  const std::string ring = "POLYGON ((0 0, 1 0, 1 1, 0 0))";
  EXPECT_TRUE(readOutline(write("o.wkt.gz", packed(ring))));
  EXPECT_EQ(readWeights(write("w.txt.gz", packed("5\n6\n")), 2)->size(), 2u);
}

TEST_F(Gzip, ofManyChunksIsWhole) {
  std::string bytes = "x,y\n";
  for (int k = 0; k < 300000; ++k) bytes += std::to_string(k) + "," + std::to_string(k % 1000) + "\n";
  const SiteTable table = good("a.csv.gz", packed(bytes));
  ASSERT_EQ(table.sites.size(), 300000u);
  EXPECT_EQ(table.sites.x[299999], 299999);
}

TEST_F(Gzip, thatIsDamagedIsRefused) {
  const std::string whole = packed("x,y\n1,2\n3,4\n");
  for (std::size_t size = 2; size < whole.size(); ++size) {
    EXPECT_EQ(bad("a.csv", whole.substr(0, size)), " is truncated: its gzip data end too early") << size;
  }
  std::string wrong = whole;
  wrong[wrong.size() - 8] ^= 1;
  EXPECT_EQ(bad("a.csv", wrong), " its gzip data are damaged: incorrect data check");
  EXPECT_THAT(bad("a.csv", whole + "more"), HasSubstr(" its gzip data are damaged"));
  EXPECT_THAT(bad("a.csv", whole.substr(0, 2) + "not gzip at all"), HasSubstr(" its gzip data are damaged"));
}

TEST_F(Gzip, ofArraysIsReadToItsEnd) {
  if (!numpy("np.save('a.npy', np.array([[1, 2], [3, 4.]]))\n")) GTEST_SKIP() << without_numpy;
  const std::string array = contents(path("a.npy")), whole = packed(array);
  EXPECT_THAT(good("b.npy.gz", whole).sites.x, ElementsAre(1, 3));
  EXPECT_EQ(bad("b.npy", packed(array + "x")), " is too long: bytes follow the last element of its array");
  EXPECT_THAT(bad("b.npy", packed(array.substr(0, array.size() - 1))),
              HasSubstr(" is truncated: its data end"));
  std::string wrong = whole;
  wrong[wrong.size() - 8] ^= 1;
  EXPECT_EQ(bad("b.npy", wrong), " its gzip data are damaged: incorrect data check");
}

TEST(Extension, ofAnInputIsThatBeforeGz) {
  EXPECT_EQ(inputExtension("a.b/x.CSV.gz"), ".csv");
  EXPECT_EQ(inputExtension("x.csv"), ".csv");
  EXPECT_EQ(inputExtension("x.gz"), "");
}

}  // namespace
}  // namespace vorpipe::test

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/npy_array.h"
#include "io/base/output_file.h"
#include "io/pictures/npy_ids.h"
#include "io/sites/sites_file.h"
#include "unit/fixtures/temporary_directory.h"

namespace vorpipe::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A .npy file of version 1 around a dictionary and data.
std::string npy(std::string_view dictionary, std::string_view data) {
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(dictionary.size() & 0xFF);
  bytes += static_cast<char>(dictionary.size() >> 8);
  return bytes.append(dictionary).append(data);
}

class Npy : public InTemporaryDirectory {
 protected:
  [[nodiscard]] std::string badSites(std::string_view bytes) const {
    const std::string file = write("sites.npy", bytes);
    const auto sites = readSites(file);
    if (sites) {
      ADD_FAILURE() << "was accepted";
      return "";
    }
    EXPECT_EQ(sites.error().code, ErrorCode::input);
    EXPECT_EQ(sites.error().message.find('\n'), std::string::npos);
    return sites.error().message.substr(std::min(file.size() + 2, sites.error().message.size()));
  }
};

TEST_F(Npy, ReadsWhatNumPyWrites) {
  if (!numpy("a = np.array([[1, 2, 3], [4.5, 5, 6], [7, 8, -9], [10, 11, 0]])\n"
             "n = 0\n"
             "for t in '<f8', '>f8', '<f4', '>f4':\n"
             "    for order in 'C', 'F':\n"
             "        for version in (1, 0), (2, 0), (3, 0):\n"
             "            with open(f'{n}.npy', 'wb') as f:\n"
             "                np.lib.format.write_array(f, np.array(a, t, order=order), version)\n"
             "            n += 1\n")) {
    GTEST_SKIP() << without_numpy;
  }
  for (int n = 0; n < 24; ++n) {
    SCOPED_TRACE(n);
    const auto sites = readSites(path(std::to_string(n) + ".npy"));
    ASSERT_TRUE(sites) << sites.error().message;
    EXPECT_THAT(sites->sites.x, ElementsAre(1, 4.5, 7, 10));
    EXPECT_THAT(sites->sites.y, ElementsAre(2, 5, 8, 11));
    EXPECT_THAT(sites->sites.weight, ElementsAre(3, 6, -9, 0));
  }
}

TEST_F(Npy, ReadsTwoColumnsInManyChunks) {
  if (!numpy("a = np.arange(400000.0).reshape(200000, 2)\n"
             "np.save('c.npy', a)\n"
             "np.save('f.npy', np.asfortranarray(a))\n")) {
    GTEST_SKIP() << without_numpy;
  }
  for (const char* name : {"c.npy", "f.npy"}) {
    const auto sites = readSites(path(name));
    ASSERT_TRUE(sites) << sites.error().message;
    ASSERT_EQ(sites->sites.size(), 200000u);
    ASSERT_EQ(sites->sites.y.size(), 200000u);
    EXPECT_TRUE(sites->sites.weight.empty());
    EXPECT_EQ(sites->sites.x[199999], 399998);
    EXPECT_EQ(sites->sites.y[100000], 200001);
  }
}

TEST_F(Npy, ReadsWholeNumbersAndBooleansInAnyOrder) {
  if (!numpy("a = np.array([[0, 1], [1, 0], [7, 3]])\n"
             "for kind in ('i1', 'i2', '<i4', '>i8', 'u1', '>u2', 'u4', 'u8', '>f4', '>f8'):\n"
             "  np.save(kind.strip('<>') + '.npy', np.asfortranarray(a.astype(kind)))\n"
             "np.save('b1.npy', a > 0)\n"
             "np.save('large.npy', np.array([[1, 2], [2**53 + 1, 3]]))\n")) {
    GTEST_SKIP() << without_numpy;
  }
  for (const char* name : {"i1", "i2", "i4", "i8", "u1", "u2", "u4", "u8", "f4", "f8", "b1"}) {
    const auto sites = readSites(path(std::string(name) + ".npy"));
    ASSERT_TRUE(sites) << sites.error().message;
    const bool is_bool = name[0] == 'b';
    EXPECT_THAT(sites->sites.x, ElementsAre(0, 1, is_bool ? 1 : 7)) << name;
    EXPECT_THAT(sites->sites.y, ElementsAre(1, 0, is_bool ? 1 : 3)) << name;
  }
  EXPECT_THAT(readSites(path("large.npy")).error().message,
              HasSubstr("element 2 (counted from 0) is 9007199254740993, above 2^53"));
}

TEST_F(Npy, RefusesOtherTypesAndShapes) {
  const std::string tail = "'fortran_order': False, 'shape': ";
  EXPECT_EQ(badSites(npy("{'descr': '<f2', " + tail + "(1, 2)}", std::string(4, '\0'))),
            "holds float16 (1, 2); numbers (N, 2) or (N, 3), float32, float64 or whole ones, are needed");
  EXPECT_EQ(badSites(npy("{'descr': '<f8', " + tail + "(2,)}", std::string(16, '\0'))),
            "holds float64 (2,); numbers (N, 2) or (N, 3), float32, float64 or whole ones, are needed");
  EXPECT_EQ(badSites(npy("{'descr': '<f8', " + tail + "(2, 1)}", std::string(16, '\0'))),
            "holds float64 (2, 1); numbers (N, 2) or (N, 3), float32, float64 or whole ones, are needed, or "
            "--columns");
  EXPECT_EQ(badSites(npy("{'descr': '|O', " + tail + "(1, 2)}", "pickle")),
            "holds elements of dtype \"|O\"; numbers are needed");
  EXPECT_THAT(
      badSites(npy("{'descr': [('x', '<f8'), ('y', '<f8')], " + tail + "(1,)}", std::string(16, '\0'))),
      HasSubstr("its .npy header is not understood: \"{'descr': [('x', '<f8')"));
  EXPECT_EQ(badSites(npy("{'descr': '<f8', " + tail + "(0, 2)}", "")), "holds no sites");
}

TEST_F(Npy, RefusesTruncatedAndDamagedFiles) {
  const std::string dictionary = "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2), }";
  const std::string whole = npy(dictionary, std::string(48, '\0'));
  ASSERT_TRUE(readSites(write("sites.npy", whole)));
  EXPECT_EQ(badSites(""), "is truncated: it holds 0 bytes, its .npy header needs 10");
  EXPECT_EQ(badSites(whole.substr(0, 9)), "is truncated: it holds 9 bytes, its .npy header needs 10");
  EXPECT_EQ(badSites(whole.substr(0, 20)), "is truncated: it holds 20 bytes, its .npy header needs 69");
  EXPECT_EQ(badSites(whole.substr(0, 100)),
            "is truncated: it holds 100 bytes, its header (float64 (3, 2)) needs 117");
  EXPECT_EQ(badSites(whole + "x"), "is too long: it holds 118 bytes, its header (float64 (3, 2)) needs 117");
  EXPECT_EQ(badSites("x,y\n1,2\n3,4\n"), "is not a .npy file: it does not begin with \\x93NUMPY");
  EXPECT_EQ(badSites(std::string("\x93NUMPY\x04\x00\x00\x00", 10)),
            "version 4 of .npy is not known; 1 to 3 are");
  EXPECT_THAT(badSites(npy("{'descr': '<f8', 'shape': (3, 2), }", "")), HasSubstr("is not understood"));
  EXPECT_THAT(badSites(npy("{'descr': '<f8', 'fortran_order': False, 'shape': (-3, 2)}", "")),
              HasSubstr("is not understood"));
  EXPECT_EQ(badSites(npy("{'descr': '<f8', 'fortran_order': False, 'shape': (9999999999999999999, 2)}", "")),
            "its .npy header claims an impossible size: float64 (9999999999999999999, 2)");
}

TEST_F(Npy, RefusesNumbersThatAreNotFinite) {
  const std::string nan("\0\0\xC0\x7F", 4), infinity("\0\0\x80\xFF", 4), zero(4, '\0');
  EXPECT_EQ(
      badSites(npy("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 2)}", zero + zero + zero + nan)),
      "element [1, 1] (counted from 0; column y) is nan, not a finite number");
  EXPECT_EQ(badSites(npy("{'descr': '<f4', 'fortran_order': True, 'shape': (2, 3)}",
                         zero + zero + zero + zero + zero + infinity)),
            "element [1, 2] (counted from 0; column weight) is -inf, not a finite number");
}

TEST_F(Npy, IdsComeBack) {
  const std::vector<std::uint32_t> ids = {0, 1, 2, 0xFFFFFFFFu, 70000, 0x01020304};
  auto file = OutputFile::create(path("ids.npy"));
  ASSERT_TRUE(file) << file.error().message;
  ASSERT_TRUE(writeNpyIds(*file, 3, 2, ids));
  ASSERT_TRUE(file->commit());
  EXPECT_EQ((contents(path("ids.npy")).size() - ids.size() * 4) % 64, 0u);
  const auto read = readNpyIds(path("ids.npy"));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->width, 3);
  EXPECT_EQ(read->height, 2);
  EXPECT_EQ(read->ids, ids);
  if (!numpy("a = np.load('ids.npy')\n"
             "assert a.dtype == np.uint32 and a.shape == (2, 3) and a.flags.c_contiguous\n"
             "assert a.tolist() == [[0, 1, 2], [4294967295, 70000, 0x01020304]]\n")) {
    GTEST_SKIP() << without_numpy;
  }
}

TEST_F(Npy, ReadsIdsOfEveryIntegerType) {
  if (!numpy("a = np.array([[0, 1, 2], [-1, 4, 5]])\n"
             "for t in 'i4', 'i8', 'u4':\n"
             "    for byte_order in '<>':\n"
             "        np.save(byte_order + t + '.npy', a.astype(byte_order + t))\n"
             "        np.save(byte_order + t + 'f.npy', np.asfortranarray(a.astype(byte_order + t)))\n"
             "np.save('<u8.npy', np.array([[0, 1, 2], [4294967295, 4, 5]], np.uint64))\n"
             "np.save('large.npy', np.array([[0, 1], [2, 4294967296]]))\n"
             "np.save('negative.npy', np.array([[0, 1], [-2, 3]], np.int32))\n"
             "np.save('real.npy', np.zeros((2, 2)))\n"
             "np.save('flat.npy', np.zeros(4, np.uint32))\n")) {
    GTEST_SKIP() << without_numpy;
  }
  for (const char* name : {"<i4", "<i4f", ">i4", ">i4f", "<i8", "<i8f", ">i8f", "<u4", ">u4f", "<u8"}) {
    const auto read = readNpyIds(path(name) + ".npy");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_THAT(read->ids, ElementsAre(0, 1, 2, no_site, 4, 5)) << name;
  }
  const auto message = [&](const char* name) { return readNpyIds(path(name)).error().message; };
  EXPECT_THAT(message("large.npy"),
              HasSubstr("element [1, 1] (counted from 0) is 4294967296; an id is 0 to 4294967295"));
  EXPECT_THAT(message("negative.npy"), HasSubstr("element [1, 0] (counted from 0) is -2"));
  EXPECT_THAT(message("real.npy"), HasSubstr("holds float64 (2, 2); uint32, int32, uint64 or int64 (H, W)"));
  EXPECT_THAT(message("flat.npy"), HasSubstr("holds uint32 (4,); "));
  EXPECT_THAT(message("missing.npy"), HasSubstr("No such file"));
}

}  // namespace
}  // namespace vorpipe::test

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "io/pictures/georeference.h"

namespace vorpipe::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr int picture_width = 700, picture_height = 300;

std::vector<std::uint32_t> someIds() {
  std::vector<std::uint32_t> ids(std::size_t{picture_width} * picture_height);
  for (std::uint32_t i = 0; i < ids.size(); ++i)
    ids[i] = i % picture_width / 50 * 7919 + i / picture_width / 30;
  ids[5] = no_site;
  return ids;
}

std::string fileOf(const TiffOptions& options) {
  MemorySink sink("a.tif");
  const auto written = writeTiffIds(sink, picture_width, picture_height, someIds(), options);
  EXPECT_TRUE(written) << written.error().message;
  return sink.take();
}

TiffOptions optionsWith(int threads, std::uint64_t longest_classic = 0xFFFFFFFF) {
  return {{-10, 50, 0.1, 0.2}, wgs84(), threads, longest_classic};
}

/// Reads a number of little endian; tests run on such machines.
template <class Number>
Number numberAt(const std::string& bytes, std::size_t at) {
  Number number{};
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

/// The ids in a TIFF whose offsets and counts are of type Word.
template <class Word, class Count>
std::vector<std::uint32_t> idsIn(const std::string& file, std::size_t directory) {
  std::map<int, std::vector<Word>> places;
  const auto entries = numberAt<Count>(file, directory);
  constexpr std::size_t entry = 4 + 2 * sizeof(Word);
  for (std::size_t k = 0; k < entries; ++k) {
    const std::size_t at = directory + sizeof(Count) + k * entry;
    const auto tag = numberAt<std::uint16_t>(file, at);
    if (tag != 273 && tag != 279) continue;
    const auto count = numberAt<Word>(file, at + 4), values = numberAt<Word>(file, at + 4 + sizeof(Word));
    for (Word i = 0; i < count; ++i) places[tag].push_back(numberAt<Word>(file, values + i * sizeof(Word)));
  }
  std::vector<std::uint32_t> ids(std::size_t{picture_width} * picture_height);
  std::size_t filled = 0;
  for (std::size_t k = 0; k < places[273].size(); ++k) {
    uLongf room = (ids.size() - filled) * sizeof ids[0];
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(&ids[filled]), &room,
                         reinterpret_cast<const Bytef*>(file.data() + places[273][k]), places[279][k]),
              Z_OK);
    filled += room / sizeof ids[0];
  }
  EXPECT_EQ(filled, ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) ids[i] += i % picture_width == 0 ? 0 : ids[i - 1];
  return ids;
}

TEST(GeoTiff, HasTheIdsAndTheSameBytesForAnyNumberOfThreads) {
  const std::string file = fileOf(optionsWith(1));
  EXPECT_EQ(numberAt<std::uint16_t>(file, 2), 42);
  EXPECT_EQ((idsIn<std::uint32_t, std::uint16_t>(file, 8)), someIds());
  EXPECT_EQ(file, fileOf(optionsWith(4)));
  EXPECT_LT(file.size(), std::size_t{picture_width} * picture_height / 2) << "it is not compressed";
}

TEST(GeoTiff, IsABigTiffWhereOffsetsAreTooLong) {
  const std::string classic = fileOf(optionsWith(1));
  EXPECT_EQ(fileOf(optionsWith(1, classic.size())), classic);
  const std::string big = fileOf(optionsWith(1, classic.size() - 1));
  EXPECT_EQ(numberAt<std::uint16_t>(big, 2), 43);
  EXPECT_EQ((idsIn<std::uint64_t, std::uint64_t>(big, 16)), someIds());
}

TEST(GeoTiff, NamesItsCoordinateSystem) {
  EXPECT_THAT(geoKeysOf({}).directory, IsEmpty());
  EXPECT_THAT(geoKeysOf(wgs84()).directory,
              ElementsAre(1, 1, 1, 3, 1024, 0, 1, 2, 1025, 0, 1, 1, 2048, 0, 1, 4326));
  const CoordinateSystem degrees{CoordinateKind::degrees, "", 0, {}, {}};
  EXPECT_EQ(geoKeysOf(degrees).directory, geoKeysOf(wgs84()).directory);
  const CoordinateSystem utm{CoordinateKind::plane, "EPSG", 32633, {}, {}};
  EXPECT_THAT(geoKeysOf(utm).directory,
              ElementsAre(1, 1, 1, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 32633));
  const CoordinateSystem nameless{CoordinateKind::plane, "ESRI", 102013, {}, {}};
  EXPECT_THAT(geoKeysOf(nameless).directory, IsEmpty());
}

TEST(GeoTiff, DefinesTheProjectionThatWasMade) {
  const GeoKeys keys = geoKeysOf({CoordinateKind::plane, "", 0, {}, Point{13.5, 47.25}});
  ASSERT_EQ(keys.directory.size(), 4u * (1 + 13));
  EXPECT_THAT(keys.doubles, ElementsAre(0, 0, 13.5, 47.25));
  std::map<int, int> values;
  for (std::size_t k = 4; k < keys.directory.size(); k += 4) {
    if (keys.directory[k + 1] == 0) values[keys.directory[k]] = keys.directory[k + 3];
  }
  // User-defined, Lambert's azimuthal equal area, kilometers, on WGS 84.
  EXPECT_EQ(values[3072], 32767);
  EXPECT_EQ(values[3075], 10);
  EXPECT_EQ(values[3076], 9036);
  EXPECT_EQ(values[2048], 4326);
}

TEST(WorldFile, CountsPixelsFromTheFrameOfTheDomain) {
  MemorySink sink("a.pgw");
  ASSERT_TRUE(writeWorldFile(sink, pixelGridOf({0, 0, 20, 10}, {10, 5, 40, 20})));
  EXPECT_EQ(sink.bytes(), "0.5\n0\n0\n-0.5\n-4.75\n12.25\n");
}

}  // namespace
}  // namespace vorpipe::test

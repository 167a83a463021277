#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "io/base/output_file.h"
#include "io/pictures/png_file.h"
#include "unit/fixtures/temporary_directory.h"

namespace vorpipe::test {
namespace {

using ::testing::HasSubstr;

class Png : public InTemporaryDirectory {
 protected:
  [[nodiscard]] std::string written(const char* name, int width, int height,
                                    const std::vector<std::uint32_t>& rgba) const {
    auto file = OutputFile::create(path(name));
    EXPECT_TRUE(file && writePng(*file, width, height, rgba) && file->commit());
    return path(name);
  }
};

std::vector<std::uint32_t> pixels(std::uint32_t alpha) {
  std::vector<std::uint32_t> rgba(37 * 21);
  for (std::uint32_t i = 0; i < rgba.size(); ++i) {
    rgba[i] = i * 2654435761u >> 8 | alpha;
  }
  return rgba;
}

TEST_F(Png, PixelsComeBack) {
  for (const std::uint32_t alpha : {0xFF000000u, 0x40000000u}) {
    const auto rgba = pixels(alpha);
    const auto image = readPng(written("a.png", 37, 21, rgba));
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->width, 37);
    EXPECT_EQ(image->height, 21);
    EXPECT_EQ(image->rgba, rgba);
  }
}

TEST_F(Png, TheSamePixelsGiveTheSameBytes) {
  const auto rgba = pixels(0xFF000000u);
  EXPECT_EQ(contents(written("a.png", 37, 21, rgba)), contents(written("b.png", 37, 21, rgba)));
}

TEST_F(Png, OpaquePixelsAreStoredAsRgb) {
  constexpr std::size_t color_type = 25;
  EXPECT_EQ(contents(written("a.png", 37, 21, pixels(0xFF000000u)))[color_type], 2);
  EXPECT_EQ(contents(written("a.png", 37, 21, pixels(0x7F000000u)))[color_type], 6);
}

TEST_F(Png, ReadsOtherKinds) {
  // One white and one black pixel, gray with one bit each.
  const std::string bytes(
      "\211\120\116\107\015\012\032\012\000\000\000\015\111\110\104\122\000\000\000\002\000\000\000\001"
      "\001\000\000\000\000\334\131\102\047\000\000\000\012\111\104\101\124\170\332\143\150\000\000\000"
      "\202\000\201\332\105\010\073\000\000\000\000\111\105\116\104\256\102\140\202",
      67);
  const auto image = readPng(write("gray.png", bytes));
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->rgba, (std::vector<std::uint32_t>{0xFFFFFFFFu, 0xFF000000u}));
}

TEST_F(Png, RefusesDamagedFiles) {
  const std::string whole = contents(written("a.png", 37, 21, pixels(0xFF000000u)));
  for (std::size_t size = 0; size < whole.size(); size += 7) {
    const auto image = readPng(write("cut.png", whole.substr(0, size)));
    ASSERT_FALSE(image) << size;
    EXPECT_EQ(image.error().code, ErrorCode::input);
    EXPECT_THAT(image.error().message, HasSubstr("cut.png: "));
  }
  EXPECT_THAT(readPng(write("cut.png", whole.substr(0, 60))).error().message,
              HasSubstr("is a damaged PNG: the file ends too early"));
  EXPECT_THAT(readPng(write("text.png", "these bytes are no picture")).error().message,
              HasSubstr("text.png: is not a PNG"));
  std::string flipped = whole;
  flipped[whole.size() / 2] ^= 1;
  EXPECT_THAT(readPng(write("flipped.png", flipped)).error().message, HasSubstr("is a damaged PNG"));
  EXPECT_THAT(readPng(path("missing.png")).error().message, HasSubstr("No such file"));
}

TEST_F(Png, AFullDiskIsReported) {
  auto file = OutputFile::create("/dev/full");
  if (!file) {
    GTEST_SKIP() << "there is no /dev/full here";
  }
  std::vector<std::uint32_t> noise(300 * 300);
  std::uint32_t state = 1;
  for (std::uint32_t& pixel : noise) {
    pixel = state = state * 1664525 + 1013904223;
  }
  const auto written = writePng(*file, 300, 300, noise);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::device);
  EXPECT_EQ(written.error().message, "/dev/full: writing failed: No space left on device");
}

}  // namespace
}  // namespace vorpipe::test

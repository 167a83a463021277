#include "picture/colormap.h"

#include <gtest/gtest.h>

#include <set>

namespace vorpipe::test {

using namespace core;

namespace {

TEST(Colormap, EveryNameHasAnOpaquePalette) {
  EXPECT_EQ(colormaps().size(), 8u);
  for (const std::string& name : colormaps()) {
    const auto palette = paletteByName(name);
    ASSERT_TRUE(palette) << name;
    for (const std::uint32_t color : *palette) {
      EXPECT_EQ(color >> 24, 0xFFu);
    }
    EXPECT_GT(std::set<std::uint32_t>(palette->begin(), palette->end()).size(), 200u) << name;
  }
}

TEST(Colormap, ColorsAreInTheirPlace) {
  const auto viridis = paletteByName("viridis");
  ASSERT_TRUE(viridis);
  EXPECT_EQ(viridis->front(), 0xFF540144u);  // R in the lowest byte
  EXPECT_EQ(viridis->back(), 0xFF25E7FDu);
  const auto gray = paletteByName("gray");
  ASSERT_TRUE(gray);
  for (std::uint32_t i = 0; i < 256; ++i) {
    EXPECT_EQ((*gray)[i], 0xFF000000u + i * 0x010101u);
  }
}

TEST(Colormap, NeighboringEntriesAreClose) {
  for (const std::string& name : colormaps()) {
    const Palette palette = *paletteByName(name);
    for (std::size_t i = 1; i < palette.size(); ++i) {
      for (int shift = 0; shift < 24; shift += 8) {
        const int step =
            static_cast<int>(palette[i] >> shift & 0xFF) - static_cast<int>(palette[i - 1] >> shift & 0xFF);
        EXPECT_LE(std::abs(step), 8) << name << ' ' << i;
      }
    }
  }
}

TEST(Colormap, AnUnknownNameIsRefused) {
  const auto palette = paletteByName("jet");
  ASSERT_FALSE(palette);
  EXPECT_EQ(palette.error().code, ErrorCode::input);
  EXPECT_EQ(palette.error().message,
            "no color map is called \"jet\"; there are viridis, magma, inferno, plasma, cividis, turbo, "
            "gray, thesis");
}

}  // namespace
}  // namespace vorpipe::test

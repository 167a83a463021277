#include "vorpipe/color.h"

#include <gtest/gtest.h>

#include <string>

namespace vorpipe::test {
namespace {

std::uint32_t rgbaOf(std::string_view text) {
  const auto color = readColor(text);
  EXPECT_TRUE(color) << text;
  return color ? color->rgba : 0;
}

TEST(Color, IsReadInAnyOfItsForms) {
  EXPECT_EQ(rgbaOf("#12ab9F"), 0xFF9FAB12u);
  EXPECT_EQ(rgbaOf("#1a9"), 0xFF99AA11u);
  EXPECT_EQ(rgbaOf("#1a98"), 0x8899AA11u);
  EXPECT_EQ(rgbaOf("#12ab9f40"), 0x409FAB12u);
  EXPECT_EQ(rgbaOf("SteelBlue"), 0xFFB48246u);
  EXPECT_EQ(rgbaOf("aliceblue"), 0xFFFFF8F0u);
  EXPECT_EQ(rgbaOf("yellowgreen"), 0xFF32CD9Au);
  EXPECT_EQ(rgbaOf("transparent"), 0u);
}

TEST(Color, IsWrittenAsItReadsBack) {
  for (const std::string text : {"#000000", "#12ab9f", "#ffffff", "#12ab9f40", "#00000000"}) {
    EXPECT_EQ(textOf(Color{rgbaOf(text)}), text);
  }
}

TEST(Color, RefusesWhatIsNone) {
  for (const std::string_view text :
       {"", "#", "#12", "#12345", "#1234567", "#123456789", "#12g", "#-12", "#+1234a", "# 12", "0x123",
        "reddish", "red ", "123456", "zzz", "a\nb"}) {
    const auto color = readColor(text);
    ASSERT_FALSE(color) << text;
    EXPECT_EQ(color.error().code, ErrorCode::input);
    EXPECT_EQ(color.error().message.find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace vorpipe::test

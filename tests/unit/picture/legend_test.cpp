#include <gtest/gtest.h>

#include <algorithm>

#include "picture/font.h"
#include "picture/legend.h"
#include "picture/number_text.h"
#include "vorpipe.h"

namespace vorpipe::test {

using namespace core;

namespace {

ColorKey keyOf(ColorScale scale, ColorBy color, double low, double high) {
  ColorKey key{color, scale, {low, high}, {}};
  for (int k = 0; k <= 8; ++k) key.ticks.emplace_back(k / 8.0, low + (high - low) * k / 8);
  return key;
}

RenderOptions sized(int width, int height, const char* colormap = "viridis") {
  RenderOptions options{};
  options.domain = {0, 0, 1, 1};
  options.width = width;
  options.height = height;
  options.colormap = colormap;
  options.legend = true;
  return options;
}

/// Names as long as their numbers, further ones, and a missing value.
ColorKey namesKey(std::size_t count) {
  ColorKey key{ColorBy::value};
  key.title = "kind";
  for (std::size_t k = 0; k < count; ++k) key.names.push_back(std::string(k + 1, 'x') + std::to_string(k));
  key.other_names = 3;
  key.has_missing = true;
  return key;
}

RenderOptions namesOptions(int width, int height, const ColorKey& key) {
  RenderOptions options = sized(width, height, "");
  options.color = ColorBy::value;
  options.values.names = key.names;
  return options;
}

TEST(Legend, LiesInsideThePictureAndItsTextsDoNotOverlap) {
  for (const auto& [width, height] :
       {std::pair{100, 64}, {64 * 3, 100}, {100, 5000}, {5000, 64}, {200, 200}, {1000, 500}, {8000, 8000}}) {
    for (const auto& key : {keyOf(ColorScale::quantile, ColorBy::neighbors, 3, 12),
                            keyOf(ColorScale::log, ColorBy::area, 1.23456e-9, 7.5e12),
                            keyOf(ColorScale::linear, ColorBy::weight, -1.0000001e-8, -1e-8),
                            keyOf(ColorScale::linear, ColorBy::weight, 5, 5)}) {
      const Legend legend = legendOf(key, sized(width, height));
      for (const LegendBox& box : legend.boxes) {
        EXPECT_GE(box.left, 0);
        EXPECT_GE(box.top, 0);
        EXPECT_LE(box.left + box.width, width);
        EXPECT_LE(box.top + box.height, height);
      }
      const LegendBox& panel = legend.boxes.front();
      double below = panel.top + panel.height;
      auto texts = legend.texts;
      std::ranges::sort(texts, std::greater(), &LegendText::baseline);
      for (const LegendText& text : texts) {
        EXPECT_LE(text.baseline, below) << width << 'x' << height << ' ' << text.text;
        below = text.baseline - text.height - 1;
        EXPECT_GE(text.x, panel.left);
        EXPECT_LE(text.x + unitsOf(text.text) * text.height / letter_units, panel.left + panel.width)
            << text.text;
      }
      EXPECT_GE(below + 1, panel.top);
    }
  }
}

TEST(Legend, LabelsNeverReadTheSame) {
  for (const auto& [low, high] :
       {std::pair{0.0123456789, 0.0123456789 * (1 + 2e-9)}, {-1e-8, -1e-8 + 1e-16}}) {
    for (const int width : {100, 150, 1000}) {
      const Legend legend = legendOf(keyOf(ColorScale::linear, ColorBy::area, low, high), sized(width, 600));
      std::vector<std::string> texts;
      for (const LegendText& text : legend.texts) texts.push_back(text.text);
      std::ranges::sort(texts);
      EXPECT_EQ(std::ranges::adjacent_find(texts), texts.end()) << *std::ranges::adjacent_find(texts);
      // The title, and both ends where there is room.
      EXPECT_GE(texts.size(), width > 100 ? 3U : 2U);
    }
  }
}

TEST(Legend, NamesBothEndsAndWhatIsShown) {
  const Legend legend = legendOf(keyOf(ColorScale::log, ColorBy::area, 0.012, 350), sized(800, 600, "magma"));
  std::vector<std::string> texts;
  for (const LegendText& text : legend.texts) texts.push_back(text.text);
  for (const char* wanted : {"area, log", "0.012", "350"}) {
    EXPECT_NE(std::ranges::find(texts, wanted), texts.end()) << wanted;
  }
}

TEST(Legend, IsDrawnOverColorsAndNoIds) {
  Image image{300, 200, std::vector<std::uint32_t>(60000, 0xFF0000FFu), std::vector<std::uint32_t>(60000, 7)};
  const auto ids = image.ids;
  drawLegend(legendOf(keyOf(ColorScale::linear, ColorBy::area, 0, 1), sized(300, 200)), image);
  EXPECT_EQ(image.ids, ids);
  EXPECT_NE(std::ranges::find(image.rgba, 0xFF000000u), image.rgba.end());
  EXPECT_EQ(image.rgba[299], 0xFF0000FFu);
}

TEST(Legend, OfNamesLiesInsideAndSaysHowManyItLeavesOut) {
  for (const auto& [width, height] :
       {std::pair{100, 64}, {100, 1000}, {1000, 64}, {200, 200}, {2000, 1500}}) {
    for (const std::size_t count : {1u, 7u, 20u}) {
      const ColorKey key = namesKey(count);
      const Legend legend = legendOf(key, namesOptions(width, height, key));
      for (const LegendBox& box : legend.boxes) {
        EXPECT_GE(box.left, 0);
        EXPECT_GE(box.top, 0) << width << 'x' << height << ' ' << count;
        EXPECT_LE(box.left + box.width, width);
        EXPECT_LE(box.top + box.height, height);
      }
      std::size_t shown = 0, left_out = 0;
      for (const LegendText& text : legend.texts) {
        const double end = text.x + unitsOf(text.text) * text.height / letter_units;
        EXPECT_LE(end, legend.boxes.front().left + legend.boxes.front().width) << text.text;
        if (text.text.starts_with('x')) ++shown;
        if (text.text.ends_with(" more")) left_out += std::stoul(text.text.substr(4));
        if (text.text.ends_with(" others")) left_out += std::stoul(text.text.substr(4));
      }
      EXPECT_EQ(shown + left_out, count + key.other_names) << width << 'x' << height;
    }
  }
}

TEST(Sheet, IsNothingWithoutATitleAndALegendBeside) {
  const Sheet sheet = sheetOf(sized(300, 200), keyOf(ColorScale::linear, ColorBy::area, 0, 1));
  EXPECT_EQ(sheet.left + sheet.top + sheet.right + sheet.bottom, 0);
  EXPECT_TRUE(sheet.legend.boxes.empty() && sheet.legend.texts.empty());
}

TEST(Sheet, HasRoomForItsTextsBesideThePicture) {
  for (const auto& [width, height] : {std::pair{60, 40}, {300, 200}, {2000, 900}}) {
    for (const bool names : {false, true}) {
      const ColorKey key = names ? namesKey(20) : keyOf(ColorScale::linear, ColorBy::area, 0, 1.5e-7);
      RenderOptions options = names ? namesOptions(width, height, key) : sized(width, height);
      options.legend_beside = true;
      options.title = "A title of some words, one of them Donaudampfschifffahrtsgesellschaft, in lines";
      options.legend_title = "what it is, in some unit";
      const Sheet sheet = sheetOf(options, key);
      for (const LegendText& text : sheet.legend.texts) {
        const double end = text.x + unitsOf(text.text) * text.height / letter_units;
        EXPECT_LE(end, width + sheet.right) << text.text;
        EXPECT_GE(text.baseline - text.height, -sheet.top) << text.text;
        EXPECT_LE(text.baseline, height + sheet.bottom) << text.text;
        const bool over_picture = text.x < width && text.baseline > 0;
        EXPECT_FALSE(over_picture) << text.text;
      }
      Image image{width,
                  height,
                  std::vector<std::uint32_t>(static_cast<std::size_t>(width * height), 0xFF00FF00u),
                  {}};
      image.ids.resize(image.rgba.size());
      const Image whole = onSheet(image, sheet);
      EXPECT_EQ(whole.width, sheet.left + width + sheet.right);
      EXPECT_EQ(std::ranges::count(whole.rgba, 0xFF00FF00u), width * height);
      EXPECT_EQ(std::ranges::count(whole.rgba, 0u), 0) << "pixels of the margins have no color";
    }
  }
}

TEST(NumberText, IsShort) {
  EXPECT_EQ(numberText(0.012, 3), "0.012");
  EXPECT_EQ(numberText(1.2e-5, 3), "1.2e-5");
  EXPECT_EQ(numberText(350, 3), "350");
  EXPECT_EQ(numberText(123456, 3), "123456");
  EXPECT_EQ(numberText(1.5e7, 3), "1.5e7");
  EXPECT_EQ(numberText(-0.5, 3), "-0.5");
  EXPECT_EQ(numberText(0, 3), "0");
  EXPECT_EQ(numberText(999.96, 4), "1000");
}

TEST(NumberText, TellsDifferentNumbersApart) {
  const std::vector<double> numbers{1.0001, 1.0002};
  EXPECT_EQ(numberTexts(numbers, 10), (std::vector<std::string>{"1.0001", "1.0002"}));
}

}  // namespace
}  // namespace vorpipe::test

#include "picture/color_scale.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <set>
#include <string>

#include "picture/palette.h"

namespace vorpipe::test {

using namespace core;

namespace {

ColorPlaces placesOf(ColorScale scale, std::vector<double> values, std::optional<ColorRange> range = {},
                     ColorBy color = ColorBy::area) {
  auto places = ColorPlaces::of({color, scale, range}, std::move(values));
  EXPECT_TRUE(places.has_value()) << places.error().message;
  return *places;
}

std::vector<double> tickValues(const ColorPlaces& places) {
  std::vector<double> values;
  for (const auto& [place, value] : places.key().ticks) values.push_back(value);
  return values;
}

TEST(ColorScale, EveryScaleNeverFallsAndReachesBothEnds) {
  const std::vector<double> values{3, 1, 4, 1, 5, 9, 2, 6, 5, 1000};
  for (const auto scale :
       {ColorScale::automatic, ColorScale::linear, ColorScale::log, ColorScale::quantile}) {
    const ColorPlaces places = placesOf(scale, values);
    double before = 0;
    for (const double value : {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 9.0, 1000.0}) {
      EXPECT_GE(places(value), before);
      before = places(value);
    }
    EXPECT_EQ(places(1000), 1);
    EXPECT_EQ(places(2000), 1);
    EXPECT_EQ(places(0.5), 0);
    EXPECT_EQ(places.key().range.low, 1);
    EXPECT_EQ(places.key().range.high, 1000);
  }
}

TEST(ColorScale, AutomaticIsByRankForAreasAndLinearForNeighbors) {
  EXPECT_EQ(placesOf(ColorScale::automatic, {1, 2}).key().scale, ColorScale::quantile);
  EXPECT_EQ(placesOf(ColorScale::automatic, {1, 2}, {}, ColorBy::weight).key().scale, ColorScale::quantile);
  EXPECT_EQ(placesOf(ColorScale::automatic, {1, 2}, {}, ColorBy::neighbors).key().scale, ColorScale::linear);
}

TEST(ColorScale, EqualValuesShareTheirMiddleRank) {
  const ColorPlaces places = placesOf(ColorScale::quantile, {7, 2, 2, 2, 1});
  EXPECT_EQ(places(1), 0);
  EXPECT_EQ(places(2), 0.5);
  EXPECT_EQ(places(7), 1);
}

TEST(ColorScale, ColorsAreRoundedPlacesHoweverTheyAreFound) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  for (const int distinct : {1, 2, 7, 300, 100000}) {
    std::vector<double> values(3000);
    for (double& value : values) value = static_cast<double>(random() % static_cast<unsigned>(distinct));
    for (const auto scale : {ColorScale::linear, ColorScale::quantile}) {
      const ColorPlaces places = placesOf(scale, values);
      values.insert(values.end(), {-1.0, 1e6});
      for (const double value : values) {
        ASSERT_EQ(places.colorOf(value), static_cast<std::uint8_t>(std::lround(255 * places(value))))
            << value;
      }
      values.resize(3000);
    }
  }
}

TEST(ColorScale, WhereAllValuesAreEqualTheyHaveTheMiddle) {
  for (const auto scale : {ColorScale::linear, ColorScale::log, ColorScale::quantile}) {
    EXPECT_EQ(placesOf(scale, {3, 3, 3})(3), 0.5);
    EXPECT_EQ(placesOf(scale, {3})(3), 0.5);
  }
}

TEST(ColorScale, ValuesThatDifferByRoundingAloneShareAColorAndATick) {
  const std::vector<double> noisy{0.01 - 3e-18, 0.01, 0.01 + 2e-18, 0.01 + 9e-10};
  for (const auto scale : {ColorScale::linear, ColorScale::log, ColorScale::quantile}) {
    const ColorPlaces places = placesOf(scale, noisy);
    for (const double value : noisy) {
      EXPECT_EQ(places(value), 0.5);
      EXPECT_EQ(places.colorOf(value), 128);
    }
    EXPECT_EQ(places.key().range.low, places.key().range.high);
    EXPECT_EQ(places.key().ticks, (std::vector<std::pair<double, double>>{{0.5, noisy[0]}}));
  }
}

TEST(ColorScale, RoundingAmongOtherValuesTakesNoRanks) {
  const std::vector<double> values{1, 2 - 4e-16, 2, 2 + 1e-7, 3};
  const ColorPlaces places = placesOf(ColorScale::quantile, values);
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_EQ(places(values[i]), 0.5);
    EXPECT_EQ(places.colorOf(values[i]), 128);
  }
  EXPECT_EQ(places.key().ticks, (std::vector<std::pair<double, double>>{{0, 1}, {0.5, values[1]}, {1, 3}}));
}

TEST(ColorScale, ValuesThatDifferByMoreHaveColorsOfTheirOwnHoweverManyThereAre) {
  std::vector<double> values;
  for (int k = 0; k < 256; ++k) values.push_back(1 + k * 1.5e-7);
  for (const auto scale : {ColorScale::linear, ColorScale::quantile}) {
    const ColorPlaces places = placesOf(scale, values);
    for (int k = 0; k < 256; ++k) EXPECT_EQ(places.colorOf(values[static_cast<std::size_t>(k)]), k);
  }
}

TEST(ColorScale, LogarithmsGiveValuesThatHaveNoneTheFirstColor) {
  const ColorPlaces places = placesOf(ColorScale::log, {0, -5, 1, 10, 100});
  EXPECT_EQ(places(0), 0);
  EXPECT_EQ(places(-5), 0);
  EXPECT_EQ(places(1), 0);
  EXPECT_DOUBLE_EQ(places(10), 0.5);
  EXPECT_EQ(places.key().range.low, 1);
  EXPECT_FALSE(ColorPlaces::of({ColorBy::weight, ColorScale::log, {}}, {0, -1}));
}

TEST(ColorScale, ARangeClampsAndRanksWhatIsInside) {
  const ColorPlaces linear = placesOf(ColorScale::linear, {0, 1, 2, 100}, ColorRange{1, 3});
  EXPECT_EQ(linear(0), 0);
  EXPECT_EQ(linear(2), 0.5);
  EXPECT_EQ(linear(100), 1);
  const ColorPlaces ranks = placesOf(ColorScale::quantile, {0, 1, 2, 3, 100}, ColorRange{1, 3});
  EXPECT_EQ(ranks(0), 0);
  EXPECT_EQ(ranks(1), 0);
  EXPECT_EQ(ranks(2), 0.5);
  EXPECT_EQ(ranks(3), 1);
  EXPECT_EQ(ranks(100), 1);
}

TEST(ColorScale, ARangeThatIsNoneIsRefused) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  for (const ColorRange range : {ColorRange{2, 1}, {1, 1}, {0, infinite}, {std::nan(""), 1}}) {
    EXPECT_FALSE(ColorPlaces::of({ColorBy::area, ColorScale::linear, range}, {1, 2}));
  }
  EXPECT_FALSE(ColorPlaces::of({ColorBy::area, ColorScale::log, ColorRange{0, 1}}, {1, 2}));
  EXPECT_FALSE(ColorPlaces::of({ColorBy::area, ColorScale::quantile, ColorRange{5, 6}}, {1, 2}));
}

TEST(ColorScale, TicksAreRoundNumbersBetweenTheEnds) {
  EXPECT_EQ(tickValues(placesOf(ColorScale::linear, {0.013, 1})),
            (std::vector<double>{0.013, 0.2, 0.4, 0.6, 0.8, 1}));
  EXPECT_EQ(tickValues(placesOf(ColorScale::linear, {3, 9}, {}, ColorBy::neighbors)),
            (std::vector<double>{3, 4, 6, 8, 9}));
  EXPECT_EQ(tickValues(placesOf(ColorScale::log, {0.5, 20000})),
            (std::vector<double>{0.5, 10, 100, 1000, 20000}));
  EXPECT_EQ(tickValues(placesOf(ColorScale::quantile, {1, 2, 3, 4, 100})),
            (std::vector<double>{1, 2, 3, 4, 100}));
}

TEST(ColorScale, TicksAscendAndAreFiniteForAnyRange) {
  constexpr double most = std::numeric_limits<double>::max();
  for (const ColorRange range : {ColorRange{-most, most}, {1, 1 + 2e-7}, {0, 5e-324}, {1e300, 2e300}}) {
    const ColorPlaces places = placesOf(ColorScale::linear, {range.low, range.high});
    double before = -1;
    double last = std::numeric_limits<double>::lowest();
    for (const auto& [place, value] : places.key().ticks) {
      EXPECT_GT(place, before);
      EXPECT_TRUE(std::isfinite(value));
      EXPECT_TRUE(value > last || before < 0);
      before = place;
      last = value;
    }
    EXPECT_EQ(places.key().ticks.front().first, 0);
    EXPECT_EQ(places.key().ticks.back().first, 1);
  }
}

TEST(PaletteIndex, SitesWithoutACellCountForNothing) {
  const Sites sites{{0, 1, 2, 3}, {0, 0, 0, 0}, {}};
  Diagram cells;
  cells.status = {Status::ok, Status::empty, Status::duplicate, Status::ok};
  cells.area = {2, 0, 0, 4};
  RenderOptions options{};
  options.color = ColorBy::area;
  options.color_scale = ColorScale::linear;
  const auto indices = paletteIndices(sites, cells, options, 1);
  ASSERT_TRUE(indices.has_value());
  EXPECT_EQ(indices->key->range.low, 2);
  EXPECT_EQ(indices->index.front(), 0);
  EXPECT_EQ(indices->index.back(), 255);
}

TEST(PaletteIndex, ColorsBySiteHaveNoScaleRangeOrLegend) {
  RenderOptions options{};
  EXPECT_TRUE(paletteIndices({{0}, {0}, {}}, {}, options, 1).has_value());
  options.legend = true;
  EXPECT_FALSE(paletteIndices({{0}, {0}, {}}, {}, options, 1).has_value());
}

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

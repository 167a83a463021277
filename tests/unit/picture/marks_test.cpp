#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "picture/draw_marks.h"
#include "picture/font.h"
#include "unit/fixtures/checked_runs.h"
#include "vorpipe/label_room.h"
#include "vorpipe/shapes.h"

namespace vorpipe::test {

using namespace core;

namespace {

using ::testing::HasSubstr;

Diagram polygonsOf(const Sites& sites, const RenderOptions& options) {
  CellsOptions cells = cellsOptions(options);
  cells.detail = Detail::polygons;
  return cellsOf(sites, cells);
}

double green(std::uint32_t rgba) { return rgba >> 8 & 0xFF; }

/// How much of a square with sides of 1 is where nx x + ny y < least, from its lower left corner. The normal
/// has positive parts.
double areaBelow(double nx, double ny, double least) {
  const auto triangle = [&](double rest) { return rest > 0 ? rest * rest / (2 * nx * ny) : 0; };
  return triangle(least) - triangle(least - nx) - triangle(least - ny) + triangle(least - nx - ny);
}

TEST(Antialias, APixelHasAsMuchOfEachColorAsOfEachCell) {
  // They meet where 2 x + y = 1.5.
  const Sites sites{{0.3, 0.7}, {0.4, 0.6}, {}};
  const int size = 40;
  RenderOptions options = optionsOf(size, size);
  const Rendering plain = drawn(sites, options);
  const double first = green(plain.image.rgba[static_cast<std::size_t>(size * (size - 1))]);
  const double second = green(plain.image.rgba[static_cast<std::size_t>(size - 1)]);
  ASSERT_GT(std::abs(first - second), 50);
  for (const int places : {2, 3, 8}) {
    options.antialias = places;
    const Rendering smooth = drawn(sites, options);
    EXPECT_EQ(smooth.image.ids, plain.image.ids);
    for (int row = 0; row < size; ++row) {
      for (int column = 0; column < size; ++column) {
        const double left = column, bottom = size - 1 - row;
        const double exact = areaBelow(2, 1, 1.5 * size - 2 * left - bottom);
        const auto pixel = static_cast<std::size_t>(row * size + column);
        const double found = (green(smooth.image.rgba[pixel]) - second) / (first - second);
        // A line crosses less than 2 N of the N x N squares around places, and half of one is the most that
        // it leaves wrong there; a color is rounded besides.
        ASSERT_NEAR(found, exact, 1.0 / places + 0.5 / std::abs(first - second)) << row << ' ' << column;
      }
    }
  }
}

TEST(Antialias, EdgesAreAsWideAsTheyAreAskedFor) {
  const Sites sites{{0.2, 0.83}, {0.5, 0.5}, {}};
  RenderOptions options = optionsOf(40, 4);
  options.edges = true;
  options.fill = false;
  for (const double width : {1.0, 1.5, 2.25, 7.0}) {
    options.edge_width = width;
    options.antialias = 8;
    const Rendering picture = drawn(sites, options);
    double dark = 0;
    for (std::size_t column = 0; column < 40; ++column) {
      dark += (255 - green(picture.image.rgba[40 + column])) / (255 - green(edgeColor(options)));
    }
    EXPECT_NEAR(dark, width, 1.0 / 8 + 0.02) << width;
  }
}

TEST(Antialias, AnOutlineLeavesPixelsAsOpaqueAsTheyAreInside) {
  RenderOptions options = optionsOf(60, 60);
  options.outline = {{{0.1, 0.1}, {0.9, 0.2}, {0.3, 0.8}}, {0, 3}, {0, 1}};
  const double area = (0.8 * 0.7 - 0.1 * 0.2) / 2;
  const Sites sites{{0.3, 0.6}, {0.3, 0.3}, {}};
  const Rendering plain = drawn(sites, options);
  options.antialias = 6;
  const Rendering smooth = drawn(sites, options);
  EXPECT_EQ(smooth.image.ids, plain.image.ids);
  double opaque = 0;
  std::set<std::uint32_t> alphas;
  for (const std::uint32_t pixel : smooth.image.rgba) {
    opaque += (pixel >> 24) / 255.0;
    alphas.insert(pixel >> 24);
  }
  EXPECT_NEAR(opaque / 3600, area, 1e-3);
  EXPECT_GT(alphas.size(), 10u);
}

TEST(Antialias, RowsAreDrawnSomeAtATimeAndAllOfThem) {
  // Only two rows of so wide a picture are drawn at once.
  const int width = largest_side, height = 3;
  ASSERT_EQ(rowsAtOnce(width, 8), 2);
  Image image{width, height, std::vector<std::uint32_t>(std::size_t{largest_side} * height), {}};
  std::vector<int> begins;
  const auto draw = [&](int first, int last) -> Result<Image> {
    begins.push_back(first);
    const auto size = static_cast<std::size_t>(width) * 64 * static_cast<std::size_t>(last - first);
    const std::uint32_t color = 0xFF000000u | static_cast<std::uint32_t>(first);
    return Image{8 * width, 8 * (last - first), std::vector(size, color), std::vector<std::uint32_t>(size)};
  };
  ASSERT_TRUE(smooth(draw, 8, 0, image));
  EXPECT_EQ(begins, (std::vector<int>{0, 2}));
  EXPECT_EQ(image.rgba.front(), 0xFF000000u);
  EXPECT_EQ(image.rgba.back(), 0xFF000002u);
}

TEST(Antialias, AViewBeyondTheDomainIsAsOpaqueAsItShowsOfIt) {
  const Sites sites = generate(Pattern::random, 30, 2);
  RenderOptions options = optionsOf(60, 50);
  options.view = Box{-0.25, -0.3, 1.4, 1.2};
  const Rendering plain = drawn(sites, options);
  options.antialias = 4;
  options.edges = options.dual = true;
  const Rendering smooth = drawn(sites, options);
  EXPECT_EQ(smooth.image.ids, plain.image.ids);
  double opaque = 0;
  for (const std::uint32_t pixel : smooth.image.rgba) opaque += (pixel >> 24) / 255.0;
  EXPECT_NEAR(opaque / 3000, 1 / (1.65 * 1.5), 0.01);
}

TEST(Antialias, AViewShowsWhatTheWholeHasThere) {
  const Sites sites = generate(Pattern::random, 30, 2);
  RenderOptions options = optionsOf(80, 80);
  options.antialias = 3;
  options.edges = options.dual = true;
  options.edge_width = 1.5;
  const Rendering whole = drawn(sites, options);
  options.view = Box{0.25, 0.5, 0.5, 1};
  options.width = 20;
  options.height = 40;
  const Rendering part = drawn(sites, options);
  std::size_t different = 0;
  for (std::size_t row = 0; row < 40; ++row) {
    for (std::size_t column = 0; column < 20; ++column) {
      if (part.image.rgba[row * 20 + column] != whole.image.rgba[row * 80 + 20 + column]) ++different;
    }
  }
  // Places on an edge may go to either side by rounding.
  EXPECT_LE(different, 4u);
}

/// Where a line ends, in pixels of a picture of 100 x 100, whichever end is first.
std::set<std::pair<int, int>> endsOf(const Line& line) {
  const auto pixel = [](Point at) {
    return std::pair{static_cast<int>(std::lround(at.x)), static_cast<int>(std::lround(at.y))};
  };
  return {pixel(line.from), pixel(line.to)};
}

TEST(Dual, SitesWhoseCellsHaveACommonEdgeHaveALine) {
  const Sites sites{{0.1, 0.5, 0.9}, {0.5, 0.5, 0.5}, {}};
  RenderOptions options = optionsOf(100, 100);
  options.dual = true;
  const auto lines = dualLines(sites, polygonsOf(sites, options), options);
  ASSERT_TRUE(lines);
  ASSERT_EQ(lines->size(), 2u);
  EXPECT_EQ(endsOf((*lines)[0]), (std::set<std::pair<int, int>>{{10, 50}, {50, 50}}));
  const Rendering picture = drawn(sites, options);
  EXPECT_EQ(picture.image.rgba[100 * 49 + 30], dual_color);
  EXPECT_NE(picture.image.rgba[100 * 49 + 95], dual_color);
  EXPECT_NE(picture.image.rgba[100 * 40 + 30], dual_color);
}

TEST(Dual, LinesOfAPeriodicDomainGoOnAtItsOtherSide) {
  const Sites sites{{0.1, 0.9}, {0.5, 0.5}, {}};
  RenderOptions options = optionsOf(100, 100);
  options.periodic = Periodic::x;
  options.dual = true;
  const auto lines = dualLines(sites, polygonsOf(sites, options), options);
  ASSERT_TRUE(lines);
  std::set<std::set<std::pair<int, int>>> ends;
  for (const Line& line : *lines) ends.insert(endsOf(line));
  EXPECT_EQ(ends, (std::set<std::set<std::pair<int, int>>>{
                      {{10, 50}, {90, 50}}, {{-10, 50}, {10, 50}}, {{90, 50}, {110, 50}}}));
  EXPECT_EQ(drawn(sites, options).image.rgba[100 * 49 + 98], dual_color);
}

/// Whether a label's digits lie in the cell of its site, by their corners and between them.
bool liesInItsCell(const SiteLabel& label, const Sites& sites, const RenderOptions& options) {
  const double x = label.width / 2, y = options.label_size / 2;
  for (double across = -1; across <= 1; across += 0.25) {
    for (const double down : {-1.0, 0.0, 1.0}) {
      const double u = (label.middle.x + across * x) / options.width;
      const double v = 1 - (label.middle.y + down * y) / options.height;
      if (u < 0 || u > 1 || v < 0 || v > 1) return false;
      const auto power = [&](std::size_t i) {
        const double weight = sites.weight.empty() ? 0 : sites.weight[i];
        return std::pow(sites.x[i] - u, 2) + std::pow(sites.y[i] - v, 2) - weight;
      };
      for (std::size_t i = 0; i < sites.size(); ++i) {
        if (power(i) < power(label.site)) return false;
      }
    }
  }
  return true;
}

TEST(Labels, StandInTheirCellsAndWhereverThereIsRoom) {
  for (const bool weighted : {false, true}) {
    Sites sites = generate(Pattern::random, 200, 4);
    if (weighted) {
      for (std::size_t i = 0; i < sites.size(); ++i) sites.weight.push_back(1e-5 * static_cast<double>(i));
    }
    RenderOptions options = optionsOf(500, 500);
    options.labels = true;
    for (const bool dots : {false, true}) {
      options.show_sites = dots;
      for (const double size : {6.0, 10.0, 30.0}) {
        options.label_size = size;
        const auto labels = siteLabels(sites, polygonsOf(sites, options), options);
        ASSERT_TRUE(labels);
        for (const SiteLabel& label : labels->labels) {
          EXPECT_EQ(label.text, std::to_string(label.site));
          EXPECT_TRUE(liesInItsCell(label, sites, options)) << label.text << ' ' << size;
        }
        EXPECT_EQ(labels->labels.size() > 150, size == 6) << size;
        EXPECT_EQ(labels->labels.size() < 20, size == 30) << size;
      }
    }
  }
}

TEST(Labels, StandInWhatAnOutlineLeavesOfACell) {
  // A U, whose middle is outside.
  RenderOptions options = optionsOf(100, 100);
  options.outline = {
      {{0, 0}, {1, 0}, {1, 1}, {0.8, 1}, {0.8, 0.2}, {0.2, 0.2}, {0.2, 1}, {0, 1}}, {0, 8}, {0, 1}};
  options.labels = true;
  const Sites sites{{0.5}, {0.1}, {}};
  const auto labels = siteLabels(sites, polygonsOf(sites, options), options);
  ASSERT_TRUE(labels);
  ASSERT_EQ(labels->labels.size(), 1u);
  const Point at = labels->labels.front().middle;
  EXPECT_TRUE(at.x < 20 || at.x > 80 || at.y > 80) << at.x << ' ' << at.y;
}

TEST(Labels, StandInTheMiddleOfCellsWhoseSitesLieElsewhere) {
  RenderOptions options = optionsOf(200, 200);
  options.labels = options.show_sites = true;
  options.texts = {"here", "there"};
  // The second has the upper half, and lies above the picture.
  const Sites sites{{0.5, 0.5}, {-0.5, 1.5}, {}};
  const auto labels = siteLabels(sites, polygonsOf(sites, options), options);
  ASSERT_TRUE(labels);
  ASSERT_EQ(labels->labels.size(), 2u);
  EXPECT_EQ(labels->labels[1].text, "there");
  EXPECT_NEAR(labels->labels[1].middle.x, 100, 1);
  EXPECT_NEAR(labels->labels[1].middle.y, 50, 1);
}

TEST(Labels, AreAsManyAsTheSites) {
  RenderOptions options = optionsOf(200, 200);
  options.labels = true;
  options.texts = {"one"};
  const Sites sites{{0.2, 0.8}, {0.5, 0.5}, {}};
  EXPECT_FALSE(siteLabels(sites, polygonsOf(sites, options), options));
  options.texts = {"", "two"};
  const auto labels = siteLabels(sites, polygonsOf(sites, options), options);
  ASSERT_TRUE(labels);
  ASSERT_EQ(labels->labels.size(), 1u);
  EXPECT_EQ(labels->labels.front().site, 1u);
}

TEST(Labels, NamesWithoutRoomStandBesideTheirDots) {
  const Sites sites = generate(Pattern::random, 200, 4);
  RenderOptions options = optionsOf(500, 500);
  options.labels = true;
  for (std::size_t i = 0; i < sites.size(); ++i) options.texts.push_back(i % 2 == 0 ? "Long name" : "");
  const auto inside = siteLabels(sites, polygonsOf(sites, options), options);
  ASSERT_TRUE(inside);
  EXPECT_TRUE(inside->dots.empty());
  EXPECT_TRUE(std::ranges::none_of(inside->labels, &SiteLabel::beyond));
  options.show_sites = true;
  const auto found = siteLabels(sites, polygonsOf(sites, options), options);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->dots.size(), sites.size());
  EXPECT_GT(found->labels.size(), inside->labels.size());
  // Half of the cells have a name.
  const Diagram cells = polygonsOf(sites, options);
  for (const SiteLabels& labels : {*inside, *found}) {
    EXPECT_EQ(noteOnRoom(cells, options, labels), "labels: " + std::to_string(100 - labels.labels.size()) +
                                                      " names have no room, and are left out");
  }
  options.texts.assign(sites.size(), "");
  EXPECT_EQ(noteOnRoom(cells, options, {}), "");
  options.texts[7] = "Long name";
  EXPECT_EQ(noteOnRoom(cells, options, {}), "labels: 1 name has no room, and is left out");
  for (std::size_t i = 0; i < sites.size(); ++i) options.texts[i] = i % 2 == 0 ? "Long name" : "";
  EXPECT_GT(std::ranges::count_if(found->labels, &SiteLabel::beyond), 5);
  const auto gap = [&](const SiteLabel& label, Point at) {
    return std::max(std::abs(at.x - label.middle.x) - label.width / 2,
                    std::abs(at.y - label.middle.y) - options.label_size / 2);
  };
  for (const SiteLabel& label : found->labels) {
    if (!label.beyond) continue;
    EXPECT_GE(label.middle.x - label.width / 2, 0);
    EXPECT_LE(label.middle.x + label.width / 2, 500);
    for (const Point dot : found->dots) EXPECT_GE(gap(label, dot), 0) << label.site;
    const Point own{500 * sites.x[label.site], 500 - 500 * sites.y[label.site]};
    EXPECT_LT(gap(label, own), 10) << label.site;
    for (const SiteLabel& other : found->labels) {
      if (other.site == label.site) continue;
      const bool apart = std::abs(other.middle.x - label.middle.x) >= (other.width + label.width) / 2 ||
                         std::abs(other.middle.y - label.middle.y) >= options.label_size;
      EXPECT_TRUE(apart) << label.site << ' ' << other.site;
    }
  }
}

TEST(Labels, NamesStandOutAsMuchAsBlackOrWhiteCan) {
  RenderOptions options = optionsOf(100, 100);
  options.labels = true;
  options.texts = {"a"};
  constexpr std::uint32_t teal = 0xFF739E00u, blue = 0xFFB27200u, night = 0xFF400000u;
  SiteLabel label{0, {}, 10, "a"};
  EXPECT_EQ(colorsOf(label, options, teal).ink, black);
  EXPECT_EQ(colorsOf(label, options, blue).ink, white);
  EXPECT_FALSE(colorsOf(label, options, blue).halo);
  label.beyond = true;
  EXPECT_EQ(colorsOf(label, options, blue).halo, white);
  options.background = Color{night};
  EXPECT_EQ(colorsOf(label, options, teal).halo, night);
  EXPECT_EQ(colorsOf(label, options, teal).ink, white);
}

TEST(Labels, StandOutFromTheirCells) {
  EXPECT_EQ(inkOn(0xFF000000u), white);
  EXPECT_EQ(inkOn(0xFFFFFFFFu), black);
  RenderOptions options = optionsOf(100, 100);
  options.fill = false;
  options.labels = true;
  const Rendering picture = drawn({{0.5}, {0.5}, {}}, options);
  EXPECT_EQ(std::ranges::count(picture.image.rgba, black) > 0, true);
}

TEST(Places, AViewShowsAPartOfTheDomain) {
  RenderOptions options = optionsOf(200, 100);
  options.view = Box{0.5, 0.5, 1.5, 1.0};
  const PicturePlaces places(options);
  EXPECT_EQ(places.pixelOf({0.5, 1}), (Point{0, 0}));
  EXPECT_EQ(places.pixelOf({1, 0.5}), (Point{100, 100}));
  const Box shown = places.pixels();
  EXPECT_EQ(shown.xmin, 0);
  EXPECT_EQ(shown.xmax, 100);
}

TEST(Font, CapitalsAndSmallLettersAllDiffer) {
  std::set<std::vector<std::uint32_t>> pictures;
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789:=/_.,-+%()";
  for (const char letter : letters) {
    Image image{70, 80, std::vector<std::uint32_t>(70 * 80, white), {}};
    drawTextAt(std::string(1, letter), {8, 55}, 35, black, image);
    EXPECT_TRUE(std::ranges::any_of(image.rgba, [](std::uint32_t pixel) { return pixel == black; }))
        << letter;
    pictures.insert(image.rgba);
  }
  EXPECT_EQ(pictures.size(), letters.size());
}

TEST(Font, LettersWithMarksDifferFromAllOthers) {
  const std::vector<std::string> letters = {
      "A", "À", "Á", "Â", "Ã", "Ä", "Å", "Æ", "Ç", "E", "È", "É", "Ê", "Ë",  "Ě", "Ę", "Ð",
      "Ñ", "O", "Ö", "Ő", "Ø", "Œ", "Ů", "Ű", "Þ", "ß", "a", "ä", "å", "æ",  "ç", "e", "è",
      "é", "ê", "ë", "ě", "ę", "i", "ì", "í", "î", "ï", "ı", "ð", "ñ", "o",  "ö", "ő", "ø",
      "œ", "þ", "ÿ", "ă", "ć", "č", "ď", "đ", "d", "ğ", "Ł", "L", "ł", "l",  "ľ", "ń", "ř",
      "ś", "ş", "s", "ș", "ť", "t", "ů", "ž", "ż", "ź", "z", "&", "'", "\"", "@"};
  std::set<std::vector<std::uint32_t>> pictures;
  for (const std::string& letter : letters) {
    EXPECT_TRUE(pixelsHaveLetters(letter)) << letter;
    Image image{70, 90, std::vector<std::uint32_t>(70 * 90, white), {}};
    drawTextAt(letter, {8, 65}, 35, black, image);
    pictures.insert(image.rgba);
  }
  // A cedilla stands for the comma of Romanian.
  EXPECT_EQ(pictures.size(), letters.size() - 1);
  EXPECT_EQ(unitsOf("Zürich"), unitsOf("Zurich"));
  for (const char* other : {"Москва", "東京", "Αθήνα", "\xff"})
    EXPECT_FALSE(pixelsHaveLetters(other)) << other;
}

TEST(Marks, WhatIsOutOfRangeIsRefused) {
  const auto refusal = [](const auto& change) {
    RenderOptions options = optionsOf(400, 400);
    change(options);
    const auto checked = checkPicture(options);
    return checked ? std::string() : checked.error().message;
  };
  EXPECT_THAT(refusal([](auto& options) { options.antialias = 0; }), HasSubstr("antialias 0"));
  EXPECT_THAT(refusal([](auto& options) { options.antialias = 9; }), HasSubstr("antialias 9"));
  EXPECT_THAT(refusal([](auto& options) { options.label_size = 4; }), HasSubstr("label size 4"));
  EXPECT_THAT(refusal([](auto& options) {
                options.legend = true;
                options.fill = false;
              }),
              HasSubstr("without fill"));
}

}  // namespace
}  // namespace vorpipe::test

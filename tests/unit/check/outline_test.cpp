#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "unit/fixtures/checked_runs.h"
#include "unit/fixtures/outlines.h"

namespace vorpipe::test {
namespace {

TEST(OutlineCheck, findsNothingWrong) {
  const Outline outline = country(2000);
  Sites weighted = generate(Pattern::random, 900, 3);
  for (std::size_t i = 0; i < weighted.size(); ++i) {
    weighted.weight.push_back(static_cast<double>(i % 10) * 1e-4);
  }
  const auto expectRight = [&](const Sites& sites, Detail detail) {
    CellsOptions options = inside(outline);
    options.detail = detail;
    EXPECT_THAT(*check(sites, options, cellsOf(sites, options)), testing::IsEmpty());
  };
  for (const Detail detail : {Detail::measures, Detail::polygons, Detail::everything}) {
    for (const Sites& sites :
         {mixedSites(), generate(Pattern::hex, 3000, 1), generate(Pattern::circle, 500, 1)}) {
      expectRight(sites, detail);
    }
  }
  expectRight(weighted, Detail::polygons);
}

TEST(OutlineCheck, findsWhatIsWrong) {
  const Sites sites = mixedSites();
  const CellsOptions options = inside(country(2000));
  const Diagram right = cellsOf(sites, options);
  const auto broken = [&](const auto& change) {
    Diagram d = right;
    change(d);
    return promisesOf(check(sites, options, d));
  };
  std::size_t along = 0, between = 0;
  while (right.neighbors[along] != wall_outline) ++along;
  while (right.neighbors[between] < 0) ++between;
  using testing::Contains;
  EXPECT_THAT(broken([&](Diagram& d) { d.vertices[along].x += 1e-3; }), Contains("rings"));
  EXPECT_THAT(broken([&](Diagram& d) { d.neighbors[between] = wall_outline; }), Contains("edges"));
  EXPECT_THAT(broken([&](Diagram& d) { d.neighbors[along] = wall_xmin; }), Contains("edges"));
  EXPECT_THAT(broken([&](Diagram& d) { d.area[7] += 1e-8; }),
              testing::AllOf(Contains("areas"), Contains("rings")));
  EXPECT_THAT(broken([&](Diagram& d) { d.ring_starts.erase(d.ring_starts.begin()); }), Contains("rings"));
  CellsOptions bare = options;
  bare.outline = {};
  EXPECT_THAT(promisesOf(check(sites, options, cellsOf(sites, bare))), Contains("areas"));
}

TEST(OutlineCheck, findsAreasOfThinCellsThatAreThoseOfTheirPolygons) {
  const Sites sites{{0, 0, 1}, {0, 2e-7, 0}, {}};
  for (const auto& outline : {Outline{}, outlineOf({{rectangle(0, 0, 1, 1)}})}) {
    for (const Detail detail : {Detail::measures, Detail::polygons}) {
      CellsOptions options = inside(outline);
      options.detail = detail;
      Diagram cells = cellsOf(sites, options);
      EXPECT_THAT(promisesOf(check(sites, options, cells)), testing::IsEmpty());
      cells.area[0] /= 2;
      cells.area[1] += cells.area[0];
      EXPECT_THAT(promisesOf(check(sites, options, cells)), testing::Contains("areas"));
    }
  }
}

std::string refusalOf(const Outline& outline, Periodic periodic = Periodic::none) {
  CellsOptions options = inside(outline);
  options.periodic = periodic;
  const auto cells = cpuSession().cells(generate(Pattern::random, 10, 1), options);
  if (cells) return "accepted";
  EXPECT_EQ(cells.error().code, ErrorCode::input);
  return cells.error().message;
}

TEST(OutlineCheck, outlinesOfAFewStepsOfACoordinateAreRefused) {
  for (const auto& [x, y] : {std::pair{1e9, 0.0}, {0.0, -1e9}, {1e9, 1e9}}) {
    const auto box = [x = x, y = y](double size) {
      return outlineOf({{rectangle(x - size, y - size, x + size, y + size)}});
    };
    EXPECT_THAT(refusalOf(box(2e-5)), testing::HasSubstr("is too small beside its coordinates"));
    const auto options = inside(box(4e-5), boxOf(box(4e-5).points));
    const Sites sites{{x, x + 3e-5}, {y, y}, {}};
    const auto cells = cellsOf(sites, options);
    EXPECT_EQ(cells.report.ok, 2u);
    EXPECT_THAT(promisesOf(check(sites, options, cells)), testing::IsEmpty());
  }
}

/// What rounding may have left of a flat outline follows from the coordinates that its width is seen in.
TEST(OutlineCheck, aFlatOutlineIsNoSliver) {
  const auto outline =
      outlineOf({{rectangle(14584461286.9, 23478324.999997146, 14584461289.1, 23478325.000002854)}});
  const auto options = inside(outline, boxOf(outline.points));
  EXPECT_EQ(cellsOf({{14584461289}, {23478326}, {}}, options).report.ok, 1u);
}

TEST(OutlineCheck, outlinesThatAreNoPolygonsAreRefusedWithThePlace) {
  const auto has = [](const std::string& text) { return testing::HasSubstr(text); };
  EXPECT_THAT(refusalOf(outlineOf({{{{0, 0}, {1, 1}, {1, 0}, {0, 1}}}})), has("at (0.5, 0.5)"));
  EXPECT_THAT(refusalOf(outlineOf({{rectangle(0, 0, 0.5, 0.5)}, {rectangle(0.25, 0.25, 1, 1)}})),
              testing::AnyOf(has("at (0.25, 0.5)"), has("at (0.5, 0.25)")));
  EXPECT_THAT(refusalOf(outlineOf({{rectangle(0, 0, 1, 1)}, {rectangle(0.25, 0.25, 0.5, 0.5)}})),
              has(" at ("));
  EXPECT_THAT(refusalOf(outlineOf({{rectangle(0, 0, 0.5, 0.5), rectangle(0.6, 0.6, 0.7, 0.7)}})),
              has(" at ("));
  EXPECT_THAT(refusalOf(outlineOf({{{{0, 0}, {1, 1}}}})), has("ring 0 has 2 points"));
  EXPECT_THAT(refusalOf(outlineOf({{{{0, 0}, {0.5, 0.5}, {1, 1}}}})), has(" at ("));
  EXPECT_THAT(refusalOf(outlineOf({{{{0, 0}, {1, 0}, {NAN, 1}}}})), has("point 2 of ring 0 is not finite"));
  Outline ringless = outlineOf({{rectangle(0, 0, 1, 1)}});
  ringless.polygon_offsets = {0, 0, 1};
  EXPECT_THAT(refusalOf(ringless), has("polygon 0 has no rings"));
  EXPECT_THAT(refusalOf(outlineOf({{rectangle(0, 0, 1, 1)}}), Periodic::x), has("periodic"));
  for (const double size : {1e-200, 1e200, 1e308}) {
    EXPECT_THAT(refusalOf(outlineOf({{rectangle(-size, -size, size, size)}})),
                testing::AllOf(has("outline: its box of "), has(" has no area that a double can hold")));
  }
  Outline open = outlineOf({{rectangle(0, 0, 1, 1)}});
  open.ring_offsets.back() = 3;
  EXPECT_THAT(refusalOf(open), has("offsets"));
}

}  // namespace
}  // namespace vorpipe::test

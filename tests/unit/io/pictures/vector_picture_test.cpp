#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>

#include "io/pictures/vector_picture.h"
#include "unit/fixtures/checked_runs.h"
#include "vorpipe/free_surface.h"

namespace vorpipe::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

struct Scene {
  Sites sites;
  RenderOptions options;

  [[nodiscard]] Diagram cells() const {
    CellsOptions cells = cellsOptions(options);
    cells.detail = Detail::polygons;
    return cellsOf(sites, cells);
  }
  [[nodiscard]] std::string svg() const {
    MemorySink sink("a.svg");
    const auto written = writeSvgPicture(sink, sites, cells(), options);
    EXPECT_TRUE(written) << written.error().message;
    return sink.take();
  }
  [[nodiscard]] std::string pdf() const {
    MemorySink sink("a.pdf");
    const auto written = writePdfPicture(sink, sites, cells(), options);
    EXPECT_TRUE(written) << written.error().message;
    return sink.take();
  }
};

Scene twoHalves() { return {{{0.25, 0.75}, {0.5, 0.5}, {}}, optionsOf(200, 100)}; }

std::size_t countOf(const std::string& text, std::string_view part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(VectorPicture, DrawsEachCellInItsColor) {
  const std::string svg = twoHalves().svg();
  EXPECT_THAT(svg, HasSubstr("width=\"200\" height=\"100\""));
  EXPECT_THAT(svg, HasSubstr("<title>site 0, area 0.5</title>"));
  EXPECT_EQ(countOf(svg, "<path id=\"cell-"), 2u);
  EXPECT_THAT(svg, Not(HasSubstr("<circle")));
}

TEST(VectorPicture, DrawsAnEdgeOnceAndNoneAtTheFrame) {
  Scene scene = twoHalves();
  scene.options.edges = true;
  scene.options.edge_width = 3;
  const std::string svg = scene.svg();
  const auto edges = svg.find("stroke=\"#181818\" stroke-width=\"3\"");
  ASSERT_NE(edges, std::string::npos);
  EXPECT_EQ(countOf(svg.substr(edges), "M"), 1u);
  EXPECT_THAT(svg.substr(edges), HasSubstr("M100 "));
}

TEST(VectorPicture, HasItsBackgroundBelowEverythingAndThroughCellsWithoutFill) {
  Scene scene = twoHalves();
  scene.options.background = Color{0x40332211u};
  const std::string paper = "width=\"200\" height=\"100\" fill=\"#112233\" fill-opacity=\"0.251\"/>";
  EXPECT_THAT(scene.svg(), HasSubstr(paper));
  EXPECT_EQ(countOf(scene.svg(), "\" fill=\"#"), 3u);
  scene.options.fill = false;
  EXPECT_THAT(scene.svg(), HasSubstr(paper));
  EXPECT_EQ(countOf(scene.svg(), "\" fill=\"#"), 1u);
  EXPECT_EQ(countOf(scene.svg(), "<title>site "), 2u);
  scene.options.edges = true;
  scene.options.edge_color = Color{0xFF0000FFu};
  EXPECT_THAT(scene.svg(), HasSubstr("stroke=\"#ff0000\""));
}

TEST(VectorPicture, DrawsACellOfAPeriodicDomainWhereverItShows) {
  Scene scene = twoHalves();
  scene.options.periodic = Periodic::x;
  scene.sites.x = {0.0, 0.5};
  EXPECT_EQ(countOf(scene.svg(), "<title>site 0, "), 2u);
}

TEST(VectorPicture, IsClippedToItsFrame) {
  Scene scene = twoHalves();
  scene.options.fit = Fit::letterbox;
  EXPECT_THAT(scene.svg(), HasSubstr("<rect x=\"50\" y=\"0\" width=\"100\" height=\"100\"/></clipPath>"));
}

TEST(VectorPicture, ADotStandsAtEachPositionThatShows) {
  Scene scene = twoHalves();
  scene.options.show_sites = true;
  scene.sites = {{0.25, 0.25, 0.75, 1.5}, {0.5, 0.5, 0.5, 0.5}, {}};
  scene.options.dot_size = 10;
  const std::string svg = scene.svg();
  EXPECT_EQ(countOf(svg, "<circle"), 2u);
  EXPECT_THAT(svg, HasSubstr("<circle cx=\"50\" cy=\"50\""));
}

TEST(VectorPicture, LabelsAreTextAndLinesOfTheDualRunBelowThem) {
  Scene scene = twoHalves();
  scene.options.dual = true;
  scene.options.labels = true;
  scene.options.fill = false;
  const std::string svg = scene.svg();
  EXPECT_EQ(countOf(svg, "</text>"), 2u);
  EXPECT_THAT(svg, HasSubstr("text-anchor=\"middle\">1</text>"));
  EXPECT_THAT(svg, HasSubstr("<path d=\"M50 50L150 50\"/>"));
  EXPECT_LT(svg.find("M50 50L150 50"), svg.find("<text"));
  EXPECT_EQ(countOf(svg, "\" fill=\"#ffffff\" stroke"), 2u);
}

TEST(VectorPicture, AViewShowsWhatItHasOfTheDomain) {
  Scene scene = twoHalves();
  scene.options.view = Box{0.6, 0, 1.6, 1};
  const std::string svg = scene.svg();
  EXPECT_THAT(svg, HasSubstr("<rect x=\"0\" y=\"0\" width=\"80\" height=\"100\"/></clipPath>"));
  EXPECT_EQ(countOf(svg, "<title>"), 1u);
}

TEST(VectorPicture, WhatAPictureInPixelsRefusesIsRefused) {
  Scene scene = twoHalves();
  scene.options.width = 0;
  MemorySink sink("a.svg");
  const auto written = writeSvgPicture(sink, scene.sites, twoHalves().cells(), scene.options);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::input);
  EXPECT_TRUE(sink.bytes().empty());
}

TEST(Pdf, TheTableNamesWhereObjectsBegin) {
  Scene scene = twoHalves();
  scene.options.show_sites = true;
  const std::string pdf = scene.pdf();
  EXPECT_THAT(pdf, StartsWith("%PDF-1.4\n"));
  EXPECT_THAT(pdf, HasSubstr("/MediaBox [0 0 150 75]"));
  const auto start = pdf.rfind("startxref\n");
  const auto table = std::stoul(pdf.substr(start + 10));
  ASSERT_EQ(pdf.substr(table, 5), "xref\n");
  std::size_t line = pdf.find("0000000000 65535 f \n", table) + 20;
  for (int object = 1; pdf[line] != 't'; ++object, line += 20) {
    const auto place = std::stoul(pdf.substr(line, 10));
    EXPECT_EQ(pdf.substr(place, 6), std::to_string(object) + " 0 ob");
  }
}

TEST(Pdf, ALargePictureFitsOntoAPage) {
  Scene scene = twoHalves();
  scene.options.width = 32000;
  EXPECT_THAT(scene.pdf(), HasSubstr("/MediaBox [0 0 14400 45]"));
}

/// A disc, and one of which a wall takes a part, in a picture that is twice as wide as the square.
Scene twoDrops() { return {{{0.3, 0.9}, {0.5, 0.6}, {0.0625, 0.04}}, optionsOf(400, 200)}; }

Diagram dropsOf(const Scene& scene) {
  Session session = cpuSession();
  auto cells = freeCells(session, scene.sites, cellsOptions(scene.options));
  EXPECT_TRUE(cells) << cells.error().message;
  return std::move(*cells);
}

TEST(VectorPicture, AFreeSurfaceIsDrawnAsArcs) {
  Scene scene = twoDrops();
  scene.options.edges = true;
  const Diagram cells = dropsOf(scene);
  MemorySink svg("a.svg"), pdf("a.pdf");
  ASSERT_TRUE(writeSvgPicture(svg, scene.sites, cells, scene.options));
  ASSERT_TRUE(writePdfPicture(pdf, scene.sites, cells, scene.options));
  const std::string text = svg.take();
  EXPECT_THAT(text, HasSubstr("M220 100A100 50 0 0 0 "));
  // A whole turn, and one without what the wall takes: as cells and as edges.
  EXPECT_EQ(countOf(text, "A100 50 0 0 0 "), 2u * 12);
  EXPECT_EQ(countOf(text, "A80 40 0 0 0 "), 2u * 9);
}

TEST(VectorPicture, CurvesOfArcsAreRound) {
  const Scene scene = twoDrops();
  const Diagram cells = dropsOf(scene);
  const auto picture = VectorPicture::make(scene.sites, cells, scene.options);
  ASSERT_TRUE(picture);
  int arcs = 0;
  double worst = 0;
  const auto look = [&](std::size_t, const Lines& rings) -> Result<void> {
    for (std::size_t i = 0; i < rings[0].size(); ++i) {
      const PixelArc* arc = rings.arcTo(0, i);
      if (arc == nullptr) continue;
      ++arcs;
      const Point from = rings[0][i - 1], to = rings[0][i];
      const auto [first, second] = arc->handles();
      for (double t = 0; t <= 1; t += 1.0 / 64) {
        const double s = 1 - t, a = s * s * s, b = 3 * s * s * t, c = 3 * s * t * t, d = t * t * t;
        const double x = a * from.x + b * first.x + c * second.x + d * to.x - arc->center.x;
        const double y = a * from.y + b * first.y + c * second.y + d * to.y - arc->center.y;
        worst = std::max(worst, std::abs(std::hypot(x / arc->radii.x, y / arc->radii.y) - 1));
      }
    }
    return {};
  };
  ASSERT_TRUE(picture->eachCell(look));
  EXPECT_EQ(arcs, 12 + 9);
  EXPECT_LT(worst, 1e-6);
}

TEST(VectorPicture, TheSameCellsGiveTheSameBytes) {
  const Scene scene{mixedSites(), optionsOf(300, 200)};
  EXPECT_EQ(scene.svg(), scene.svg());
  EXPECT_EQ(scene.pdf(), scene.pdf());
}

TEST(VectorPicture, WritingStopsWhereBytesAreRefused) {
  const Scene scene{mixedSites(), optionsOf(300, 200)};
  const Diagram cells = scene.cells();
  for (const auto write : {writeSvgPicture, writePdfPicture}) {
    for (const std::size_t room : {0U, 100U, 3000U}) {
      std::size_t taken = 0;
      CallbackSink sink("full", [&](std::string_view bytes) { return (taken += bytes.size()) <= room; });
      const auto written = write(sink, scene.sites, cells, scene.options, 1);
      ASSERT_FALSE(written);
      EXPECT_EQ(written.error().code, ErrorCode::device);
    }
  }
}

}  // namespace
}  // namespace vorpipe::test

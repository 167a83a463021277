/// What every backend promises of views, and of sites that are kept between pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "conformance/cells_fixture.h"
#include "support/devices/backends.h"
#include "support/oracles/oracle.h"
#include "support/shared.h"
#include "vorpipe.h"

namespace vorpipe::test {
namespace {

RenderOptions pictureOf(const std::optional<Box>& view, int width = 90, int height = 70) {
  RenderOptions wanted{};
  wanted.domain = unit;
  wanted.width = width;
  wanted.height = height;
  wanted.view = view;
  return wanted;
}

Box around(Point center, double width, double height) {
  return {center.x - width / 2, center.y - height / 2, center.x + width / 2, center.y + height / 2};
}

/// The least of the vertices where three cells meet, of those well inside the domain.
Point someVertex(const Diagram& cells) {
  for (const Point p : cells.vertices) {
    if (p.x > 0.3 && p.x < 0.7 && p.y > 0.3 && p.y < 0.7) return p;
  }
  throw std::runtime_error("there is none");
}

class Views : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override { SKIP_UNUSABLE(GetParam()); }

  /// One for all tests of a process.
  static Session& session() {
    return Shared<Session>::get(GetParam(), [] {
      BackendOptions chosen;
      chosen.name = GetParam();
      chosen.validation = true;
      auto opened = Session::open(chosen);
      if (!opened) throw std::runtime_error(opened.error().message);
      return std::move(*opened);
    });
  }

  static Rendering render(const Sites& sites, const RenderOptions& wanted) {
    auto rendering = session().render(sites, wanted);
    if (!rendering) throw std::runtime_error(rendering.error().message);
    EXPECT_EQ(rendering->report.validation_messages, std::vector<std::string>{});
    return std::move(*rendering);
  }

  /// A picture of a view: it holds what is promised of any, and says of sites what one of the domain says.
  static Rendering expectRight(const Sites& sites, const RenderOptions& wanted) {
    auto rendering = render(sites, wanted);
    const auto broken = check(sites, wanted, rendering);
    EXPECT_EQ(broken.value_or(std::vector<std::string>{"not checked"}), std::vector<std::string>{});
    RenderOptions whole = wanted;
    whole.view.reset();
    const auto all = render(sites, whole);
    EXPECT_EQ(rendering.status, all.status);
    EXPECT_EQ(rendering.owner, all.owner);
    expectSameColors(rendering.image, all.image);
    return rendering;
  }

  static void expectSameColors(const Image& a, const Image& b) {
    std::map<std::uint32_t, std::uint32_t> color_of;
    for (std::size_t i = 0; i < b.ids.size(); ++i) color_of[b.ids[i]] = b.rgba[i];
    for (std::size_t i = 0; i < a.ids.size(); ++i) {
      const auto known = color_of.find(a.ids[i]);
      const bool is_new = known == color_of.end() && a.ids[i] != no_site;
      const auto expected = known == color_of.end() ? 0u : known->second;
      ASSERT_TRUE(is_new || a.rgba[i] == expected) << "of site " << a.ids[i];
    }
  }
};

TEST_P(Views, partsOfTheDomainShowTheNearestEverywhere) {
  for (const std::uint64_t n : {1u, 30u, 3000u}) {
    const auto sites = generate(Pattern::random, n, 7);
    for (const Box& view : {Box{0.2, 0.3, 0.9, 0.6}, Box{0.41, 0.77, 0.43, 0.78}, Box{0, 0.98, 0.01, 1}}) {
      SCOPED_TRACE(testing::Message() << n << " sites, view from " << view.xmin);
      const auto rendering = expectRight(sites, pictureOf(view, 50, 40));
      expectNearestEverywhere(rendering.image, sites, view);
    }
  }
}

TEST_P(Views, crowdsBesideEmptySpaceAreDrawn) {
  const auto sites = generate(Pattern::clusters, 3000, 3);
  for (double at = 0.05; at < 1; at += 0.25) {
    const Box view = around({at, 1 - at}, 0.08, 0.06);
    expectNearestEverywhere(expectRight(sites, pictureOf(view, 50, 40)).image, sites, view);
  }
}

TEST_P(Views, pixelsBeyondTheDomainHaveNoSite) {
  const auto sites = generate(Pattern::random, 500, 9);
  for (const Box& view :
       {Box{-0.5, -1, 1.5, 2}, Box{0.9, 0.2, 1.3, 0.4}, Box{2, 2, 3, 3}, Box{-3, 0.5, 8, 0.6}}) {
    SCOPED_TRACE(testing::Message() << "view from " << view.xmin);
    const RenderOptions wanted = pictureOf(view, 80, 60);
    const auto rendering = expectRight(sites, wanted);
    for (int row = 0; row < 60; ++row) {
      for (int column = 0; column < 80; ++column) {
        const double x = view.xmin + (column + 0.5) / 80 * (view.xmax - view.xmin);
        const double y = view.ymax - (row + 0.5) / 60 * (view.ymax - view.ymin);
        const bool inside = x >= 0 && x <= 1 && y >= 0 && y <= 1;
        const auto id = rendering.image.ids[static_cast<std::size_t>(row * 80 + column)];
        ASSERT_EQ(id != no_site, inside) << row << ' ' << column;
      }
    }
  }
}

TEST_P(Views, aBillionthOfTheDomainIsShownAsSharply) {
  auto sites = generate(Pattern::random, 2000, 21);
  const auto cells = session().cells(sites, [] {
    CellsOptions wanted{};
    wanted.domain = unit;
    wanted.detail = Detail::polygons;
    return wanted;
  }());
  ASSERT_TRUE(cells);
  const Point vertex = someVertex(*cells);
  for (const double size : {1e-3, 1e-6, 1e-9}) {
    SCOPED_TRACE(size);
    const Box view = around(vertex, size, 0.8 * size);
    const auto rendering = expectRight(sites, pictureOf(view, 100, 80));
    auto ids = rendering.image.ids;
    std::ranges::sort(ids);
    EXPECT_EQ(std::unique(ids.begin(), ids.end()) - ids.begin(), 3);
  }
  // Sites as near to each other as what a pixel shows.
  Sites near = generate(Pattern::random, 300, 4);
  for (std::size_t i = 0; i < near.size(); ++i) {
    sites.x.push_back(0.5 + 1e-9 * near.x[i]);
    sites.y.push_back(0.5 + 1e-9 * near.y[i]);
  }
  expectRight(sites, pictureOf(Box{0.5, 0.5, 0.5 + 1e-9, 0.5 + 1e-9}));
}

TEST_P(Views, periodicDomainsShowOnePeriod) {
  const auto sites = generate(Pattern::random, 400, 31);
  for (const auto periodic : {Periodic::x, Periodic::xy}) {
    for (const Box& view : {Box{0.7, 0.8, 1, 1}, Box{-0.2, -0.3, 1.2, 1.3}, Box{0.98, 0, 1, 0.02}}) {
      RenderOptions wanted = pictureOf(view);
      wanted.periodic = periodic;
      wanted.domain = {0, 0, 1, 1};
      expectRight(sites, wanted);
    }
  }
}

TEST_P(Views, weightsOutlinesFitsAndMarks) {
  auto sites = generate(Pattern::random, 300, 41);
  RenderOptions wanted = pictureOf(Box{0.3, 0.1, 0.8, 0.7}, 160, 110);
  wanted.fit = Fit::letterbox;
  wanted.color = ColorBy::area;
  expectRight(sites, wanted);
  wanted.outline = {{{0.1, 0.1}, {0.9, 0.2}, {0.6, 0.9}}, {0, 3}, {0, 1}};
  expectRight(sites, wanted);
  wanted.color = ColorBy::site;
  expectRight(sites, wanted);
  for (std::size_t i = 0; i < sites.size(); ++i) sites.weight.push_back(i % 7 == 0 ? 0.004 : 0);
  wanted.color = ColorBy::weight;
  expectRight(sites, wanted);
  wanted.outline = {};
  wanted.view = Box{-0.4, 0.2, 0.3, 0.5};
  expectRight(sites, wanted);
  const auto plain = render(sites, wanted);
  wanted.edges = wanted.show_sites = wanted.legend = true;
  const auto marked = render(sites, wanted);
  EXPECT_EQ(marked.image.ids, plain.image.ids);
  EXPECT_NE(marked.image.rgba, plain.image.rgba);
}

TEST_P(Views, bothSearchesAgree) {
  const auto sites = generate(Pattern::random, 2000, 51);
  RenderOptions wanted = pictureOf(Box{0.45, 0.4, 0.55, 0.5}, 50, 40);
  wanted.search.method = Search::flann;
  expectNearestEverywhere(expectRight(sites, wanted).image, sites, *wanted.view);
}

TEST_P(Views, noRectangleIsRefused) {
  const auto sites = generate(Pattern::random, 10, 1);
  for (const Box& view : {Box{0, 0, 0, 1}, Box{0, 1, 1, 0}, Box{0, 0, HUGE_VAL, 1}, Box{0, 0, NAN, 1},
                          Box{0.5, 0.5, 0.5 + 1e-13, 0.5 + 1e-13}, Box{1e10, 0, 1e10 + 1, 1}}) {
    const auto rendering = session().render(sites, pictureOf(view));
    ASSERT_FALSE(rendering);
    EXPECT_EQ(rendering.error().code, ErrorCode::input);
    EXPECT_NE(rendering.error().message.find("view"), std::string::npos) << rendering.error().message;
  }
}

/// Asks for the same picture of kept sites and of the session; returns the first.
Rendering expectSame(KeptSites& kept, Session& session, const RenderOptions& wanted) {
  auto a = kept.render(wanted);
  auto b = session.render(kept.sites(), wanted);
  if (!a) throw std::runtime_error(a.error().message);
  if (!b) throw std::runtime_error(b.error().message);
  EXPECT_TRUE(a->image.ids == b->image.ids);
  EXPECT_TRUE(a->image.rgba == b->image.rgba);
  EXPECT_EQ(a->status, b->status);
  EXPECT_EQ(a->owner, b->owner);
  EXPECT_EQ(a->key.has_value(), b->key.has_value());
  EXPECT_EQ(a->report.ok, b->report.ok);
  EXPECT_EQ(a->report.validation_messages, std::vector<std::string>{});
  return std::move(*a);
}

std::vector<RenderOptions> someViews(const RenderOptions& from) {
  std::vector<RenderOptions> wanted(6, from);
  wanted[1].view = Box{0.2, 0.3, 0.5, 0.6};
  wanted[2].view = Box{0.4, 0.4, 0.41, 0.41};
  wanted[2].edges = wanted[2].show_sites = true;
  wanted[3].view = Box{-0.2, 0.5, 0.4, 1.3};
  wanted[3].width = 33;
  wanted[4].view = Box{3, 3, 4, 4};
  wanted[5].colormap = "magma";
  return wanted;
}

TEST_P(Views, keptSitesDrawWhatTheSessionDraws) {
  auto sites = generate(Pattern::random, 2000, 61);
  for (std::size_t i = 0; i < 100; ++i) {
    sites.x.push_back(1.02 + 0.2 * sites.x[i]);
    sites.y.push_back(sites.y[i]);
    sites.x.push_back(sites.x[i]);
    sites.y.push_back(sites.y[i]);
  }
  KeptSites kept(session(), sites);
  for (const auto color : {ColorBy::site, ColorBy::area, ColorBy::neighbors, ColorBy::site}) {
    RenderOptions wanted = pictureOf(std::nullopt);
    wanted.color = color;
    for (const RenderOptions& each : someViews(wanted)) expectSame(kept, session(), each);
  }
  RenderOptions periodic = pictureOf(std::nullopt);
  periodic.periodic = Periodic::xy;
  for (const RenderOptions& each : someViews(periodic)) expectSame(kept, session(), each);
  RenderOptions outlined = pictureOf(std::nullopt);
  outlined.outline = {{{0.1, 0.1}, {0.9, 0.2}, {0.6, 0.9}}, {0, 3}, {0, 1}};
  for (const RenderOptions& each : someViews(outlined)) expectSame(kept, session(), each);
}

TEST_P(Views, keptSitesWithWeightsDrawWhatTheSessionDraws) {
  auto sites = generate(Pattern::random, 1500, 71);
  for (std::size_t i = 0; i < sites.size(); ++i) sites.weight.push_back(i % 5 == 0 ? 0.003 : 0);
  KeptSites kept(session(), sites);
  RenderOptions wanted = pictureOf(std::nullopt);
  for (const auto color : {ColorBy::weight, ColorBy::area, ColorBy::site}) {
    wanted.color = color;
    for (const RenderOptions& each : someViews(wanted)) expectSame(kept, session(), each);
  }
}

TEST_P(Views, keptSitesAreUploadedOnce) {
  KeptSites kept(session(), generate(Pattern::random, 3000, 81));
  RenderOptions wanted = pictureOf(std::nullopt);
  const auto draw = [&] {
    const auto drawn = kept.render(wanted);
    if (!drawn) throw std::runtime_error(drawn.error().message);
    return drawn->report.time_ms.upload > 0;
  };
  EXPECT_TRUE(draw());
  wanted.view = Box{0.1, 0.1, 0.6, 0.7};
  wanted.show_sites = true;
  EXPECT_FALSE(draw());
  wanted.colormap = "gray";
  wanted.width = 31;
  EXPECT_FALSE(draw());
  // Another set takes their place.
  render(generate(Pattern::random, 50, 1), pictureOf(std::nullopt));
  EXPECT_TRUE(draw());
  EXPECT_FALSE(draw());
}

TEST_P(Views, measuresAreFoundOnceAndSharedWithPictures) {
  KeptSites kept(session(), generate(Pattern::random, 500, 91));
  CellsOptions options{};
  options.domain = unit;
  const auto first = kept.measures(options);
  ASSERT_TRUE(first);
  const auto direct = session().cells(kept.sites(), options);
  ASSERT_TRUE(direct);
  EXPECT_EQ((*first)->area, direct->area);
  EXPECT_EQ((*first)->neighbors, direct->neighbors);
  const double* const there = (*first)->area.data();
  RenderOptions wanted = pictureOf(std::nullopt);
  wanted.color = ColorBy::area;
  expectSame(kept, session(), wanted);
  const auto again = kept.measures(options);
  ASSERT_TRUE(again);
  EXPECT_EQ((*again)->area.data(), there);
  options.density = {2, 1, {1, 3}};
  const auto with_mass = kept.measures(options);
  ASSERT_TRUE(with_mass);
  EXPECT_EQ((*with_mass)->mass.size(), 500u);
  options.density = {};
  options.domain = {0, 0, 2, 1};
  const auto other = kept.measures(options);
  ASSERT_TRUE(other);
  EXPECT_NEAR(areaSum(**other), 2, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Backends, Views, testing::ValuesIn(backend_names),
                         [](const auto& instance) { return testName(instance.param); });

}  // namespace
}  // namespace vorpipe::test

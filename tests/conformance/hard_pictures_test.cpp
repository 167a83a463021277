// Pictures where floats, pixels and places are at their limits: the same for every backend.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "picture_of.h"
#include "support/devices/backends.h"
#include "support/oracles/oracle.h"
#include "support/shared.h"
#include "support/sites/random_sites.h"
#include "support/sites/unit.h"
#include "vorpipe.h"

namespace vorpipe::test {
namespace {

class HardPictures : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override { SKIP_UNUSABLE(GetParam()); }

  /// One for all tests of a process, for each number of bits. The cpu has no vertex grid.
  static Session& session(const std::string& name, int subpixel_bits) {
    const bool masked = subpixel_bits < 8 && name != "cpu";
    return Shared<Session>::get(masked ? name + std::to_string(subpixel_bits) : name, [&] {
      BackendOptions options;
      options.name = name;
      options.validation = true;
      if (masked) options.mask.limits = {{"subPixelPrecisionBits", subpixel_bits}};
      auto opened = Session::open(options);
      if (!opened) throw std::runtime_error(opened.error().message);
      return std::move(*opened);
    });
  }

  static Rendering draw(const std::string& name, const Sites& sites, const RenderOptions& options,
                        int bits = 8) {
    auto rendering = session(name, bits).render(sites, options);
    if (!rendering) throw std::runtime_error(rendering.error().message);
    EXPECT_EQ(rendering->report.validation_messages, std::vector<std::string>{});
    return std::move(*rendering);
  }

  /// No pixel wrong, by what --check does and by the picture of `cpu`.
  static Rendering expectRight(const Sites& sites, const RenderOptions& options, int bits = 8) {
    auto rendering = draw(GetParam(), sites, options, bits);
    const auto broken = check(sites, options, rendering);
    EXPECT_TRUE(broken.has_value() && broken->empty()) << (broken ? broken->front() : broken.error().message);
    const auto judged = draw("cpu", sites, options);
    const auto diff = diffIds(rendering.image.ids, judged.image.ids, options.width, options.height, sites,
                              options.domain, options.periodic);
    EXPECT_TRUE(diff.has_value() && diff->wrong == 0);
    return rendering;
  }

  [[nodiscard]] static bool isCpu() { return std::string_view(GetParam()) == "cpu"; }

  Random random{11};

  Sites scattered(const Box& domain, std::size_t count) {
    Sites sites;
    for (std::size_t i = 0; i < count; ++i) {
      add(sites, {domain.xmin + random.uniform() * (domain.xmax - domain.xmin),
                  domain.ymin + random.uniform() * (domain.ymax - domain.ymin)});
    }
    return sites;
  }

  /// Two to four crowds of two to ten sites, so wide in parts of the domain.
  Sites crowds(const Box& domain, double width, bool weighted) {
    const double side = domain.xmax - domain.xmin;
    Sites sites;
    for (std::size_t crowd = 0; crowd < 2 + random.below(3); ++crowd) {
      const Sites center = scattered(domain, 1);
      for (std::size_t i = 0; i < 2 + random.below(9); ++i) {
        add(sites, {center.x[0] + width * side * (random.uniform() - 0.5),
                    center.y[0] + width * side * (random.uniform() - 0.5)});
        if (weighted) sites.weight.push_back(0.1 * random.uniform() * width * width * side * side);
      }
    }
    return sites;
  }
};

TEST_P(HardPictures, OfSitesThatAreAllButOne) {
  for (int power = 6; power <= 13; ++power) {
    for (const bool weighted : {false, true}) {
      for (const int size : {97, 400}) {
        SCOPED_TRACE(testing::Message() << "1e-" << power << ", " << weighted << ", " << size);
        const Box domain = random.below(2) == 0 ? unit : Box{-3, 7, 1, 10};
        expectRight(crowds(domain, std::pow(10, -power), weighted), pictureOf(domain, size, size));
      }
    }
  }
  expectRight(crowds(unit, 1e-11, false), pictureOf(unit, 1000, 1000));
}

// Pairs among many: few cells are left to the judge, and none of the others.
TEST_P(HardPictures, OfPairsAmongManySites) {
  auto sites = scattered(unit, 40000);
  for (std::size_t i = 0; i < 100; ++i) add(sites, {sites.x[i] + 1e-11, sites.y[i]});
  const auto paired = expectRight(sites, pictureOf(unit, 300, 300)).report;
  EXPECT_LT(paired.in_double, 300u);
}

// Floats lose too much of cells that reach so far; none of the grid's and none of a list's is drawn from
// them.
TEST_P(HardPictures, OfCellsThatReachFar) {
  for (const auto method : {Search::grid, Search::flann}) {
    auto options = pictureOf(unit, 3000, 300);
    options.search.method = method;
    const auto far = expectRight(scattered(unit, 5), options).report;
    EXPECT_TRUE(isCpu() || far.in_double == 5) << far.in_double;
  }
}

// A weight of 1e10 squared domains in two floats is off by 1e-5 of one: the bisector by a fifth of a pixel.
// Cells with weights are found and agree before they are drawn, as polygons that are computed in double.
TEST_P(HardPictures, OfWeightsThatTwoFloatsDoNotHold) {
  auto sites = scattered(unit, 200);
  for (std::size_t i = 0; i < sites.size(); ++i) sites.weight.push_back(1e10 + 1e-3 * random.uniform());
  add(sites, {0.5, 0.5});
  sites.weight.push_back(0);
  expectRight(sites, pictureOf(unit, 1000, 1000));
}

TEST_P(HardPictures, OnCoarseVertexGrids) {
  for (const int bits : {4, 5}) {
    for (const std::size_t count : {2u, 30u, 900u, 20000u}) {
      SCOPED_TRACE(testing::Message() << bits << " bits, " << count << " sites");
      const auto sites = scattered(unit, count);
      const auto rendering = expectRight(sites, pictureOf(unit, 200, 160), bits);
      EXPECT_EQ(rendering.report.ok, count);
      const bool leaves_some = !isCpu() && bits == 4 && count >= 30;
      EXPECT_TRUE(!leaves_some || rendering.report.pixels > 0);
      EXPECT_LT(rendering.report.pixels, 200u * 160u / 5);
    }
  }
  for (const int power : {7, 11}) {
    expectRight(crowds(unit, std::pow(10, -power), true), pictureOf(unit, 200, 200), 4);
  }
}

TEST_P(HardPictures, OnCoarseVertexGridsOfAnyShape) {
  auto options = pictureOf(unit, 180, 240);
  const auto sites = generate(Pattern::clusters, 700, 5);
  for (const auto periodic : {Periodic::none, Periodic::xy}) {
    options.periodic = periodic;
    expectRight(sites, options, 4);
  }
  options.periodic = Periodic::none;
  options.search.method = Search::flann;
  expectRight(sites, options, 4);
  options.search.method = Search::grid;
  options.outline.points = {{0.1, 0.1}, {0.9, 0.2}, {0.4, 0.9}};
  options.outline.ring_offsets = {0, 3};
  options.outline.polygon_offsets = {0, 1};
  expectRight(sites, options, 4);
  // One cell with very many edges.
  auto circle = generate(Pattern::circle, 600, 1);
  add(circle, {0.5, 0.5});
  expectRight(circle, pictureOf(unit, 200, 200), 4);
}

TEST_P(HardPictures, OfFewSitesInManyPixels) {
  const Box wide{0, 0, 9000, 12};
  for (const std::size_t count : {2u, 9u}) {
    for (const auto method : {Search::grid, Search::flann}) {
      auto options = pictureOf(wide, 9000, 12);
      options.search = {method, 3};
      const auto sites = scattered(wide, count);
      expectNearestEverywhere(expectRight(sites, options).image, sites, wide);
    }
  }
}

// A double near 1e12 is a multiple of 2^-13. Where the domain lies is no part of the picture.
TEST_P(HardPictures, FarFromTheOrigin) {
  Sites near;
  constexpr double step = 0x1p-13;
  for (int i = 0; i < 300; ++i) {
    add(near,
        {step * static_cast<double>(random.below(4097)), step * static_cast<double>(random.below(4097))});
  }
  const Box domain{0, 0, 0.5, 0.5};
  for (const Point offset : {Point{1e12, 1e12}, Point{-3e11, 0}, Point{0, 7e11}, Point{-1e12, 9e11}}) {
    Sites far = near;
    for (double& x : far.x) x += offset.x;
    for (double& y : far.y) y += offset.y;
    const Box there{offset.x, offset.y, offset.x + 0.5, offset.y + 0.5};
    for (const int size : {64, 501}) {
      for (const auto periodic : {Periodic::none, Periodic::x}) {
        SCOPED_TRACE(testing::Message() << offset.x << ", " << offset.y << ", " << size);
        auto here = pictureOf(domain, size, size), elsewhere = pictureOf(there, size, size);
        here.periodic = elsewhere.periodic = periodic;
        auto rendering = expectRight(far, elsewhere);
        const auto diff = diffIds(rendering.image.ids, draw(GetParam(), near, here).image.ids, size, size,
                                  near, domain, periodic);
        EXPECT_TRUE(diff.has_value() && diff->wrong == 0);
        auto& id = rendering.image.ids[static_cast<std::size_t>(size) * 20 + 20];
        id = id == 5 ? 6 : 5;
        EXPECT_EQ(check(far, elsewhere, rendering)->size(), 1u) << "a wrong pixel is found there, too";
      }
    }
  }
}

TEST_P(HardPictures, FarFromTheOriginInSeveralViews) {
  const Box there{1e12, -1e12, 1e12 + 0.5, -1e12 + 0.0009765625};
  Sites sites;
  for (int i = 0; i < 40; ++i) {
    add(sites, {there.xmin + 0x1p-13 * static_cast<double>(random.below(4097)),
                there.ymin + 0x1p-13 * static_cast<double>(random.below(9))});
  }
  expectRight(sites, pictureOf(there, 9000, 18));
}

INSTANTIATE_TEST_SUITE_P(Backends, HardPictures, testing::ValuesIn(backend_names),
                         [](const auto& tested) { return testName(tested.param); });

}  // namespace
}  // namespace vorpipe::test

/// The cells of every backend, by name, against exact arithmetic: the data sets at small sizes, searches,
/// and devices that can do less. The program exact_cells does the same at any size.
///
/// Real sites are read from the folder VORPIPE_TEST_DATA, if it is set.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "io/sites_file.h"
#include "support/backends.h"
#include "support/data_sets.h"
#include "support/exact_comparison.h"
#include "support/exact_triangles.h"
#include "support/shared.h"

namespace vorpipe::test {
namespace {

constexpr std::uint64_t seed = 20261121;

/// A data set with its exact cells, made once for all tests of a process.
struct Judged {
  DataSet set;
  ExactCells exact;
};

const Judged& judged(const std::string& name, std::uint64_t n) {
  static std::map<std::pair<std::string, std::uint64_t>, Judged> known;
  const auto [place, fresh] = known.try_emplace({name, n});
  if (fresh) {
    place->second.set = makeDataSet(name, n, seed);
    place->second.exact = exactCells(place->second.set.sites, place->second.set.domain);
  }
  return place->second;
}

CellsOptions cellsOptions(const Box& domain, Search method = Search::grid, int neighbors = 30) {
  CellsOptions options{};
  options.domain = domain;
  options.search = {method, neighbors};
  return options;
}

void expectExact(Session& session, const Sites& sites, const CellsOptions& options, const ExactCells& exact) {
  const auto diagram = session.cells(sites, options);
  ASSERT_TRUE(diagram) << diagram.error().message;
  EXPECT_EQ(diagram->report.validation_messages, std::vector<std::string>{});
  const auto comparison = compareWithExact(*diagram, sites, options.domain, exact);
  EXPECT_TRUE(comparison.agree()) << comparison.summary();
  for (const auto& fault : comparison.first) ADD_FAILURE() << fault;
  for (const auto& fault : findTriangleFaults(*diagram, sites, options.domain, exact).first)
    ADD_FAILURE() << fault;
}

/// What a device is said to lack.
struct Masked {
  const char* name;
  Mask mask;
};

const std::vector<Masked>& masks() {
  static const std::vector<Masked> all{
      {"noGeometryShader", {{"geometryShader"}, {}}},
      {"noDoubles", {{"shaderFloat64"}, {}}},
      {"smallDevice",
       {{"geometryShader", "shaderFloat64"},
        {{"maxTexelBufferElements", 65536}, {"maxStorageBufferRange", 134217728}}}},
      {"smallTexelBuffers", {{}, {{"maxTexelBufferElements", 65536}}}},
      {"tinyBuffers", {{}, {{"maxTexelBufferElements", 2048}, {"maxStorageBufferRange", 1 << 17}}}},
  };
  return all;
}

bool lacks(const Mask& mask, const std::string& feature) {
  return std::find(mask.disabled.begin(), mask.disabled.end(), feature) != mask.disabled.end();
}

/// Opens a backend's session once; it serves all tests of the process.
class OnBackend {
 protected:
  static BackendOptions backendOptions(const std::string& name) {
    BackendOptions options;
    options.name = name;
    options.validation = true;
    return options;
  }

  static Session& session(const std::string& name) {
    return Shared<Session>::get(name, [&] {
      auto opened = Session::open(backendOptions(name));
      if (!opened) throw std::runtime_error(opened.error().message);
      return std::move(*opened);
    });
  }
};

class AgainstExactCells : public testing::TestWithParam<std::tuple<const char*, std::string>>,
                          protected OnBackend {
 protected:
  void SetUp() override { SKIP_UNUSABLE(backend()); }
  static const char* backend() { return std::get<0>(GetParam()); }
  static const std::string& set() { return std::get<1>(GetParam()); }
};

TEST_P(AgainstExactCells, agreeOn) {
  for (const std::uint64_t n : {60u, 800u}) {
    const auto& [set, exact] = judged(AgainstExactCells::set(), n);
    SCOPED_TRACE(testing::Message() << set.sites.size() << " sites, seed " << seed);
    expectExact(session(backend()), set.sites, cellsOptions(set.domain), exact);
  }
}

std::vector<std::string> setNames() {
  std::vector<std::string> names;
  for (const auto* kinds : {&dataSetKinds(), &weightedSetKinds()}) {
    for (const auto& kind : *kinds) names.emplace_back(kind.name);
  }
  return names;
}

INSTANTIATE_TEST_SUITE_P(Backends, AgainstExactCells,
                         testing::Combine(testing::ValuesIn(backend_names), testing::ValuesIn(setNames())),
                         [](const auto& instance) {
                           std::string set = std::get<1>(instance.param);
                           std::replace(set.begin(), set.end(), '-', '_');
                           return testName(std::get<0>(instance.param)) + "_" + set;
                         });

class ExactOnBackend : public testing::TestWithParam<const char*>, protected OnBackend {
 protected:
  void SetUp() override { SKIP_UNUSABLE(GetParam()); }
};

TEST_P(ExactOnBackend, whateverFindsTheNeighbors) {
  for (const char* name : {"random", "clusters", "board", "pairs", "curves", "cropped", "square-cut"}) {
    const auto& [set, exact] = judged(name, 800);
    for (const int neighbors : {5, 30}) {
      SCOPED_TRACE(testing::Message() << name << ", flann:" << neighbors << ", seed " << seed);
      expectExact(session(GetParam()), set.sites, cellsOptions(set.domain, Search::flann, neighbors), exact);
    }
  }
}

TEST_P(ExactOnBackend, onMaskedDevices) {
  for (const auto& [name, mask] : masks()) {
    auto options = backendOptions(GetParam());
    options.mask = mask;
    auto masked = Session::open(options);
    const bool needs_geometry =
        GetParam() == std::string("vulkan-geometry") || GetParam() == std::string("opengl");
    if (needs_geometry && lacks(mask, "geometryShader")) {
      EXPECT_TRUE(!masked && masked.error().code == ErrorCode::device) << name;
      continue;
    }
    ASSERT_TRUE(masked) << name << ": " << masked.error().message;
    for (const char* kind : {"random", "clusters", "circle-center", "dust"}) {
      const auto& [set, exact] = judged(kind, 3000);
      SCOPED_TRACE(testing::Message() << kind << " on " << name << ", seed " << seed);
      expectExact(*masked, set.sites, cellsOptions(set.domain), exact);
    }
  }
}

TEST_P(ExactOnBackend, ofWeightedSitesInTiles) {
  auto options = backendOptions(GetParam());
  options.mask.limits = {{"maxTexelBufferElements", 2048}, {"maxStorageBufferRange", 1 << 17}};
  auto masked = Session::open(options);
  ASSERT_TRUE(masked) << masked.error().message;
  for (const char* kind : {"weights-1", "weights-100", "towns", "ten-heavy", "verge"}) {
    const auto& [set, exact] = judged(kind, 3000);
    SCOPED_TRACE(testing::Message() << kind << ", seed " << seed);
    expectExact(*masked, set.sites, cellsOptions(set.domain), exact);
  }
}

/// A site between four others is hidden by the last bit of its weight, or not, or on the verge of it.
TEST_P(ExactOnBackend, ofASiteOnTheVerge) {
  for (const double off : {-0x1p-36, 0.0, 0x1p-36, 0x1p-20}) {
    SCOPED_TRACE(off);
    const Sites sites{{192, 250, 256, 192, 256}, {384, 395, 384, 448, 448}, {0, -931 + off, 0, 0, 0}};
    for (const Box domain : {Box{-25, -25, 527, 532}, Box{200, 400, 210, 410}}) {
      expectExact(session(GetParam()), sites, cellsOptions(domain), exactCells(sites, domain));
    }
  }
}

/// More sites than 65,536 texels or a view of 2^17 bytes hold.
TEST_P(ExactOnBackend, whereTheSitesExceedTheTexels) {
  const auto& [set, exact] = judged("random", 70000);
  auto options = backendOptions(GetParam());
  options.mask.limits = {{"maxTexelBufferElements", 65536}, {"maxStorageBufferRange", 134217728}};
  auto masked = Session::open(options);
  ASSERT_TRUE(masked) << masked.error().message;
  expectExact(*masked, set.sites, cellsOptions(set.domain), exact);
}

TEST_P(ExactOnBackend, forRealSites) {
  const char* folder = std::getenv("VORPIPE_TEST_DATA");
  if (!folder) GTEST_SKIP() << "VORPIPE_TEST_DATA names no folder of real sites";
  // Not those with sites nearer to each other than 1e-12 of the domain, and not the largest.
  std::vector<std::string> names{"navaids", "jcv_issue91", "delaunator_robustness4"};
  for (int i = 1; i <= 11; ++i) names.push_back("voronoice_degenerated" + std::to_string(i));
  for (const auto& name : names) {
    SCOPED_TRACE(name);
    const auto sites = readSites((std::filesystem::path(folder) / (name + ".csv")).string());
    ASSERT_TRUE(sites) << sites.error().message;
    const auto domain = boxAround(*sites);
    expectExact(session(GetParam()), *sites, cellsOptions(domain), exactCells(*sites, domain));
  }
}

TEST_P(ExactOnBackend, forRealCities) {
  const char* folder = std::getenv("VORPIPE_TEST_DATA");
  if (!folder) GTEST_SKIP() << "VORPIPE_TEST_DATA names no folder of real sites";
  const auto cities = readSites((std::filesystem::path(folder) / "us_cities.csv").string());
  ASSERT_TRUE(cities) << cities.error().message;
  const auto domain = boxAround(*cities);
  for (const double square_degrees_each : {0.0, 1e-7, 1e-6, 1e-5, 1.0}) {
    SCOPED_TRACE(square_degrees_each);
    auto sites = *cities;
    for (auto& weight : sites.weight) weight *= square_degrees_each;
    expectExact(session(GetParam()), sites, cellsOptions(domain), exactCells(sites, domain));
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, ExactOnBackend, testing::ValuesIn(backend_names),
                         [](const auto& instance) { return testName(instance.param); });

}  // namespace
}  // namespace vorpipe::test

/// The cells of every backend, by name, against exact arithmetic: the data sets at small sizes, searches,
/// and devices that can do less. The program exact_cells does the same at any size.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "exact_fixture.h"
#include "support/devices/backends.h"
#include "support/oracles/same_bytes.h"
#include "support/sites/data_sets.h"

namespace vorpipe::test {
namespace {

constexpr std::uint64_t seed = 20261121;

/// A data set with its exact cells, made once for all tests of a process, and a diagram that agrees with
/// them.
struct FoundExactly {
  DataSet set;
  ExactCells exact;
  Diagram right;
};

FoundExactly& judged(std::string_view name, std::uint64_t n) {
  static std::map<std::pair<std::string, std::uint64_t>, FoundExactly> known;
  const auto [place, fresh] = known.try_emplace({std::string(name), n});
  if (fresh) {
    place->second.set = makeDataSet(place->first.first, n, seed);
    place->second.exact = exactCells(place->second.set.sites, place->second.set.domain);
  }
  return place->second;
}

/// Judges a diagram of the whole set, but not again what has the bytes of one that was right.
void expectExact(Session& session, const CellsOptions& options, FoundExactly& found) {
  auto diagram = session.cells(found.set.sites, options);
  ASSERT_TRUE(diagram) << diagram.error().message;
  EXPECT_EQ(diagram->report.validation_messages, std::vector<std::string>{});
  if (haveSameBytes(*diagram, found.right)) return;
  expectExact(*diagram, found.set.sites, options.domain, found.exact);
  if (!testing::Test::HasFailure()) found.right = std::move(*diagram);
}

/// What a device is said to lack.
struct Masked {
  const char* name;
  Mask mask;
};

const std::vector<Masked>& masks() {
  static const std::vector<Masked> all{
      {"noGeometryShader", {{"geometryShader"}, {}}},
      {"rolledShaders", {{"shaderFloat64", "unrolledShaders"}, {}}},
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

class AgainstExactCells : public testing::TestWithParam<std::tuple<const char*, std::string>>,
                          protected OnBackend {
 protected:
  void SetUp() override { SKIP_UNUSABLE(backend()); }
  static const char* backend() { return std::get<0>(GetParam()); }
  static const std::string& set() { return std::get<1>(GetParam()); }
};

TEST_P(AgainstExactCells, agreeOn) {
  for (const std::uint64_t n : {60u, 800u}) {
    auto& found = judged(AgainstExactCells::set(), n);
    SCOPED_TRACE(testing::Message() << found.set.sites.size() << " sites, seed " << seed);
    expectExact(session(backend()), cellsOptions(found.set.domain), found);
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
    auto& found = judged(name, 800);
    for (const int neighbors : {5, 30}) {
      SCOPED_TRACE(testing::Message() << name << ", flann:" << neighbors << ", seed " << seed);
      expectExact(session(GetParam()), cellsOptions(found.set.domain, Search::flann, neighbors), found);
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
      auto& found = judged(kind, 3000);
      SCOPED_TRACE(testing::Message() << kind << " on " << name << ", seed " << seed);
      expectExact(*masked, cellsOptions(found.set.domain), found);
    }
  }
}

TEST_P(ExactOnBackend, ofWeightedSitesInTiles) {
  auto options = backendOptions(GetParam());
  options.mask.limits = {{"maxTexelBufferElements", 2048}, {"maxStorageBufferRange", 1 << 17}};
  auto masked = Session::open(options);
  ASSERT_TRUE(masked) << masked.error().message;
  for (const char* kind : {"weights-1", "weights-100", "towns", "ten-heavy", "verge"}) {
    auto& found = judged(kind, 3000);
    SCOPED_TRACE(testing::Message() << kind << ", seed " << seed);
    expectExact(*masked, cellsOptions(found.set.domain), found);
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
  auto& found = judged("random", 70000);
  auto options = backendOptions(GetParam());
  options.mask.limits = {{"maxTexelBufferElements", 65536}, {"maxStorageBufferRange", 134217728}};
  auto masked = Session::open(options);
  ASSERT_TRUE(masked) << masked.error().message;
  expectExact(*masked, cellsOptions(found.set.domain), found);
}

INSTANTIATE_TEST_SUITE_P(Backends, ExactOnBackend, testing::ValuesIn(backend_names),
                         [](const auto& instance) { return testName(instance.param); });

}  // namespace
}  // namespace vorpipe::test

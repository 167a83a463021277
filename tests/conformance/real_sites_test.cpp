/// Real sites, and sites that were hard, on every backend: all .csv files of tests/data and of the folder
/// that VORPIPE_TEST_DATA names. Cells are compared with exact arithmetic; cells and pictures have to pass
/// check().
#include <gtest/gtest.h>

#include <cstddef>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "exact_fixture.h"
#include "io/sites/sites_file.h"
#include "support/devices/backends.h"
#include "support/oracles/oracle.h"
#include "support/sites/real_sets.h"

namespace vorpipe::test {
namespace {

/// The most sites whose cells are compared with CGAL's, which needs about 30 us for each.
constexpr std::size_t most_exact = 200'000;
/// The most distances, sites times pixels, that pictures are compared with by brute force.
constexpr std::size_t most_distances = 50'000'000;
constexpr std::size_t width = 300, height = 200;

struct JudgedCase {
  RealCase given;
  std::optional<ExactCells> exact;  ///< once a backend is compared with them
};

class RealSites : public testing::TestWithParam<std::tuple<RealSet, const char*>>, protected OnBackend {
 protected:
  void SetUp() override {
    SKIP_UNUSABLE(backend());
    const std::string& path = std::get<0>(GetParam()).path;
    if (path == path_) return;
    const auto table = readSites(path);
    ASSERT_TRUE(table) << table.error().message;
    cases_.clear();
    for (RealCase& given : casesOf(table->sites)) cases_.push_back({std::move(given), {}});
    path_ = path;
  }
  static const char* backend() { return std::get<1>(GetParam()); }
  static Session& session() { return OnBackend::session(backend()); }
  static std::vector<JudgedCase>& cases() { return cases_; }

 private:
  /// Of the file at `path_`, which all backends have before the next one is read.
  static inline std::vector<JudgedCase> cases_;
  static inline std::string path_;
};

void expectNothingBroken(const Result<std::vector<std::string>>& broken) {
  ASSERT_TRUE(broken) << broken.error().message;
  EXPECT_EQ(*broken, std::vector<std::string>{});
}

void expectCells(Session& session, JudgedCase& judged) {
  const auto& [what, sites, domain] = judged.given;
  const auto options = cellsOptions(domain);
  const auto diagram = session.cells(sites, options);
  ASSERT_TRUE(diagram) << diagram.error().message;
  EXPECT_EQ(diagram->report.validation_messages, std::vector<std::string>{});
  if (sites.size() <= most_exact) {
    if (!judged.exact) judged.exact = exactCells(sites, domain);
    expectExact(*diagram, sites, domain, *judged.exact);
  }
  expectNothingBroken(check(sites, options, *diagram));
}

void expectPicture(Session& session, const Sites& sites, const Box& domain) {
  RenderOptions options{};
  options.domain = domain;
  options.width = int{width};
  options.height = int{height};
  const auto rendering = session.render(sites, options);
  ASSERT_TRUE(rendering) << rendering.error().message;
  EXPECT_EQ(rendering->report.validation_messages, std::vector<std::string>{});
  expectNothingBroken(check(sites, options, *rendering));
  if (sites.weight.empty() && sites.size() * width * height <= most_distances)
    expectNearestEverywhere(rendering->image, sites, domain);
}

TEST_P(RealSites, haveTheirCells) {
  for (JudgedCase& judged : cases()) {
    SCOPED_TRACE(judged.given.what);
    expectCells(session(), judged);
  }
}

TEST_P(RealSites, areDrawn) {
  for (const JudgedCase& judged : cases()) {
    SCOPED_TRACE(judged.given.what);
    expectPicture(session(), judged.given.sites, judged.given.domain);
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, RealSites,
                         testing::Combine(testing::ValuesIn(realSets()), testing::ValuesIn(backend_names)),
                         [](const auto& instance) {
                           return testName(std::get<1>(instance.param)) + "_" +
                                  std::get<0>(instance.param).name;
                         });

}  // namespace
}  // namespace vorpipe::test

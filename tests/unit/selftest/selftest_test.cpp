/// That `vorpipe selftest` fails where a device does, and says how; and that right answers pass.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "backend/registry/registry.h"
#include "domain/cells_run.h"
#include "picture/picture.h"
#include "selftest/run_scenes.h"
#include "unit/fixtures/changed_cpu.h"

namespace vorpipe::test {

using namespace core;

namespace {

using selftests::Runs;

Result<Session> openCpu() {
  BackendOptions options;
  options.name = "cpu";
  options.threads = 2;
  return Session::open(options);
}

/// The right answers, but for what is changed in them.
struct Changes {
  std::function<void(Result<Rendering>&)> picture = [](auto&) {};
  std::function<void(Result<Diagram>&)> cells = [](auto&) {};
  std::function<void(Result<Arithmetic>&)> arithmetic = [](auto&) {};
};

class ChangedRuns final : public Runs {
 public:
  ChangedRuns(Session session, const Changes& changes) : session_(std::move(session)), changes_(changes) {}

  Result<Rendering> render(const Sites& sites, const RenderOptions& options) override {
    auto result = session_.render(sites, options);
    changes_.picture(result);
    return result;
  }
  Result<Diagram> cells(const Sites& sites, const CellsOptions& options) override {
    auto result = session_.cells(sites, options);
    changes_.cells(result);
    return result;
  }
  Result<Arithmetic> arithmetic() override {
    auto result = session_.arithmetic();
    changes_.arithmetic(result);
    return result;
  }

 private:
  Session session_;
  Changes changes_;
};

selftests::OpenRuns opening(const Changes& changes) {
  return [changes](const Mask&) -> Result<std::unique_ptr<Runs>> {
    auto session = openCpu();
    if (!session) return tl::unexpected(session.error());
    return std::make_unique<ChangedRuns>(std::move(*session), changes);
  };
}

selftests::Scene randomScene(const selftests::Scale& scale) {
  selftests::Scene scene;
  scene.sites = generate(Pattern::random, 50, scale.seed);
  scene.width = scene.height = 64;
  return scene;
}

/// Beyond what squares of doubles hold: refused as input.
selftests::Scene hugeScene(const selftests::Scale&) {
  selftests::Scene scene;
  scene.sites = {{0, 1e300}, {0, 1e308}, {}};
  scene.domain = {-1e308, -1e308, 1e308, 1e308};
  return scene;
}

constexpr selftests::SceneKind random_kind{"even", "random", selftests::Traits::random,
                                           selftests::Masked::nothing, randomScene};

SelftestReport reportOf(const selftests::OpenRuns& device, const selftests::OpenRuns& judge,
                        const selftests::SceneKind& kind = random_kind) {
  SelftestReport report;
  report.devices.resize(1);
  report.devices[0].info.backend = "the device";
  report.devices[0].info.limits = {{"subPixelPrecisionBits", 8}};
  SelftestOptions options;
  options.quick = true;
  options.seed = 7;
  options.threads = 2;
  const auto done = runScenes({&kind, 1}, {{0, device, false, true}}, judge, options, report);
  EXPECT_TRUE(done) << done.error().message;
  return report;
}

std::string faultOf(const Changes& changes) {
  const auto report = reportOf(opening(changes), opening({}));
  EXPECT_EQ(report.passed(), report.devices[0].runs.at(0).passed());
  return report.devices[0].runs.at(0).fault;
}

void expectFault(const std::string& words, const Changes& changes) {
  const auto fault = faultOf(changes);
  EXPECT_NE(fault.find(words), std::string::npos) << "'" << fault << "' does not say '" << words << "'";
}

TEST(Selftest, PassesWhatIsRight) {
  const auto report = reportOf(opening({}), opening({}));
  const auto& device = report.devices[0];
  ASSERT_EQ(device.runs.size(), 1u);
  EXPECT_EQ(device.runs[0].fault, "");
  EXPECT_EQ(device.runs[0].seed, 7u);
  EXPECT_EQ(device.runs[0].sites, 50u);
  EXPECT_GT(device.runs[0].milliseconds, 0);
  EXPECT_EQ(device.arithmetic_fault, "");
  EXPECT_TRUE(report.passed());
}

TEST(Selftest, FindsAWrongPixel) {
  expectFault("picture: pixels: row 10, column 20", {.picture = [](auto& result) {
                auto& id = result->image.ids[10 * 64 + 20];
                id = (id + 1) % 50;
              }});
  expectFault("picture: ", {.picture = [](auto& result) { result->image.ids[5] = no_site; }});
}

TEST(Selftest, FindsWrongCells) {
  expectFault("cells: ", {.cells = [](auto& result) { result->area[3] *= 1.1; }});
  expectFault("cells: ", {.cells = [](auto& result) { result->status[3] = Status::empty; }});
  expectFault("cells: ", {.cells = [](auto& result) { result->neighbors[9] = result->neighbors[10]; }});
}

TEST(Selftest, SaysWhatFailedAndWhatValidationSaid) {
  expectFault("picture: it is lost", {.picture = [](auto& result) {
                result = tl::unexpected(Error{ErrorCode::device, "it is lost"});
              }});
  expectFault("cells: no such thing", {.cells = [](auto& result) {
                result = tl::unexpected(Error{ErrorCode::input, "no such thing"});
              }});
  expectFault("cells: validation: a hazard",
              {.cells = [](auto& result) { result->report.validation_messages = {"a hazard"}; }});
}

// What check() does not know of: the other site of a tie is as near, and the judge has all the same another.
TEST(Selftest, ComparesWithTheJudge) {
  const auto moved = [](const Mask& mask) {
    return opening({.cells = [](auto& result) {
      if (result) result->area[3] *= 1.001;
    }})(mask);
  };
  const auto report = reportOf(opening({}), moved);
  const auto& fault = report.devices[0].runs.at(0).fault;
  EXPECT_NE(fault.find("cells: 1 of 50 differ from cpu's, first that of site 3: the area"), std::string::npos)
      << fault;
}

TEST(Selftest, GoesOnAfterADeviceThatCannotBeOpened) {
  const auto report = reportOf(
      [](const Mask&) -> Result<std::unique_ptr<Runs>> {
        return tl::unexpected(Error{ErrorCode::device, "it is busy"});
      },
      opening({}));
  EXPECT_EQ(report.devices[0].runs.at(0).fault, "it is busy");
  EXPECT_EQ(report.devices[0].arithmetic_fault, "it is busy");
}

TEST(Selftest, LetsBeRefusedWhatIsExtremeAlone) {
  selftests::SceneKind kind{"scales", "huge", selftests::Traits::extreme, selftests::Masked::nothing,
                            hugeScene};
  EXPECT_TRUE(reportOf(opening({}), opening({}), kind).passed());
  kind.traits = selftests::Traits::once;
  EXPECT_FALSE(reportOf(opening({}), opening({}), kind).passed());
}

TEST(Selftest, FindsArithmeticThatIsWorseThanAllowed) {
  const auto fault = [](const std::function<void(Arithmetic&)>& change) {
    Arithmetic numbers;
    numbers.subpixel_bits = 8;
    change(numbers);
    return selftests::arithmeticFault(numbers, 8);
  };
  EXPECT_EQ(fault([](auto&) {}), "");
  EXPECT_EQ(fault([](auto& n) { n.quotient = 2.5; }), "");
  EXPECT_EQ(fault([](auto& n) { n.quotient = 3; }), "a quotient is off by 3.00 ULP, where 2.5 are allowed");
  EXPECT_NE(fault([](auto& n) { n.root = 7; }), "");
  EXPECT_NE(fault([](auto& n) { n.inverse_root = 2.1; }), "");
  EXPECT_NE(fault([](auto& n) { n.product = 1.5; }), "");
  EXPECT_NE(fault([](auto& n) { n.sum = HUGE_VAL; }), "");
  EXPECT_NE(fault([](auto& n) { n.offset = 1.5; }), "");
  EXPECT_NE(fault([](auto& n) { n.subpixel_bits = 7; }), "");
  EXPECT_EQ(fault([](auto& n) { n.subpixel_bits = 9; }), "");
  EXPECT_EQ(fault([](auto& n) { n.subpixel_bits.reset(); }), "");
  Arithmetic finest;
  finest.subpixel_bits = most_subpixel_bits;
  EXPECT_EQ(selftests::arithmeticFault(finest, 16), "");
  EXPECT_NE(fault([](auto& n) { n.report.validation_messages = {"a hazard"}; }), "");
}

/// Exchanges two sites in every picture.
class SiteExchanger final : public ChangedCpu {
 public:
  SiteExchanger() : ChangedCpu(2) {}
  Result<void> read(std::span<std::uint32_t> rgba, std::span<std::uint32_t> ids) override {
    auto done = ChangedCpu::read(rgba, ids);
    for (auto& id : ids) id = id == 4 ? 5 : id == 5 ? 4 : id;
    return done;
  }
};

/// What a session does, with a backend of the test's own.
class RunsOnBackend final : public Runs {
 public:
  explicit RunsOnBackend(std::unique_ptr<Backend> backend)
      : backend_(std::move(backend)), exact_(openExactTier(2)) {}
  Result<Rendering> render(const Sites& sites, const RenderOptions& options) override {
    return renderOn({*backend_, *exact_, 2}, sites, options);
  }
  Result<Diagram> cells(const Sites& sites, const CellsOptions& options) override {
    return cellsOn({*backend_, *exact_, 2}, sites, options);
  }
  Result<Arithmetic> arithmetic() override { return Arithmetic{}; }

 private:
  std::unique_ptr<Backend> backend_;
  std::unique_ptr<ExactTier> exact_;
};

TEST(Selftest, FindsABackendThatDrawsOtherSites) {
  const auto report = reportOf(
      [](const Mask&) -> Result<std::unique_ptr<Runs>> {
        return std::make_unique<RunsOnBackend>(std::make_unique<SiteExchanger>());
      },
      opening({}));
  const auto& fault = report.devices[0].runs.at(0).fault;
  EXPECT_EQ(fault.substr(0, 16), "picture: pixels:") << fault;
}

TEST(Selftest, NamesWhatIsNotThere) {
  SelftestOptions options;
  options.backend = "nope";
  EXPECT_EQ(selftest(options).error().code, ErrorCode::input);
  options.backend = "cpu";
  options.device = "77";
  EXPECT_EQ(selftest(options).error().code, ErrorCode::device);
  options.device = "0";
  options.quick = true;
  options.progress = [](std::string_view, double) { return false; };
  EXPECT_EQ(selftest(options).error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace vorpipe::test

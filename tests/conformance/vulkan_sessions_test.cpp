// Whole runs on a device that is lost at any submission, that refuses memory, or that writes nonsense for the
// host. vulkan_test and compute_test are compiled with it.
#include <gtest/gtest.h>

#include <cstring>

#include "backend_scene.h"
#include "faulty_device.h"
#include "support/devices/backends.h"

namespace vorpipe::test {
namespace {

constexpr int side = 200;

CellsOptions wantedCells(SearchOptions search = {}) {
  CellsOptions wanted{};
  wanted.domain = unit_square;
  wanted.search = search;
  wanted.detail = Detail::everything;
  return wanted;
}

RenderOptions wantedPicture() {
  RenderOptions wanted{};
  wanted.domain = unit_square;
  wanted.width = wanted.height = side;
  return wanted;
}

Result<Session> open(std::string_view name, const Mask& mask = {}) {
  BackendOptions options;
  options.name = name;
  options.mask = mask;
  options.validation = true;
  return Session::open(options);
}

template <class T>
void expectSame(const std::vector<T>& a, const std::vector<T>& b, std::string_view what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  EXPECT_TRUE(a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0) << what;
}

void expectSameCells(const Diagram& a, const Diagram& b) {
  expectSame(a.status, b.status, "status");
  expectSame(a.area, b.area, "area");
  expectSame(a.cell_offsets, b.cell_offsets, "offsets");
  expectSame(a.neighbors, b.neighbors, "neighbors");
  expectSame(a.vertices, b.vertices, "vertices");
  expectSame(a.triangles, b.triangles, "triangles");
}

void expectRight(const Result<Diagram>& cells, const Diagram& reference) {
  ASSERT_TRUE(cells.has_value()) << cells.error().message;
  EXPECT_EQ(cells->report.validation_messages, std::vector<std::string>());
  expectSameCells(*cells, reference);
}

void expectRight(const Result<Rendering>& rendering, const Sites& sites) {
  ASSERT_TRUE(rendering.has_value()) << rendering.error().message;
  EXPECT_EQ(rendering->report.validation_messages, std::vector<std::string>());
  expectNearestEverywhere(rendering->image, sites, unit_square);
}

// What takes over where no Vulkan device is left.
std::string_view afterVulkan() { return whyUnusable("opengl").empty() ? "opengl" : "cpu"; }

class VulkanSessions : public testing::Test {
 protected:
  // Enough for two devices.
  const Sites sites_ = generate(Pattern::random, 300, 5);
  const Diagram reference_ = *open("cpu")->cells(sites_, wantedCells());
};

// Has every submission of a run, and every wait for one, lose its device; the run is `work` in a session of
// the backend `name`. Returns how many there are.
template <class Work>
int loseEverySubmission(std::string_view name, bool all_devices, const Work& work) {
  constexpr int most = 500;
  for (int nth = 1; nth < most; nth++) {
    SCOPED_TRACE(testing::Message() << name << ", lost at submission or wait " << nth);
    FaultyDriver driver;
    driver.losing_call = nth;
    driver.loses_all = all_devices;
    {
      auto session = open(name);
      if (!session) {
        ADD_FAILURE() << session.error().message;
        return 0;
      }
      work(*session, [&] { return driver.submissions >= nth; });
    }
    EXPECT_EQ(driver.alive, 0);
    if (driver.submissions < nth || testing::Test::HasFailure()) return nth - 1;
  }
  ADD_FAILURE() << "no end of submissions";
  return 0;
}

void expectLost(const Error& error) {
  EXPECT_EQ(error.code, ErrorCode::device);
  EXPECT_NE(error.message.find("VK_ERROR_DEVICE_LOST"), std::string::npos) << error.message;
  EXPECT_EQ(error.message.find('\n'), std::string::npos);
}

TEST_F(VulkanSessions, ThatLoseTheirDeviceEndWithAnErrorWhereItWasNamed) {
  const auto cells = [&](Session& session, const auto& is_lost) {
    const auto found = session.cells(sites_, wantedCells());
    is_lost() ? expectLost(found ? Error{} : found.error()) : expectRight(found, reference_);
    // It may be there again.
    if (is_lost()) expectRight(session.cells(sites_, wantedCells()), reference_);
  };
  const auto picture = [&](Session& session, const auto& is_lost) {
    const auto drawn = session.render(sites_, wantedPicture());
    is_lost() ? expectLost(drawn ? Error{} : drawn.error()) : expectRight(drawn, sites_);
  };
  EXPECT_GE(loseEverySubmission(backendName(), false, cells), 2);
  EXPECT_GE(loseEverySubmission(backendName(), false, picture), 6);
}

TEST_F(VulkanSessions, ThatLoseTheirDeviceGoOnWithTheNextWhereTheChoiceWasLeft) {
  for (const bool all_devices : {false, true}) {
    const auto next = [&](const Report& report, const Session& session, bool is_lost) {
      ASSERT_EQ(report.notes.size(), is_lost ? (all_devices ? 2U : 1U) : 0U);
      EXPECT_EQ(report.backend, session.device().backend);
      EXPECT_EQ(report.backend, !is_lost      ? "vulkan-compute"
                                : all_devices ? afterVulkan()
                                              : "vulkan-geometry");
      if (!is_lost) return;
      EXPECT_NE(report.notes[0].find("VK_ERROR_DEVICE_LOST"), std::string::npos) << report.notes[0];
      EXPECT_EQ(session.choice(), report.notes.back());
    };
    const auto cells = [&](Session& session, const auto& is_lost) {
      const auto found = session.cells(sites_, wantedCells());
      expectRight(found, reference_);
      if (found) next(found->report, session, is_lost());
    };
    const auto picture = [&](Session& session, const auto& is_lost) {
      const auto drawn = session.render(sites_, wantedPicture());
      expectRight(drawn, sites_);
      if (drawn) next(drawn->report, session, is_lost());
    };
    EXPECT_GE(loseEverySubmission("auto", all_devices, cells), 2);
    EXPECT_GE(loseEverySubmission("auto", all_devices, picture), 6);
  }
}

// In the first picture, in another view, or while other sites take the device.
TEST_F(VulkanSessions, ThatLoseTheirDeviceKeepTheSitesOfPictures) {
  const auto views = [&](Session& session, const auto& is_lost) {
    KeptSites kept(session, sites_);
    RenderOptions wanted = wantedPicture();
    const auto first = kept.render(wanted);
    expectRight(first, sites_);
    expectRight(session.cells(sites_, wantedCells()), reference_);
    wanted.view = Box{0.25, 0.25, 0.75, 0.5};
    const auto part = kept.render(wanted);
    ASSERT_TRUE(part) << part.error().message;
    expectNearestEverywhere(part->image, sites_, *wanted.view);
    EXPECT_EQ(session.device().backend == "vulkan-compute", !is_lost());
  };
  EXPECT_GE(loseEverySubmission("auto", false, views), 12);
}

// `vulkan` is its two backends and no other.
TEST_F(VulkanSessions, OfVulkanTryBothPipelines) {
  FaultyDriver driver;
  driver.losing_call = 1;
  {
    auto session = open("vulkan");
    ASSERT_TRUE(session.has_value());
    const auto found = session->cells(sites_, wantedCells());
    expectRight(found, reference_);
    EXPECT_EQ(session->device().backend, "vulkan-geometry");
  }
  driver.losing_call = 1;
  driver.submissions = 0;
  driver.loses_all = true;
  auto session = open("vulkan");
  ASSERT_TRUE(session.has_value());
  const auto found = session->cells(sites_, wantedCells());
  ASSERT_FALSE(found.has_value());
  expectLost(found.error());
}

TEST_F(VulkanSessions, GetLessAtATimeFromADeviceThatRefusesMemory) {
  const Sites many = generate(Pattern::clusters, 40000, 3);
  const auto reference = open("cpu")->cells(many, wantedCells());
  ASSERT_TRUE(reference.has_value());
  FaultyDriver driver;
  driver.largest_allocation = VkDeviceSize{1} << 18;
  {
    auto session = open(backendName());
    ASSERT_TRUE(session.has_value()) << session.error().message;
    const auto found = session->cells(many, wantedCells());
    EXPECT_GT(driver.refused, 0);
    expectRight(found, *reference);
    EXPECT_EQ(found->report.backend, backendName());
    EXPECT_FALSE(found->report.notes.empty());
    RenderOptions wanted = wantedPicture();
    wanted.width = wanted.height = 700;
    const auto drawn = session->render(many, wanted);
    ASSERT_TRUE(drawn.has_value()) << drawn.error().message;
    const auto broken = check(many, wanted, *drawn, 0);
    ASSERT_TRUE(broken.has_value());
    EXPECT_EQ(*broken, std::vector<std::string>());
    const auto by_lists = session->cells(sites_, wantedCells({Search::flann, 30}));
    expectRight(by_lists, reference_);
  }
  EXPECT_EQ(driver.alive, 0);
}

TEST_F(VulkanSessions, EndWithAnErrorWhereNoMemoryIsLeft) {
  FaultyDriver driver;
  driver.largest_allocation = VkDeviceSize{1} << 12;
  const Sites many = generate(Pattern::random, 20000, 3);
  auto session = open(backendName());
  ASSERT_TRUE(session.has_value()) << session.error().message;
  const auto found = session->cells(many, wantedCells());
  ASSERT_FALSE(found.has_value());
  EXPECT_EQ(found.error().code, ErrorCode::device);
  EXPECT_TRUE(found.error().out_of_memory);
  EXPECT_NE(found.error().message.find("VK_ERROR_OUT_OF_DEVICE_MEMORY"), std::string::npos)
      << found.error().message;
}

// What a device without memory for more says of itself is believed: nothing is refused then.
TEST_F(VulkanSessions, KeepToTheLargestAllocation) {
  const Sites many = generate(Pattern::random, 40000, 3);
  const auto reference = open("cpu")->cells(many, wantedCells());
  ASSERT_TRUE(reference.has_value());
  FaultyDriver driver;
  driver.largest_allocation = VkDeviceSize{1} << 18;
  auto session = open(backendName(), {{}, {{"maxMemoryAllocationSize", driver.largest_allocation}}});
  ASSERT_TRUE(session.has_value()) << session.error().message;
  const auto found = session->cells(many, wantedCells());
  expectRight(found, *reference);
  EXPECT_EQ(found->report.notes, std::vector<std::string>());
  EXPECT_EQ(driver.refused, 0);
}

// What is found in another way is measured in another order.
void expectEqualCells(const Result<Diagram>& cells, const Diagram& reference) {
  ASSERT_TRUE(cells.has_value()) << cells.error().message;
  expectSame(cells->status, reference.status, "status");
  expectSame(cells->cell_offsets, reference.cell_offsets, "offsets");
  expectSame(cells->neighbors, reference.neighbors, "neighbors");
  for (std::size_t i = 0; i < reference.area.size(); i++) {
    ASSERT_NEAR(cells->area[i], reference.area[i], 1e-12 * reference.area[i]) << "site " << i;
  }
}

// Numbers for the host become nonsense when they have been written: cells come out right, or the run ends
// with an error of the device.
TEST_F(VulkanSessions, AreNotMisledByNonsense) {
  const auto seed = testing::UnitTest::GetInstance()->random_seed();
  FaultyDriver driver;
  driver.lies_to_host = true;
  driver.storage_is_for_host = backendName() == "vulkan-geometry";
  driver.lies.seed(static_cast<std::uint64_t>(seed));
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  const Sites many = generate(Pattern::random, 12000, 3);
  const auto reference = open("cpu")->cells(many, wantedCells());
  ASSERT_TRUE(reference.has_value());
  for (const bool tiled : {false, true}) {
    const Mask mask = tiled ? Mask{{}, {{"maxTexelBufferElements", 3000}}} : Mask{};
    auto session = open(backendName(), mask);
    ASSERT_TRUE(session.has_value()) << session.error().message;
    for (const auto& search : {SearchOptions{}, SearchOptions{Search::flann, 20}}) {
      expectEqualCells(session->cells(many, wantedCells(search)), *reference);
      RenderOptions picture = wantedPicture();
      picture.search = search;
      const auto drawn = session->render(many, picture);
      if (!drawn) {
        EXPECT_EQ(drawn.error().code, ErrorCode::device) << drawn.error().message;
        continue;
      }
      for (const auto id : drawn->image.ids) EXPECT_TRUE(id < many.size() || id == no_site);
    }
  }
  EXPECT_GT(driver.lied, 0);
}

}  // namespace
}  // namespace vorpipe::test

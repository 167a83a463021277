// Whole runs on a device that is lost at any submission, that refuses memory, or that writes nonsense for the
// host. vulkan_test and compute_test are compiled with it.
#include "vulkan_sessions.h"

#include <gtest/gtest.h>

namespace vorpipe::test {
namespace {

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

TEST_F(VulkanSessions, GetLessAtATimeFromADeviceThatRefusesMemory) {
  const Sites many = generate(Pattern::random, 40000, 3);
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
  expectSameBytes(cells->status, reference.status, "status");
  expectSameBytes(cells->cell_offsets, reference.cell_offsets, "offsets");
  expectSameBytes(cells->neighbors, reference.neighbors, "neighbors");
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

// Whole runs on a device that is lost, where the choice of a backend was left to the session.
#include <gtest/gtest.h>

#include "support/devices/backends.h"
#include "vulkan_sessions.h"

namespace vorpipe::test {
namespace {

using LeftChoice = VulkanSessions;

// What takes over where no Vulkan device is left.
std::string_view afterVulkan() { return whyUnusable("opengl").empty() ? "opengl" : "cpu"; }

TEST_F(LeftChoice, ThatLosesItsDeviceGoesOnWithTheNext) {
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

// In another view, or while other sites take the device. In the first picture: see above.
TEST_F(LeftChoice, ThatLosesItsDeviceKeepsTheSitesOfPictures) {
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
  const int of_first = [&] {
    const FaultyDriver driver;
    auto session = openMeant("auto");
    EXPECT_TRUE(session && KeptSites(*session, sites_).render(wantedPicture()));
    return driver.submissions;
  }();
  EXPECT_GE(of_first, 6);
  EXPECT_GE(loseEverySubmission("auto", false, views, of_first), 6);
}

// `vulkan` is its two backends and no other.
TEST_F(LeftChoice, OfVulkanTriesBothPipelines) {
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

}  // namespace
}  // namespace vorpipe::test

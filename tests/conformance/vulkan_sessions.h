/// Sessions with Vulkan devices that fail, and what is expected of them.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "backend_scene.h"
#include "faulty_device.h"
#include "support/oracles/same_bytes.h"

namespace vorpipe::test {

inline constexpr int side = 200;

inline CellsOptions wantedCells(SearchOptions search = {}) {
  CellsOptions wanted{};
  wanted.domain = unit;
  wanted.search = search;
  wanted.detail = Detail::everything;
  return wanted;
}

inline RenderOptions wantedPicture() {
  RenderOptions wanted{};
  wanted.domain = unit;
  wanted.width = wanted.height = side;
  return wanted;
}

inline Result<Session> open(std::string_view name, const Mask& mask = {}) {
  BackendOptions options;
  options.name = name;
  options.mask = mask;
  options.validation = true;
  return Session::open(options);
}

inline void expectRight(const Result<Diagram>& cells, const Diagram& reference) {
  ASSERT_TRUE(cells.has_value()) << cells.error().message;
  EXPECT_EQ(cells->report.validation_messages, std::vector<std::string>());
  expectSameBytes(*cells, reference);
}

inline void expectRight(const Result<Rendering>& rendering, const Sites& sites) {
  ASSERT_TRUE(rendering.has_value()) << rendering.error().message;
  EXPECT_EQ(rendering->report.validation_messages, std::vector<std::string>());
  expectNearestEverywhere(rendering->image, sites, unit);
}

class VulkanSessions : public testing::Test {
 protected:
  const Sites sites_ = generate(Pattern::random, 300, 5);
  const Diagram reference_ = *open("cpu")->cells(sites_, wantedCells());
};

/// A session whose device is meant: else auto would take cpu where there is no GPU.
inline Result<Session> openMeant(std::string_view name) {
  Mask meant;
  meant.limits = {{"maxTexelBufferElements", 1U << 16}};
  return open(name, meant);
}

/// Has every submission of a run after the first `already`, and every wait for one, lose its device; the run
/// is `work` in a session of the backend `name`. Returns how many there are.
template <class Work>
int loseEverySubmission(std::string_view name, bool all_devices, const Work& work, int already = 0) {
  constexpr int most = 500;
  for (int nth = already + 1; nth < most; nth++) {
    SCOPED_TRACE(testing::Message() << name << ", lost at submission or wait " << nth);
    FaultyDriver driver;
    driver.losing_call = nth;
    driver.loses_all = all_devices;
    {
      auto session = openMeant(name);
      if (!session) {
        ADD_FAILURE() << session.error().message;
        return 0;
      }
      work(*session, [&] { return driver.submissions >= nth; });
    }
    EXPECT_EQ(driver.alive, 0);
    if (driver.submissions < nth || testing::Test::HasFailure()) return nth - 1 - already;
  }
  ADD_FAILURE() << "no end of submissions";
  return 0;
}

inline void expectLost(const Error& error) {
  EXPECT_EQ(error.code, ErrorCode::device);
  EXPECT_NE(error.message.find("VK_ERROR_DEVICE_LOST"), std::string::npos) << error.message;
  EXPECT_EQ(error.message.find('\n'), std::string::npos);
}

}  // namespace vorpipe::test

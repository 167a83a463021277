/// Arrays that come and go, and what stays of them.
#include <gmock/gmock.h>

#include <numeric>

#include "vorpipe.h"

namespace vorpipe::test {
namespace {

std::uint64_t bytesOf(const MemoryPlan& plan, const std::string& what) {
  for (const MemoryPart& part : plan.parts()) {
    if (part.what == what) return part.bytes;
  }
  return 0;
}

TEST(MemoryPlan, AddsUpWhatIsThereAtATime) {
  MemoryPlan plan;
  plan.take("a", 100);
  const auto b = plan.take("b", 50);
  plan.take("a", 10);
  EXPECT_EQ(plan.peak(), 160u);
  EXPECT_EQ(bytesOf(plan, "a"), 110u);
  EXPECT_EQ(bytesOf(plan, "b"), 50u);
  EXPECT_EQ(plan.parts().front().what, "a");
  plan.drop(b);
  EXPECT_EQ(plan.peak(), 160u);
}

TEST(MemoryPlan, DropsWhatWasTakenSinceButForSome) {
  MemoryPlan plan;
  plan.take("before", 10);
  const auto since = plan.next();
  plan.take("gone", 20);
  const auto kept = plan.take("kept", 20);
  plan.dropSince(since, {kept});
  plan.take("in the place of what is gone", 20);
  EXPECT_EQ(plan.peak(), 50u);
}

TEST(MemoryPlan, PartsAddUpToThePeak) {
  Workload work;
  work.sites = 3'000'000;
  work.weighted = true;
  work.outlined = true;
  work.backend = "vulkan-geometry";
  MemoryPlan plan;
  planSession(plan, work);
  planCells(plan, work, Detail::everything);
  RenderOptions picture{};
  picture.width = 5000;
  picture.height = 300;
  picture.color = ColorBy::area;
  planPicture(plan, work, picture);
  const auto& parts = plan.parts();
  const auto sum =
      std::accumulate(parts.begin(), parts.end(), std::uint64_t{0},
                      [](std::uint64_t all, const MemoryPart& part) { return all + part.bytes; });
  EXPECT_EQ(sum, plan.peak());
}

/// Bytes at the peak of cells.
std::uint64_t cellsPeak(const Workload& work, Detail detail) {
  MemoryPlan plan;
  planSession(plan, work);
  planCells(plan, work, detail);
  return plan.peak();
}

TEST(MemoryPlan, MoreOfAnythingNeedsNoLess) {
  Workload work;
  work.sites = 1'000'000;
  const auto plain = cellsPeak(work, Detail::everything);
  EXPECT_LT(cellsPeak(work, Detail::measures), cellsPeak(work, Detail::polygons));
  EXPECT_LE(cellsPeak(work, Detail::polygons), plain);
  const auto with = [&](const auto& change) {
    Workload more = work;
    change(more);
    return cellsPeak(more, Detail::everything);
  };
  EXPECT_GT(with([](Workload& w) { w.sites *= 2; }), plain + plain / 2);
  EXPECT_GT(with([](Workload& w) { w.outlined = true; }), plain);
  EXPECT_GT(with([](Workload& w) { w.backend = "vulkan-compute"; }), plain);
  Workload device = work;
  device.backend = "vulkan-compute";
  const auto software = cellsPeak(device, Detail::everything);
  device.device_on_host = false;
  EXPECT_LT(cellsPeak(device, Detail::everything), software);
}

}  // namespace
}  // namespace vorpipe::test

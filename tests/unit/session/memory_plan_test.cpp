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

TEST(MemoryPlan, FreedMemoryServesWhatFitsAndStaysWhereItIs) {
  MemoryPlan plan;
  const auto hole = plan.take("hole", 100);
  plan.take("wall", 1);
  plan.drop(hole);
  plan.take("fits", 60);
  plan.take("fits too", 40);
  EXPECT_EQ(plan.peak(), 101u);
  const auto small = plan.take("small", 30);
  plan.take("wall", 1);
  plan.drop(small);
  plan.take("large", 31);
  EXPECT_EQ(plan.peak(), 101u + 30 + 1 + 31);
  EXPECT_EQ(bytesOf(plan, "kept of what was freed"), 30u);
}

TEST(MemoryPlan, TheSmallestPieceThatFitsIsTaken) {
  MemoryPlan plan;
  const auto large = plan.take("large", 100);
  plan.take("wall", 1);
  const auto small = plan.take("small", 10);
  plan.take("wall", 1);
  plan.drop({large, small});
  plan.take("x", 10);
  plan.take("y", 100);
  EXPECT_EQ(plan.peak(), 112u);
}

TEST(MemoryPlan, PiecesSideBySideBecomeOne) {
  MemoryPlan plan;
  std::vector<MemoryPlan::Array> pieces;
  for (int k = 0; k < 4; ++k) pieces.push_back(plan.take("pieces", 25));
  plan.take("wall", 1);
  for (const auto k : {2u, 0u, 3u, 1u}) plan.drop(pieces[k]);
  plan.take("whole", 100);
  EXPECT_EQ(plan.peak(), 101u);
  // At the end, what is free grows.
  MemoryPlan at_end;
  at_end.drop(at_end.take("a", 10));
  at_end.take("b", 30);
  EXPECT_EQ(at_end.peak(), 30u);
}

TEST(MemoryPlan, OnlyWhatIsWrittenCounts) {
  MemoryPlan plan;
  const auto reserved = plan.take("reserved", 100, 10);
  EXPECT_EQ(plan.peak(), 10u);
  plan.take("next", 5);
  EXPECT_EQ(plan.peak(), 15u);
  plan.drop(reserved);
  plan.take("in its place", 60);
  EXPECT_EQ(plan.peak(), 65u);
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
  planPicture(plan, work, 5000, 300, ColorBy::area);
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
  // Triangles fit where records of cells were.
  EXPECT_LE(cellsPeak(work, Detail::polygons), plain);
  const auto with = [&](const auto& change) {
    Workload more = work;
    change(more);
    return cellsPeak(more, Detail::everything);
  };
  EXPECT_GT(with([](Workload& w) { w.sites *= 2; }), plain + plain / 2);
  EXPECT_GT(with([](Workload& w) { w.outlined = true; }), plain);
  EXPECT_GT(with([](Workload& w) { w.on_lattice = true; }), plain);
  EXPECT_GT(with([](Workload& w) { w.backend = "vulkan-compute"; }), plain);
  Workload device = work;
  device.backend = "vulkan-compute";
  const auto software = cellsPeak(device, Detail::everything);
  device.device_on_host = false;
  EXPECT_LT(cellsPeak(device, Detail::everything), software);
}

TEST(MemoryPlan, IsQuickForAnyNumberOfSites) {
  Workload work;
  work.sites = std::uint64_t{1} << 31;
  work.backend = "opengl";
  EXPECT_GT(cellsPeak(work, Detail::everything), std::uint64_t{350} << 31);
}

}  // namespace
}  // namespace vorpipe::test

#include "bench/measured.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "bench/tables.h"

namespace vorpipe::bench {
namespace {

TEST(Measured, MedianAndSpreadIgnoreOneOutlier) {
  const Samples samples = {5, 1, 2, 3, 1000};
  EXPECT_EQ(median(samples), 3);
  EXPECT_EQ(least(samples), 1);
  EXPECT_EQ(spread(samples), 2);
  EXPECT_EQ(median({4, 1, 3, 2}), 2.5);
  EXPECT_EQ(spread({7}), 0);
}

TEST(Measured, NumbersHaveThreeDigits) {
  EXPECT_EQ(numberText(0), "0");
  EXPECT_EQ(numberText(0.0012345), "0.00123");
  EXPECT_EQ(numberText(1), "1.00");
  EXPECT_EQ(numberText(99.96), "100");
  EXPECT_EQ(numberText(999.7), "1,000");
  EXPECT_EQ(numberText(1234567), "1,234,567");
  EXPECT_EQ(numberText(-0.5), "-0.500");
  EXPECT_EQ(numberText(8.14e-5), "8.14e-05");
}

Table smallTable() {
  return {"small",
          "A small table",
          {{"name", "name"}, {"count", "count"}, {"seconds", "s"}},
          {{std::string("a|b"), std::uint64_t{12345}, Samples{1, 2, 3}},
           {std::string("c"), std::uint64_t{7}, Missing{"too large"}},
           {std::string("d"), std::uint64_t{1}, Missing{}}},
          {"A note."}};
}

TEST(Measured, MarkdownHasEveryRow) {
  EXPECT_EQ(markdown(smallTable()),
            "### A small table\n\n"
            "| name | count | s |\n|---|---:|---:|\n"
            "| a\\|b | 12,345 | 2.00 (50.0 %) |\n"
            "| c | 7 | too large |\n"
            "| d | 1 | - |\n"
            "\nA note.\n");
}

TEST(Measured, JsonKeepsSamplesAndReasons) {
  const auto table = json(smallTable());
  EXPECT_EQ(table["columns"]["seconds"], "s");
  const auto& rows = table["rows"];
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0]["count"], 12345);
  EXPECT_EQ(rows[0]["seconds"]["median"], 2.0);
  EXPECT_EQ(rows[0]["seconds"]["samples"], (std::vector<double>{1, 2, 3}));
  EXPECT_FALSE(rows[0].contains("missing"));
  EXPECT_TRUE(rows[1]["seconds"].is_null());
  EXPECT_EQ(rows[1]["missing"]["seconds"], "too large");
  EXPECT_FALSE(rows[2].contains("missing"));
}

TEST(Measured, CoursesTakeTurns) {
  std::vector<std::size_t> order;
  std::map<std::size_t, int> counted;
  std::vector<Course> courses;
  for (std::size_t i = 0; i < 5; ++i) {
    courses.push_back({"course", [&, i](bool counts) -> Result<void> {
                         order.push_back(i);
                         counted[i] += counts ? 1 : 0;
                         return {};
                       }});
  }
  ASSERT_TRUE(interleave(courses, 6, {}));
  ASSERT_EQ(order.size(), 35u);
  bool shuffled = false;
  for (std::size_t round = 0; round < 7; ++round) {
    const auto begin = order.begin() + static_cast<std::ptrdiff_t>(5 * round);
    std::vector<std::size_t> all(begin, begin + 5);
    shuffled = shuffled || !std::ranges::is_sorted(all);
    std::ranges::sort(all);
    EXPECT_EQ(all, (std::vector<std::size_t>{0, 1, 2, 3, 4})) << "round " << round;
  }
  EXPECT_TRUE(shuffled);
  for (const auto& [course, times] : counted) EXPECT_EQ(times, 6) << course;
}

TEST(Measured, OneCourseThatFailsIsNotRunAgain) {
  int failing = 0, other = 0;
  std::vector<Course> courses = {{"fails",
                                  [&](bool) -> Result<void> {
                                    ++failing;
                                    return tl::unexpected(Error{ErrorCode::device, "lost"});
                                  }},
                                 {"other", [&](bool) -> Result<void> {
                                    ++other;
                                    return {};
                                  }}};
  ASSERT_TRUE(interleave(courses, 3, {}));
  EXPECT_EQ(failing, 1);
  EXPECT_EQ(other, 4);
  EXPECT_EQ(courses[0].failed, "lost");
  EXPECT_EQ(courses[1].failed, "");
}

TEST(Measured, ProgressEndsIt) {
  int runs = 0;
  std::vector<Course> courses = {{"course", [&](bool) -> Result<void> {
                                    ++runs;
                                    return {};
                                  }}};
  const auto done = interleave(courses, 9, [&](std::string_view, double) { return runs < 3; });
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, ErrorCode::cancelled);
  EXPECT_EQ(runs, 3);
}

TEST(Tables, TheExponentOfAPowerIsFound) {
  std::vector<std::pair<double, double>> points;
  for (const double x : {10.0, 100.0, 1000.0}) points.emplace_back(x, 3 * std::pow(x, 1.5));
  EXPECT_NEAR(exponentOf(points), 1.5, 1e-12);
}

TEST(Tables, SizesEndWhereTheyMust) {
  EXPECT_EQ(upTo<std::uint64_t>({10, 100, 1000}, 100), (std::vector<std::uint64_t>{10, 100}));
  EXPECT_EQ(upTo<std::uint64_t>({10, 100, 1000}, 5), (std::vector<std::uint64_t>{5}));
}

TEST(Plots, EveryCurveIsDrawnAndTextIsEscaped) {
  const std::vector<Plot> plots = {
      {"a < b", "x", "y", {{"one", {{1, 1}, {10, 5}}}, {"theirs", {{2, 2}}, true}}},
      {"nothing", "x", "y", {{"none", {}}}}};
  const std::string drawing = svg(plots, "R&D");
  EXPECT_NE(drawing.find("a &lt; b"), std::string::npos);
  EXPECT_NE(drawing.find("R&amp;D"), std::string::npos);
  EXPECT_NE(drawing.find("stroke-dasharray"), std::string::npos);
  EXPECT_EQ(drawing.find("nothing"), std::string::npos);
  EXPECT_EQ(drawing.find("none</"), std::string::npos);
  const auto count = [&](std::string_view what) {
    int times = 0;
    for (auto at = drawing.find(what); at != std::string::npos; at = drawing.find(what, at + 1)) ++times;
    return times;
  };
  EXPECT_EQ(count("<polyline"), 2);
  // Three points, and one in the legend for each name.
  EXPECT_EQ(count("<circle"), 5);
}

}  // namespace
}  // namespace vorpipe::bench

#include "io/base/print.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

namespace vorpipe {
namespace {

std::string printedLines(std::size_t count, int threads, std::size_t skipped) {
  MemorySink sink("lines");
  const auto put = [](Bytes& text, std::size_t i) {
    // Lines of any length, many of them empty.
    if (i % 3 == 0) print(text, FMT_COMPILE("{} {}\n"), i, 1 / static_cast<double>(i + 1));
  };
  EXPECT_TRUE(writeEach(sink, count, put, threads, skipped));
  return sink.take();
}

TEST(WriteEach, HasTheSameBytesOnAnyNumberOfThreads) {
  for (const std::size_t count : {0U, 1U, 255U, 256U, 1000U, 10000U}) {
    const std::string alone = printedLines(count, 1, 0);
    EXPECT_EQ(std::ranges::count(alone, '\n'), (count + 2) / 3);
    for (const int threads : {2, 5, 0}) EXPECT_EQ(printedLines(count, threads, 0), alone);
  }
}

TEST(WriteEach, LeavesOutItsFirstBytes) {
  const std::string whole = printedLines(5000, 1, 0);
  EXPECT_EQ(printedLines(5000, 2, 3), whole.substr(3));
  EXPECT_EQ(printedLines(5000, 2, whole.size()), "");
}

TEST(WriteEach, StopsWhereWritingFails) {
  std::size_t taken = 0;
  CallbackSink sink("full", [&](std::string_view bytes) { return (taken += bytes.size()) < 10000; });
  const auto put = [](Bytes& text, std::size_t i) { print(text, FMT_COMPILE("{}\n"), i); };
  const auto written = writeEach(sink, 1000000, put, 2);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::device);
  EXPECT_LT(taken, 20000U);
}

TEST(Print, HasRoomForTheLongestNumbers) {
  Bytes text;
  const double longest = -std::numeric_limits<double>::min();
  const auto smallest = std::numeric_limits<std::int64_t>::min();
  print(text, FMT_COMPILE("{0}{0}{0},{1}{1}{1}"), longest, smallest);
  const std::string number = "-2.2250738585072014e-308", whole = "-9223372036854775808";
  EXPECT_EQ(fmt::to_string(text), number + number + number + "," + whole + whole + whole);
}

}  // namespace
}  // namespace vorpipe

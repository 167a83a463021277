/// Cases that are skipped, for the one who runs all tests: a line for each in the file that VORPIPE_SKIPPED
/// names, which tests/skipped.sh counts. And an executable that was asked for no case at all fails.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>

namespace vorpipe::test {
namespace {

std::string variable(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

std::string reasonOf(const testing::TestResult& result) {
  std::string reason;
  for (int i = 0; i < result.total_part_count(); ++i)
    if (const auto& part = result.GetTestPartResult(i); part.skipped()) reason = part.message();
  while (!reason.empty() && reason.back() == '\n') reason.pop_back();
  std::ranges::replace_if(
      reason, [](char c) { return c == '\n' || c == '\t'; }, ' ');
  return reason.empty() ? "no reason is given" : reason;
}

class SkippedCases : public testing::EmptyTestEventListener {
  void OnTestProgramStart(const testing::UnitTest& all) override {
    if (all.test_to_run_count() > 0) return;
    std::cerr << "no test case is selected" << std::endl;
    std::exit(1);
  }
  void OnTestEnd(const testing::TestInfo& test) override {
    const std::string file = variable("VORPIPE_SKIPPED");
    if (file.empty() || !test.result()->Skipped()) return;
    // In one piece: other tests append to the file at the same time.
    const std::string line = variable("VORPIPE_TEST_NAME") + '\t' + test.test_suite_name() + '.' +
                             test.name() + '\t' + reasonOf(*test.result()) + '\n';
    std::ofstream out(file, std::ios::app);
    if (!(out << line << std::flush)) {
      std::cerr << file << ": cannot be written" << std::endl;
      std::exit(1);
    }
  }
};

[[maybe_unused]] const bool listening = [] {
  testing::UnitTest::GetInstance()->listeners().Append(new SkippedCases);  // which owns it
  return true;
}();

}  // namespace
}  // namespace vorpipe::test

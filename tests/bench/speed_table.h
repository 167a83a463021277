/// Collects what Google Benchmark measured and prints medians and ratios.
#pragma once

#include <benchmark/benchmark.h>

#include <cstdint>
#include <string>
#include <vector>

namespace vorpipe::test {

/// One row: what is measured, on which sites.
struct Measured {
  std::string what, sites;
  std::uint64_t count;               ///< of sites
  std::string compared_with;         ///< the name of the row that the time per site is divided by, or empty
  std::vector<double> seconds = {};  ///< one for each repetition
  [[nodiscard]] std::string name() const { return what + " " + sites; }
};

/// A reporter that knows its rows by name, as benchmarks are registered.
class SpeedTable : public benchmark::BenchmarkReporter {
 public:
  explicit SpeedTable(std::vector<Measured> rows) : rows_(std::move(rows)) {}
  bool ReportContext(const Context& context) override;
  void ReportRuns(const std::vector<Run>& runs) override;
  void Finalize() override;
  [[nodiscard]] bool failed() const { return failed_; }

 private:
  [[nodiscard]] const Measured* find(const std::string& name) const;

  std::vector<Measured> rows_;
  bool failed_ = false;
};

}  // namespace vorpipe::test

#include "bench/speed_table.h"

#include <fmt/format.h>

#include <algorithm>

namespace vorpipe::test {
namespace {

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double perSite(const Measured& row) { return median(row.seconds) / static_cast<double>(row.count); }

}  // namespace

bool SpeedTable::ReportContext(const Context& context) {
  GetErrorStream() << fmt::format("{} CPUs, load {:.2f}\n", context.cpu_info.num_cpus,
                                  context.cpu_info.load_avg.empty() ? 0 : context.cpu_info.load_avg.front());
  return true;
}

void SpeedTable::ReportRuns(const std::vector<Run>& runs) {
  for (const auto& run : runs) {
    const auto name = run.run_name.function_name;
    if (run.error_occurred) {
      failed_ = true;
      GetErrorStream() << name << ": " << run.error_message << '\n';
    } else if (run.run_type == Run::RT_Iteration) {
      const auto row = std::ranges::find(rows_, name, &Measured::name);
      row->seconds.push_back(run.GetAdjustedRealTime());
    }
  }
}

const Measured* SpeedTable::find(const std::string& name) const {
  const auto row = std::ranges::find(rows_, name, &Measured::name);
  return row == rows_.end() || row->seconds.empty() ? nullptr : &*row;
}

void SpeedTable::Finalize() {
  auto& out = GetOutputStream();
  out << "| what | sites | count | seconds, median (least) | million sites/s | speed to CGAL | time per "
         "site, to "
         "random |\n|---|---|---|---|---|---|---|\n";
  for (const auto& row : rows_) {
    if (row.seconds.empty()) continue;
    const auto* yardstick = find("cgal random");
    const auto* plain = find(row.compared_with);
    out << fmt::format("| {} | {} | {} | {:.3f} ({:.3f}) | {:.2f} | {} | {} |\n", row.what, row.sites,
                       row.count, median(row.seconds), *std::ranges::min_element(row.seconds),
                       1e-6 / perSite(row),
                       yardstick ? fmt::format("{:.2f}", perSite(*yardstick) / perSite(row)) : "-",
                       plain ? fmt::format("{:.2f}", perSite(row) / perSite(*plain)) : "-");
  }
}

}  // namespace vorpipe::test

/// The tables of `vorpipe bench`, and its report.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/lab.h"
#include "bench/machine.h"
#include "bench/measured.h"

namespace vorpipe::bench {

struct Findings {
  std::vector<Table> tables;
  std::vector<Plot> plots;
};

/// Measures what a table needs, and reports it. Error (cancelled): progress requested it. The table reports
/// any other failure.
using Bench = Result<Findings> (*)(Lab&);

/// The times of the thesis that this program follows (Templeton 2022), tables 3.2 to 3.5, measured here.
Result<Findings> thesis(Lab& lab);
/// Where one run spends its time, and how much data moves.
Result<Findings> stages(Lab& lab);
/// Time against sites, threads and pixels.
Result<Findings> scaling(Lab& lab);
/// Other distributions of sites.
Result<Findings> inputs(Lab& lab);
/// The peak of memory, in a process of its own for each run.
Result<Findings> memory(Lab& lab);

/// Of `values`, those that are at most `most`; if none is, `most` alone.
template <class T>
std::vector<T> upTo(std::vector<T> values, T most) {
  std::erase_if(values, [most](T value) { return value > most; });
  if (values.empty()) values.push_back(most);
  return values;
}

/// The exponent e of the power a x^e that comes nearest to the points on logarithmic axes; at least two of
/// different x.
double exponentOf(const std::vector<std::pair<double, double>>& points);

/// Returns the note below a table that an option has cut to `most`; nothing otherwise.
std::vector<std::string> noteIfCut(std::string_view option, std::uint64_t most, std::uint64_t wanted);

/// The largest pictures.
inline constexpr int largest_picture = 4000;

inline constexpr int usual_repetitions = 7;

/// A backend under its requested name, and the device that it runs on.
struct OpenedDevice {
  std::string name;
  DeviceInfo device;
};

struct Conditions {
  const Machine& machine;
  const std::vector<OpenedDevice>& opened;
  const std::vector<std::string>& unusable;  ///< lines that say which backends were not measured, and why
  const Settings& settings;
};

/// Returns a heading and a list.
std::string markdown(const Conditions& conditions);

/// Returns a whole report: an object and a line end.
std::string reportJson(const Conditions& conditions, std::span<const Table> tables);

}  // namespace vorpipe::bench

/// The tables of `vorpipe bench`.
#pragma once

#include <string>
#include <vector>

#include "bench/lab.h"
#include "bench/plot.h"

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

/// Of `sizes`, those that are at most `most`; if none is, `most` alone.
std::vector<std::uint64_t> sizesUpTo(std::vector<std::uint64_t> sizes, std::uint64_t most);

/// The same for the sides of pictures.
std::vector<int> sidesUpTo(std::vector<int> sides, int most);

/// The exponent e of the power a x^e that comes nearest to the points on logarithmic axes; at least two of
/// different x.
double exponentOf(const std::vector<std::pair<double, double>>& points);

/// Returns the note below a table that --max-sites has shortened; nothing otherwise.
std::vector<std::string> noteOfLimit(const Lab& lab, std::uint64_t wanted);
/// The same for --max-side.
std::vector<std::string> noteOfSide(const Lab& lab);

/// The largest pictures.
inline constexpr int largest_picture = 4000;

}  // namespace vorpipe::bench

#include "motion/targets.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/block_sums.h"
#include "base/refusal.h"

namespace vorpipe::moving {

Result<std::vector<double>> targetsOf(const TransportOptions& options, std::size_t sites, double whole) {
  const auto refuse = [](const std::string& what) {
    return tl::unexpected(refusalOf(Subject::masses, what));
  };
  const auto& masses = options.masses;
  if (masses.empty()) {
    if (options.surface == Surface::free) return refuse("a free surface needs them");
    return std::vector<double>(sites, whole / static_cast<double>(sites));
  }
  if (masses.size() != sites) {
    return refuse(fmt::format("there are {} for {} sites", masses.size(), sites));
  }
  const auto wrong =
      std::ranges::find_if_not(masses, [](double mass) { return std::isfinite(mass) && mass > 0; });
  if (wrong != masses.end()) {
    return refuse(fmt::format("that of site {} (counted from 0) is {}, not a finite number above 0",
                              wrong - masses.begin(), *wrong));
  }
  CarefulSum sum;
  for (const double mass : masses) sum.add(mass);
  constexpr double slack = 1e-9;
  const double excess = sum.value() - whole;
  if (options.surface == Surface::free) {
    if (excess <= 0) return masses;
    return refuse(fmt::format("they add up to {}, more than the {} of the domain", sum.value(), whole));
  }
  if (std::abs(excess) <= slack * whole) return masses;
  return refuse(fmt::format("they add up to {}, the mass of the domain to {}", sum.value(), whole));
}

}  // namespace vorpipe::moving

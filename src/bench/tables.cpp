#include "bench/tables.h"

#include <fmt/core.h>

#include <cmath>

namespace vorpipe::bench {

namespace {

template <class T>
std::vector<T> upTo(std::vector<T> values, T most) {
  std::erase_if(values, [most](T value) { return value > most; });
  if (values.empty()) values.push_back(most);
  return values;
}

}  // namespace

std::vector<std::uint64_t> sizesUpTo(std::vector<std::uint64_t> sizes, std::uint64_t most) {
  return upTo(std::move(sizes), most);
}

std::vector<int> sidesUpTo(std::vector<int> sides, int most) { return upTo(std::move(sides), most); }

double exponentOf(const std::vector<std::pair<double, double>>& points) {
  double x_mean = 0, y_mean = 0;
  for (const auto& [x, y] : points) {
    x_mean += std::log(x) / static_cast<double>(points.size());
    y_mean += std::log(y) / static_cast<double>(points.size());
  }
  double along = 0, across = 0;
  for (const auto& [x, y] : points) {
    const double off = std::log(x) - x_mean;
    along += off * off;
    across += off * (std::log(y) - y_mean);
  }
  return across / along;
}

std::vector<std::string> noteOfLimit(const Lab& lab, std::uint64_t wanted) {
  const std::uint64_t most = lab.settings().max_sites;
  if (most >= wanted) return {};
  return {fmt::format("Cut short: --max-sites {} of {}.", most, wanted)};
}

std::vector<std::string> noteOfSide(const Lab& lab) {
  const int most = lab.settings().max_side;
  if (most >= largest_picture) return {};
  return {fmt::format("Cut short: --max-side {} of {}.", most, largest_picture)};
}

}  // namespace vorpipe::bench

#include "bench/input.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include "support/sites/random_sites.h"

namespace vorpipe::test {
namespace {

constexpr int grid_bits = 30;  // of an int, so that sites a domain's side away still fit

void snap(DataSet& set, double grid) {
  const auto round = [grid](double& value) { value = std::round(value / grid) * grid; };
  std::ranges::for_each(set.sites.x, round);
  std::ranges::for_each(set.sites.y, round);
  for (double* value : {&set.domain.xmin, &set.domain.ymin, &set.domain.xmax, &set.domain.ymax})
    round(*value);
}

/// Keeps the first of equal sites, and the order.
void dropDuplicates(Sites& sites) {
  std::vector<std::size_t> order(sites.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto place = [&](std::size_t i) { return std::tuple(sites.x[i], sites.y[i]); };
  std::ranges::sort(order, [&](auto a, auto b) { return std::tuple(place(a), a) < std::tuple(place(b), b); });
  order.erase(std::unique(order.begin(), order.end(), [&](auto a, auto b) { return place(a) == place(b); }),
              order.end());
  std::ranges::sort(order);
  Sites kept;
  for (const auto i : order) {
    add(kept, {sites.x[i], sites.y[i]});
    if (!sites.weight.empty()) kept.weight.push_back(sites.weight[i]);
  }
  sites = std::move(kept);
}

}  // namespace

BenchInput makeInput(DataSet set, double weights, std::uint64_t seed) {
  const double width = set.domain.xmax - set.domain.xmin, height = set.domain.ymax - set.domain.ymin;
  const double grid = std::exp2(std::ceil(std::log2(std::max(width, height))) - grid_bits);
  snap(set, grid);
  dropDuplicates(set.sites);
  const double square = width * height / static_cast<double>(set.sites.size());
  const double unit = std::exp2(std::round(0.5 * std::log2(square)));
  Random random(seed);
  if (weights > 0 && set.sites.weight.empty()) {
    for (std::size_t i = 0; i < set.sites.size(); ++i)
      set.sites.weight.push_back(weights * square * random.uniform());
  }

  BenchInput input{std::move(set), {}, {}, unit, grid / unit};
  const auto& [xmin, ymin, xmax, ymax] = input.set.domain;
  input.sites = input.set.sites;
  for (double& x : input.sites.x) x = (x - xmin) / unit;
  for (double& y : input.sites.y) y = (y - ymin) / unit;
  for (double& weight : input.sites.weight) weight /= unit * unit;
  input.domain = {0, 0, (xmax - xmin) / unit, (ymax - ymin) / unit};
  return input;
}

}  // namespace vorpipe::test

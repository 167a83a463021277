#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include "cli/checked_run.h"

namespace vorpipe::cli {
namespace {

constexpr std::size_t most_cells = 1000;
constexpr std::size_t most_sites = 20000;
/// Of a cell; few have more.
constexpr std::size_t most_vertices = 16;
/// Of the distance to the site: where ties move a vertex.
constexpr double tie_slack = 1e-5;

using Random = std::mt19937_64;

/// Sites by index: all that are listed, or `most` of them.
std::vector<std::uint32_t> sample(std::vector<std::uint32_t> sites, std::size_t most, Random& random) {
  if (sites.size() <= most) return sites;
  for (std::size_t k = 0; k < most; ++k) std::swap(sites[k], sites[k + random() % (sites.size() - k)]);
  sites.resize(most);
  return sites;
}

/// The neighbors of cell i and theirs.
std::vector<std::uint32_t> sitesAround(const CheckedRun& run, std::size_t i) {
  std::vector<std::uint32_t> around;
  const auto append = [&](std::size_t cell) {
    for (std::size_t e = run.begin(cell); e < run.end(cell); ++e) {
      const std::int64_t neighbor = run.diagram.neighbors[e];
      if (neighbor >= 0) around.push_back(static_cast<std::uint32_t>(neighbor));
    }
  };
  append(i);
  const std::size_t direct = around.size();
  for (std::size_t k = 0; k < direct; ++k) append(around[k]);
  return around;
}

std::string brokenPoint(const CheckedRun& run, std::size_t i, Point p,
                        const std::vector<std::uint32_t>& others) {
  const Point site = run.site(i), own = p - site;
  const double largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(site.x), std::abs(site.y)});
  const double slack = tie_slack * length(own) + 16 * epsilon * largest;
  const auto nearer = std::ranges::find_if(others, [&](std::uint32_t j) {
    const Point other = p - run.site(j);
    // Most sites are farther, which is quickly said.
    if (dot(other, other) >= dot(own, own)) return false;
    return !(run.site(j) == site) && !(beyondBisector(site, run.site(j), p) <= slack);
  });
  if (nearer == others.end()) return {};
  return fmt::format("({}, {}) in the cell of site {} is nearer to site {}", p.x, p.y, i, *nearer);
}

/// Any cell that reaches into a convex one holds a vertex of it.
std::string brokenCell(const CheckedRun& run, std::size_t i, const std::vector<std::uint32_t>& others) {
  std::string broken = brokenPoint(run, i, run.diagram.centroid[i], others);
  const std::size_t step = 1 + (run.end(i) - run.begin(i)) / most_vertices;
  for (std::size_t v = run.begin(i); v < run.end(i) && broken.empty(); v += step) {
    broken = brokenPoint(run, i, run.diagram.vertices[v], others);
  }
  return broken;
}

}  // namespace

std::string brokenNearest(const CheckedRun& run) {
  const std::uint64_t seed = run.input.seed.value_or(1);
  Random random(seed);
  std::vector<std::uint32_t> all(run.input.sites.size());
  std::iota(all.begin(), all.end(), 0u);
  std::vector<std::uint32_t> ok;
  std::ranges::copy_if(all, std::back_inserter(ok), [&](std::uint32_t i) { return run.ok(i); });
  ok = sample(std::move(ok), most_cells, random);
  const bool some = all.size() > most_sites;
  all = sample(std::move(all), most_sites, random);
  for (const std::uint32_t i : ok) {
    std::string broken = brokenCell(run, i, all);
    if (broken.empty() && some) broken = brokenCell(run, i, sitesAround(run, i));
    if (!broken.empty()) return fmt::format("{} (seed {})", broken, seed);
  }
  return {};
}

}  // namespace vorpipe::cli

#include "io/forecast/forecast_files.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "io/files/extension.h"
#include "io/sites/site_source.h"

namespace vorpipe {
namespace {

constexpr std::uint64_t number = sizeof(double), index = sizeof(std::int32_t);
/// Arrays that are shorter do not count.
constexpr std::uint64_t shortest = std::uint64_t{1} << 16;

/// Arrays that grow together, by doubling; the plan keeps them.
void planGrowing(MemoryPlan& plan, std::string_view what, std::uint64_t count,
                 const std::vector<std::uint64_t>& bytes) {
  std::vector<MemoryPlan::Array> arrays(bytes.size());
  for (std::uint64_t room = shortest;; room *= 2) {
    for (std::size_t k = 0; k < bytes.size(); ++k) {
      const auto larger = plan.take(what, room * bytes[k], std::min(room, count) * bytes[k]);
      if (room > shortest) plan.drop(arrays[k]);
      arrays[k] = larger;
    }
    if (room >= count) return;
  }
}

/// cellsMesh(): a table of positions, which is gone when the faces with their corners come.
void planMesh(MemoryPlan& plan, const Workload& work) {
  const std::string_view what = "the mesh to write";
  const auto corners =
      static_cast<std::uint64_t>(std::ceil(static_cast<double>(work.sites) * work.spread.edges));
  const auto since = plan.next();
  const auto table = plan.take(what, std::bit_ceil(2 * corners + 1) * index);
  plan.take(what, corners * index);
  // Each vertex is a corner of three cells, but at walls and where its places in them differ.
  const auto points = std::max(corners / 2, work.sites);
  planGrowing(plan, what, points, {sizeof(Point)});
  plan.drop(table);
  plan.take(what, corners * index);
  planGrowing(plan, what, work.sites, {number, index});
  plan.dropSince(since);
}

}  // namespace

void planSites(MemoryPlan& plan, const std::string& spec, std::uint64_t sites, bool weighted) {
  const std::string_view what = "sites";
  if (generatedCount(spec)) {
    plan.take(what, sites * number);
    plan.take(what, sites * number);
    return;
  }
  std::vector<std::uint64_t> columns(2, number);
  if (weighted) columns.insert(columns.begin(), number);
  planGrowing(plan, what, sites, columns);
}

void planAttributes(MemoryPlan& plan, std::uint64_t bytes) {
  if (bytes > shortest) plan.take("attributes", bytes);
}

void planWeights(MemoryPlan& plan, const std::string& path, std::uint64_t sites) {
  const std::string_view what = "weights";
  if (path.empty() || lowerExtension(path) == ".npy") {
    plan.take(what, sites * number);
  } else {
    planGrowing(plan, what, sites, {number});
  }
}

void planDensity(MemoryPlan& plan, std::uint64_t pixels) {
  constexpr std::uint64_t png_pixel = 8;
  const auto file = plan.take("the density", pixels * png_pixel);
  plan.take("the density", pixels * number);
  plan.drop(file);
}

void planCellsFile(MemoryPlan& plan, const Workload& work, const CellsFormat& format) {
  if (format.mesh) planMesh(plan, work);
}

}  // namespace vorpipe

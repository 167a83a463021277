#include "io/cells/forecast_files.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "io/base/extension.h"
#include "io/sites/site_source.h"
#include "vorpipe/shapes.h"

namespace vorpipe {
namespace {

constexpr std::uint64_t number_size = sizeof(double), index_size = sizeof(std::int32_t);
/// Shorter arrays do not count.
constexpr std::uint64_t shortest = std::uint64_t{1} << 16;

/// Plans arrays that grow together, by doubling; the plan keeps them.
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

/// Returns the number of corners of all cells.
std::uint64_t cornersOf(const Workload& work) { return work.sites * mean_edges; }

/// Plans cellsMesh(): a table of positions, freed before the faces and their corners are made.
void planMesh(MemoryPlan& plan, const Workload& work) {
  const std::string_view what = "the mesh to write";
  const auto corners = cornersOf(work);
  const auto since = plan.next();
  const auto table = plan.take(what, std::bit_ceil(2 * corners + 1) * index_size);
  plan.take(what, corners * index_size);
  // Each vertex is a corner of three cells, except at walls and where its positions in them differ.
  const auto points = std::max(corners / 2, work.sites);
  planGrowing(plan, what, points, {sizeof(Point)});
  plan.drop(table);
  plan.take(what, corners * index_size);
  planGrowing(plan, what, work.sites, {number_size, index_size});
  plan.dropSince(since);
}

/// Counts each edge once: edges at walls belong to one cell.
std::uint64_t edgesOf(const Workload& work) { return cornersOf(work) / 2 + work.sites / 8; }

/// Plans topologyOf(); the plan keeps its arrays.
void planTopology(MemoryPlan& plan, const Workload& work) {
  const std::string_view what = "the topology";
  const auto corners = cornersOf(work), edges = edgesOf(work);
  const auto vertices = std::max(corners / 2, work.sites);
  const auto table = plan.take(what, std::bit_ceil(2 * corners + 1) * index_size);
  plan.take(what, corners * index_size);
  planGrowing(plan, what, vertices, {sizeof(Point)});
  plan.drop(table);
  plan.take(what, corners * index_size);
  if (work.periodic) {
    const std::vector<MemoryPlan::Array> copies{plan.take(what, vertices * number_size),
                                                plan.take(what, vertices * index_size)};
    plan.drop(copies);
  }
  plan.take(what, edges * number_size);
  plan.take(what, edges * 2 * index_size);
  plan.take(what, edges * 2 * number_size);
}

}  // namespace

void planSites(MemoryPlan& plan, const std::string& spec, std::uint64_t sites, bool weighted) {
  const std::string_view what = "sites";
  if (generatedCount(spec)) {
    plan.take(what, sites * number_size);
    plan.take(what, sites * number_size);
    return;
  }
  std::vector<std::uint64_t> columns(2, number_size);
  if (weighted) columns.insert(columns.begin(), number_size);
  planGrowing(plan, what, sites, columns);
}

void planAttributes(MemoryPlan& plan, std::uint64_t bytes) {
  if (bytes > shortest) plan.take("attributes", bytes);
}

void planWeights(MemoryPlan& plan, const std::string& path, std::uint64_t sites) {
  const std::string_view what = "weights";
  if (path.empty() || lowerExtension(path) == ".npy") {
    plan.take(what, sites * number_size);
  } else {
    planGrowing(plan, what, sites, {number_size});
  }
}

void planDensity(MemoryPlan& plan, std::uint64_t pixels) {
  constexpr std::uint64_t png_pixel = 8;
  const auto file = plan.take("the density", pixels * png_pixel);
  plan.take("the density", pixels * number_size);
  plan.drop(file);
}

void planCellsFile(MemoryPlan& plan, const Workload& work, const CellsFormat& format,
                   std::uint64_t attribute_bytes) {
  if (format.mesh) planMesh(plan, work);
  if (format.in_memory) {
    // As measured: numbers and index per site; a position and a neighbor's number per corner.
    constexpr std::uint64_t site_bytes = 220, corner_bytes = 26;
    const auto bytes = work.sites * site_bytes + cornersOf(work) * corner_bytes + attribute_bytes;
    plan.drop(plan.take("the file to write", bytes));
  }
}

void planEdgesFiles(MemoryPlan& plan, const Workload& work, std::span<const EdgesFormat* const> formats) {
  if (formats.empty()) return;
  const auto since = plan.next();
  planTopology(plan, work);
  if (std::ranges::any_of(formats, [](const EdgesFormat* format) { return format->in_memory; })) {
    constexpr std::uint64_t edge_bytes = 175;  // as measured, with the index
    plan.take("the file to write", edgesOf(work) * edge_bytes);
  }
  plan.dropSince(since);
}

void planShapes(MemoryPlan& plan, const Workload& work, const RenderOptions& options) {
  const std::string_view what = "the shapes to write";
  const auto since = plan.next();
  const auto indices = plan.take(what, work.sites);
  if (options.color != ColorBy::site) plan.drop(plan.take(what, work.sites * number_size));
  plan.take(what, work.sites * sizeof(std::uint32_t));
  plan.drop(indices);
  if (options.show_sites) planGrowing(plan, what, work.sites, {sizeof(Point)});
  if (options.dual) planGrowing(plan, what, edgesOf(work), {sizeof(Line)});
  if (options.labels) planGrowing(plan, what, work.sites, {sizeof(SiteLabel)});
  plan.dropSince(since);
}

void planIdsFile(MemoryPlan& plan, const Workload& work, const IdsFormat& format, const PictureSize& size) {
  if (!format.compressed) return;
  // A line through evenly spread sites crosses 4/pi cells per site along a side of the domain. Differences
  // there are nonzero, and take a little more than their four bytes.
  constexpr double cells_of_line = 1.28, bytes_of_change = 5, bytes_of_row = 64;
  const double changes =
      std::min<double>(size.width, cells_of_line * std::sqrt(static_cast<double>(work.sites)));
  const double bytes = size.height * (bytes_of_row + bytes_of_change * changes);
  plan.drop(plan.take("the compressed ids", static_cast<std::uint64_t>(bytes)));
}

}  // namespace vorpipe

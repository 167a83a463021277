#include "io/cells/forecast_files.h"

#include <algorithm>
#include <cmath>

#include "io/base/extension.h"
#include "io/sites/site_source.h"
#include "io/sites/space_source.h"
#include "vorpipe/shapes.h"

namespace vorpipe {
namespace {

constexpr std::uint64_t number_size = sizeof(double), index_size = sizeof(std::int32_t);
/// Bytes per site: of cellsMesh and of topologyOf with a table of positions; of text or features that are put
/// together in memory, as measured.
constexpr std::uint64_t mesh_site = 230, globe_mesh_site = 280, topology_site = 200, globe_edges_site = 120,
                        images_site = 36, text_site = 380, edges_text_site = 550;

/// Plans lists that grow by doubling, with `bytes` for each of `count` entries.
MemoryPlan::Array planGrowing(MemoryPlan& plan, std::string_view what, std::uint64_t count,
                              std::uint64_t bytes) {
  return plan.take(what, count * bytes * 3 / 2);
}

}  // namespace

void planSites(MemoryPlan& plan, const std::string& spec, std::uint64_t sites, bool weighted) {
  if (generatedCount(spec)) {
    plan.take("sites", sites * 2 * number_size);
  } else {
    planGrowing(plan, "sites", sites, (weighted ? 3 : 2) * number_size);
  }
}

void planSpaceSites(MemoryPlan& plan, const std::string& spec, std::uint64_t sites) {
  const auto read = plan.next();
  if (!generatedInSpace(spec)) planGrowing(plan, "sites as they are read", sites, 3 * number_size);
  const auto kept = plan.take("sites", sites * sizeof(Point3));
  plan.dropSince(read, {kept});
}

void planAttributes(MemoryPlan& plan, std::uint64_t bytes) { plan.take("attributes", bytes); }

void planWeights(MemoryPlan& plan, const std::string& path, std::uint64_t sites) {
  if (path.empty() || lowerExtension(path) == ".npy") {
    plan.take("weights", sites * number_size);
  } else {
    planGrowing(plan, "weights", sites, number_size);
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
  if (format.mesh)
    plan.drop(plan.take("the mesh to write", work.sites * (work.globe ? globe_mesh_site : mesh_site)));
  if (format.in_memory) plan.drop(plan.take("the file to write", work.sites * text_site + attribute_bytes));
}

void planSpaceFile(MemoryPlan& plan, std::uint64_t sites, const SpaceFormat& format) {
  // Where the corners and the faces of each cell end, and the lists as they grow.
  constexpr std::uint64_t ends_of_site = 40;
  if (format.extension == ".vtu") plan.drop(plan.take("the mesh to write", sites * ends_of_site));
}

void planEdgesFiles(MemoryPlan& plan, const Workload& work, std::span<const EdgesFormat* const> formats) {
  if (formats.empty()) return;
  const bool in_memory = std::ranges::any_of(formats, &EdgesFormat::in_memory);
  const auto topology = topology_site + (work.periodic ? images_site : 0) +
                        (work.globe ? globe_edges_site : 0) + (in_memory ? edges_text_site : 0);
  plan.drop(plan.take("the topology", work.sites * topology));
}

void planTriangulationFiles(MemoryPlan& plan, const Workload& work,
                            std::span<const EdgesFormat* const> formats) {
  // Two triangles a site have three sides each, and half of them stay.
  constexpr std::uint64_t sides = 6, edges = 3;
  if (formats.empty()) return;
  const bool in_memory = std::ranges::any_of(formats, &EdgesFormat::in_memory);
  const std::uint64_t site =
      sides * sizeof(SitePair) + edges * number_size + (in_memory ? edges_text_site : 0);
  plan.drop(plan.take("the triangulation's edges", work.sites * site));
}

void planShapes(MemoryPlan& plan, const Workload& work, const RenderOptions& options) {
  const std::string_view what = "the shapes to write";
  const auto since = plan.next();
  plan.take(what, work.sites * (1 + number_size + sizeof(std::uint32_t)));
  constexpr std::uint64_t on_map = 680, edges_on_map = 200, buffers = 12'000'000;
  if (work.globe) plan.take(what, buffers + work.sites * (on_map + (options.edges ? edges_on_map : 0)));
  if (options.show_sites) planGrowing(plan, what, work.sites, sizeof(Point));
  if (options.dual) planGrowing(plan, what, work.sites * mean_edges / 2, sizeof(Line));
  if (options.labels) planGrowing(plan, what, work.sites, sizeof(SiteLabel));
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

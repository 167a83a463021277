/// Memory forecasts of runs.
#include <cstdint>
#include <string_view>

#include "c/calls.h"
#include "c/handles.h"
#include "c/options.h"
#include "c/placed_input.h"
#include "vorpipe/shapes.h"

namespace vorpipe::c {
namespace {

void takeSites(MemoryPlan& plan, std::string_view what, const Sites& sites) {
  for (const auto* numbers : {&sites.x, &sites.y, &sites.weight}) {
    if (!numbers->empty()) plan.take(what, numbers->size() * sizeof(double));
  }
}

/// Begins a plan with the program, its session and the sites.
MemoryPlan begun(const vorpipe_input& input, const PlacedInput& placed, const Workload& work) {
  MemoryPlan plan;
  takeSites(plan, "sites", *input.sites);
  if (placed.sites != input.sites) takeSites(plan, "the sites of the run", *placed.sites);
  if (placed.domain.projection) takeSites(plan, "the sites in degrees", *placed.given);
  for (const Attribute& attribute : *input.attributes) plan.take("attributes", attribute.bytes());
  if (work.density_pixels > 0) plan.take("the density", work.density_pixels * sizeof(double));
  planSession(plan, work);
  return plan;
}

/// Plans positions that a diagram has both in degrees and in the plane.
void takePlanePositions(MemoryPlan& plan, const PlacedInput& placed, Detail detail) {
  constexpr std::uint64_t vertices_of_cell = 6;
  if (!placed.domain.projection) return;
  const std::uint64_t positions = detail == Detail::measures ? 1 : 1 + vertices_of_cell;
  plan.take("positions in the plane", placed.sites->size() * positions * sizeof(Point));
}

}  // namespace
}  // namespace vorpipe::c

using namespace vorpipe;
using namespace vorpipe::c;

vorpipe_code vorpipe_cells_memory(const vorpipe_session* session, const vorpipe_input* input,
                                  const vorpipe_cells_options* options, uint64_t* bytes) {
  if (session == nullptr) return missing("session");
  if (input == nullptr) return missing("input");
  if (bytes == nullptr) return missing("bytes");
  return guarded([&] {
    const auto placed = placedInput(*input);
    if (!placed) return fail(placed.error());
    const auto cells = cellsOptions(*input, **placed, options);
    if (!cells) return fail(cells.error());
    const auto work =
        workloadOf(*(*placed)->sites, *cells, ImagesFor::cells, session->session.device(), session->threads);
    if (!work) return fail(work.error());
    MemoryPlan plan = begun(*input, **placed, *work);
    planCells(plan, *work, cells->detail);
    takePlanePositions(plan, **placed, cells->detail);
    *bytes = plan.peak();
    return vorpipe_code{VORPIPE_DONE};
  });
}

vorpipe_code vorpipe_render_memory(const vorpipe_session* session, const vorpipe_input* input,
                                   const vorpipe_render_options* options, uint64_t* bytes) {
  if (session == nullptr) return missing("session");
  if (input == nullptr) return missing("input");
  if (bytes == nullptr) return missing("bytes");
  return guarded([&] {
    const auto placed = placedInput(*input);
    if (!placed) return fail(placed.error());
    const auto picture = renderOptions(**placed, options);
    if (!picture) return fail(picture.error());
    const auto work = workloadOf(*(*placed)->sites, cellsOptions(*picture), imagesFor(*picture),
                                 session->session.device(), session->threads);
    if (!work) return fail(work.error());
    MemoryPlan plan = begun(*input, **placed, *work);
    planPicture(plan, *work, *picture);
    *bytes = plan.peak();
    return vorpipe_code{VORPIPE_DONE};
  });
}

uint64_t vorpipe_memory_limit() {
  try {
    return systemMemoryLimit().bytes;
  } catch (...) {
    return 0;
  }
}

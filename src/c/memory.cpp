/// How much memory runs take.
#include "c/failure.h"
#include "c/handles.h"
#include "c/options.h"

namespace vorpipe::c {
namespace {

/// A plan that has the program, its session and the sites.
MemoryPlan begun(const vorpipe_input& input, const Workload& work) {
  MemoryPlan plan;
  for (const auto* numbers : {&input.sites->x, &input.sites->y, &input.sites->weight}) {
    if (!numbers->empty()) plan.take("sites", numbers->size() * sizeof(double));
  }
  if (work.density_pixels > 0) plan.take("the density", work.density_pixels * sizeof(double));
  planSession(plan, work);
  return plan;
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
    const auto cells = cellsOptions(*input, options);
    if (!cells) return fail(cells.error());
    const auto work =
        workloadOf(*input->sites, *cells, ImagesFor::cells, session->session.device(), session->threads);
    if (!work) return fail(work.error());
    MemoryPlan plan = begun(*input, *work);
    planCells(plan, *work, cells->detail);
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
    const auto picture = renderOptions(*input, options);
    if (!picture) return fail(picture.error());
    const auto work = workloadOf(*input->sites, cellsOptions(*picture), imagesFor(picture->color),
                                 session->session.device(), session->threads);
    if (!work) return fail(work.error());
    MemoryPlan plan = begun(*input, *work);
    planPicture(plan, *work, picture->width, picture->height, picture->color);
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

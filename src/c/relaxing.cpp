/// Sites that move.
#include <utility>

#include "c/array.h"
#include "c/failure.h"
#include "c/handles.h"
#include "c/moved_sites.h"
#include "c/moving_options.h"
#include "c/options.h"
#include "c/placed_input.h"
#include "c/session_use.h"
#include "c/structs.h"

namespace vorpipe::c {
namespace {

Result<RelaxOptions> relaxOptions(const vorpipe_input& input, const PlacedInput& placed,
                                  const vorpipe_relax_options* given) {
  const auto wanted = taken(given, "vorpipe_relax_options");
  if (!wanted) return tl::unexpected(wanted.error());
  constexpr std::array methods{RelaxMethod::lbfgs, RelaxMethod::lloyd};
  const auto method = chosen(methods, wanted->method, "method");
  if (!method) return tl::unexpected(method.error());
  auto cells = movingOptions(input, placed, wanted->search, wanted->search_neighbors);
  if (!cells) return tl::unexpected(std::move(cells.error()));
  auto options = optionsWith<RelaxOptions>(std::move(*cells));
  options.equal_masses = wanted->equal_masses != 0;
  options.method = *method;
  if (wanted->iterations != 0) options.iterations = wanted->iterations;
  options.tolerance = wanted->tolerance;
  options.progress = progressOf(wanted->progress, wanted->progress_user);
  return options;
}

vorpipe_code begin(vorpipe_session& session, const vorpipe_input& input, const vorpipe_relax_options* given,
                   vorpipe_relaxation** relaxation) {
  const auto placed = placedInput(input);
  if (!placed) return fail(placed.error());
  auto options = relaxOptions(input, **placed, given);
  if (!options) return fail(options.error());
  auto begun = Relaxation::begin(session.session, *(*placed)->sites, std::move(*options));
  if (!begun) return fail(begun.error());
  *relaxation = new vorpipe_relaxation{&session, *placed, input, std::move(*begun)};
  return VORPIPE_DONE;
}

Result<vorpipe_array> arrayOf(const vorpipe_relaxation& relaxation, vorpipe_relaxation_field field) {
  if (field == VORPIPE_RELAXED_SITES) {
    const Sites sites = shownSites(*relaxation.placed, relaxation.relaxation.sites());
    relaxation.shown.clear();
    for (std::size_t i = 0; i < sites.size(); ++i) relaxation.shown.push_back({sites.x[i], sites.y[i]});
    return array(relaxation.shown, VORPIPE_DOUBLE);
  }
  if (field == VORPIPE_RELAXED_TAKEN) {
    relaxation.taken.clear();
    for (const RelaxStep& step : relaxation.relaxation.trace())
      relaxation.taken.push_back(step.taken ? 1 : 0);
    return array(relaxation.taken, VORPIPE_UINT8);
  }
  if (field != VORPIPE_RELAXED_TRACE) return noField(field);
  relaxation.trace.clear();
  for (const RelaxStep& step : relaxation.relaxation.trace()) {
    relaxation.trace.push_back(
        {static_cast<double>(step.diagram), step.energy, step.hexagonal, step.farthest, step.seconds});
  }
  return array(relaxation.trace, VORPIPE_DOUBLE);
}

MovedSites movedOf(const vorpipe_relaxation& relaxation) {
  return {relaxation.input, *relaxation.placed, relaxation.relaxation.sites()};
}

}  // namespace
}  // namespace vorpipe::c

using namespace vorpipe;
using namespace vorpipe::c;

vorpipe_code vorpipe_relax_begin(vorpipe_session* session, const vorpipe_input* input,
                                 const vorpipe_relax_options* options, vorpipe_relaxation** relaxation) {
  if (session == nullptr) return missing("session");
  if (input == nullptr) return missing("input");
  if (relaxation == nullptr) return missing("relaxation");
  return guardedRun(*session, [&] { return begin(*session, *input, options, relaxation); });
}

vorpipe_code vorpipe_relaxation_step(vorpipe_relaxation* relaxation, int32_t* more) {
  if (relaxation == nullptr) return missing("relaxation");
  return guardedRun(*relaxation->session, [&]() -> vorpipe_code {
    const auto stepped = relaxation->relaxation.step();
    if (!stepped) return fail(stepped.error());
    if (more != nullptr) *more = *stepped ? 1 : 0;
    return VORPIPE_DONE;
  });
}

vorpipe_code vorpipe_relax(vorpipe_session* session, const vorpipe_input* input,
                           const vorpipe_relax_options* options, vorpipe_relaxation** relaxation) {
  if (relaxation == nullptr) return missing("relaxation");
  vorpipe_relaxation* begun = nullptr;
  vorpipe_code code = vorpipe_relax_begin(session, input, options, &begun);
  for (int32_t more = 1; code == VORPIPE_DONE && more != 0;) code = vorpipe_relaxation_step(begun, &more);
  if (code == VORPIPE_DONE) {
    *relaxation = begun;
  } else {
    vorpipe_relaxation_free(begun);
  }
  return code;
}

void vorpipe_relaxation_free(vorpipe_relaxation* relaxation) { delete relaxation; }

vorpipe_code vorpipe_relaxation_array(const vorpipe_relaxation* relaxation, vorpipe_relaxation_field field,
                                      vorpipe_array* array) {
  if (relaxation == nullptr) return missing("relaxation");
  if (array == nullptr) return missing("array");
  return guarded([&] { return give(arrayOf(*relaxation, field), array); });
}

vorpipe_relax_end vorpipe_relaxation_end(const vorpipe_relaxation* relaxation) {
  return relaxation == nullptr ? VORPIPE_RELAX_ITERATIONS
                               : static_cast<vorpipe_relax_end>(relaxation->relaxation.end());
}

vorpipe_code vorpipe_relaxation_report(const vorpipe_relaxation* relaxation, vorpipe_report* report) {
  if (relaxation == nullptr) return missing("relaxation");
  if (report == nullptr) return missing("report");
  return guarded([&] { return giveReport(relaxation->relaxation.report(), report); });
}

const char* vorpipe_relaxation_note(const vorpipe_relaxation* relaxation, size_t index) {
  return relaxation == nullptr ? nullptr : textAt(relaxation->relaxation.report().notes, index);
}

vorpipe_code vorpipe_relaxation_input(const vorpipe_relaxation* relaxation, vorpipe_input** input) {
  if (relaxation == nullptr) return missing("relaxation");
  if (input == nullptr) return missing("input");
  return guarded([&] { return giveMoved(movedOf(*relaxation), relaxation->input.surface, input); });
}

vorpipe_code vorpipe_relaxation_write(const vorpipe_relaxation* relaxation, const char* format,
                                      vorpipe_write write, void* user) {
  if (relaxation == nullptr) return missing("relaxation");
  if (format == nullptr) return missing("format");
  if (write == nullptr) return missing("write");
  return guarded([&] { return writeMoved(movedOf(*relaxation), format, write, user); });
}

vorpipe_code vorpipe_relaxation_save(const vorpipe_relaxation* relaxation, const char* path) {
  if (relaxation == nullptr) return missing("relaxation");
  if (path == nullptr) return missing("path");
  return guarded([&] { return saveMoved(movedOf(*relaxation), path); });
}

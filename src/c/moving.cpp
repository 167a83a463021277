/// Sites that move, and weights for prescribed masses.
#include <cstddef>
#include <utility>

#include "base/try.h"
#include "c/calls.h"
#include "c/handles.h"
#include "io/base/error.h"
#include "vorpipe/masses.h"

namespace vorpipe::c {
namespace {

Result<RelaxOptions> relaxOptions(const vorpipe_input& input, const PlacedInput& placed,
                                  const vorpipe_relax_options* given) {
  VORPIPE_LET(wanted, taken(given, "vorpipe_relax_options"));
  constexpr std::array methods{RelaxMethod::lbfgs, RelaxMethod::lloyd};
  VORPIPE_LET(method, chosen(methods, wanted.method, "method"));
  VORPIPE_VAR(cells, movingOptions(input, placed, wanted.search, wanted.search_neighbors));
  auto options = optionsWith<RelaxOptions>(std::move(cells));
  options.globe = placed.domain.globe;
  options.equal_masses = wanted.equal_masses != 0;
  options.method = method;
  if (wanted.iterations != 0) options.iterations = wanted.iterations;
  options.tolerance = wanted.tolerance;
  options.progress = progressOf(wanted.progress, wanted.progress_user);
  return options;
}

vorpipe_code begin(vorpipe_session& session, const vorpipe_input& input, const vorpipe_relax_options* given,
                   vorpipe_relaxation** relaxation) {
  VORPIPE_TAKE(placed, placedInput(input));
  VORPIPE_TAKE(options, relaxOptions(input, *placed, given));
  VORPIPE_TAKE(begun, Relaxation::begin(session.session, *placed->sites, std::move(options)));
  *relaxation = new vorpipe_relaxation{&session, placed, input, std::move(begun)};
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

tl::unexpected<Error> refused(const std::string& message) {
  return tl::unexpected(Error{ErrorCode::input, message, false, Subject::masses});
}

/// Refuses contradictory options.
Result<void> checkMasses(const vorpipe_transport_options& wanted) {
  if (wanted.masses == nullptr && wanted.mass_count > 0) return refused("masses: is NULL");
  if (!(wanted.fill >= 0 && wanted.fill < 1)) {
    return refused(fmt::format("fill: {} is not a part of the domain, between 0 and 1", wanted.fill));
  }
  const bool free = wanted.fill > 0 || wanted.surface == VORPIPE_SURFACE_FREE;
  if (wanted.normalize != 0 && free) {
    return refused("normalize: cells with a free surface do not fill the domain; fill scales them");
  }
  return {};
}

Result<TransportOptions> transportOptions(const vorpipe_input& input, const PlacedInput& placed,
                                          const vorpipe_transport_options& wanted) {
  if (placed.domain.globe) {
    return inputError("globe: masses are of a plane, and this input is on the globe");
  }
  VORPIPE_TRY(checkMasses(wanted));
  constexpr std::array surfaces{Surface::none, Surface::free};
  VORPIPE_LET(surface, chosen(surfaces, wanted.surface, "surface"));
  VORPIPE_VAR(cells, movingOptions(input, placed, wanted.search, wanted.search_neighbors));
  auto options = optionsWith<TransportOptions>(std::move(cells));
  options.surface = wanted.fill > 0 ? Surface::free : surface;
  if (wanted.masses != nullptr) options.masses.assign(wanted.masses, wanted.masses + wanted.mass_count);
  if (wanted.tolerance != 0) options.tolerance = wanted.tolerance;
  if (wanted.diagrams != 0) options.diagrams = wanted.diagrams;
  options.progress = progressOf(wanted.progress, wanted.progress_user);
  return options;
}

vorpipe_transport_step toldOf(const TransportStep& step) {
  vorpipe_transport_step told{};
  told.taken = step.taken ? 1 : 0;
  told.diagram = step.diagram;
  told.newton = step.newton;
  told.linear_iterations = step.linear_iterations;
  told.length = step.length;
  told.norm = step.norm;
  told.worst = step.worst;
  told.least = step.least;
  told.seconds = step.seconds;
  return told;
}

std::array<double, 9> rowOf(const TransportStep& step) {
  return {static_cast<double>(step.diagram),
          static_cast<double>(step.newton),
          step.length,
          step.taken ? 1.0 : 0.0,
          step.norm,
          step.worst,
          step.least,
          static_cast<double>(step.linear_iterations),
          step.seconds};
}

Result<std::unique_ptr<vorpipe_transported>> find(vorpipe_session& session, const vorpipe_input& input,
                                                  const vorpipe_transport_options* given) {
  VORPIPE_LET(wanted, taken(given, "vorpipe_transport_options"));
  VORPIPE_LET(placed, placedInput(input));
  VORPIPE_VAR(options, transportOptions(input, *placed, wanted));
  const Sites& sites = *placed->sites;
  if (wanted.normalize != 0 || wanted.fill > 0) {
    const double part = wanted.fill > 0 ? wanted.fill : 1;
    VORPIPE_TRY(fillDomain(session.session, sites.size(), part, options));
  }
  VORPIPE_VAR(
      found, transport(session.session, sites, options, watcherOf(wanted.watch, wanted.watch_user, &toldOf)));
  auto made = std::make_unique<vorpipe_transported>(
      vorpipe_transported{placed, input, options.surface, std::move(found)});
  made->centroids = made->found.cells.centroid;
  const auto& projection = made->placed->domain.projection;
  for (Point& place : made->centroids) place = projection ? projection->toDegrees(place) : place;
  for (const TransportStep& step : made->found.trace) made->trace.push_back(rowOf(step));
  return made;
}

Result<vorpipe_array> arrayOf(const vorpipe_transported& transported, vorpipe_transported_field field) {
  const Transported& found = transported.found;
  switch (field) {
    case VORPIPE_TRANSPORTED_WEIGHTS:
      return array(found.sites.weight, VORPIPE_DOUBLE);
    case VORPIPE_TRANSPORTED_MASSES:
      return array(found.cells.mass, VORPIPE_DOUBLE);
    case VORPIPE_TRANSPORTED_AREAS:
      return array(found.cells.area, VORPIPE_DOUBLE);
    case VORPIPE_TRANSPORTED_CENTROIDS:
      return array(transported.centroids, VORPIPE_DOUBLE);
    case VORPIPE_TRANSPORTED_STATUS:
      return array(found.cells.status, VORPIPE_UINT8);
    case VORPIPE_TRANSPORTED_TRACE:
      return array(transported.trace, VORPIPE_DOUBLE);
    default:
      return noField(field);
  }
}

MovedSites movedOf(const vorpipe_transported& transported) {
  return {transported.input, *transported.placed, transported.found.sites};
}

}  // namespace
}  // namespace vorpipe::c

using namespace vorpipe;
using namespace vorpipe::c;

vorpipe_code vorpipe_relax_begin(vorpipe_session* session, const vorpipe_input* input,
                                 const vorpipe_relax_options* options, vorpipe_relaxation** relaxation) {
  VORPIPE_NEEDS(session, input, relaxation);
  return guardedRun(*session, [&] { return begin(*session, *input, options, relaxation); });
}

vorpipe_code vorpipe_relaxation_step(vorpipe_relaxation* relaxation, int32_t* more) {
  VORPIPE_NEEDS(relaxation);
  return guardedRun(*relaxation->session, [&]() -> vorpipe_code {
    VORPIPE_TAKE(stepped, relaxation->relaxation.step());
    if (more != nullptr) *more = stepped ? 1 : 0;
    return VORPIPE_DONE;
  });
}

vorpipe_code vorpipe_relax(vorpipe_session* session, const vorpipe_input* input,
                           const vorpipe_relax_options* options, vorpipe_relaxation** relaxation) {
  VORPIPE_NEEDS(relaxation);
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
  VORPIPE_NEEDS(relaxation, array);
  return guarded([&] { return give(arrayOf(*relaxation, field), array); });
}

vorpipe_relax_end vorpipe_relaxation_end(const vorpipe_relaxation* relaxation) {
  return relaxation == nullptr ? VORPIPE_RELAX_ITERATIONS
                               : static_cast<vorpipe_relax_end>(relaxation->relaxation.end());
}

vorpipe_code vorpipe_relaxation_report(const vorpipe_relaxation* relaxation, vorpipe_report* report) {
  VORPIPE_NEEDS(relaxation, report);
  return guarded([&] { return giveReport(relaxation->relaxation.report(), report); });
}

const char* vorpipe_relaxation_note(const vorpipe_relaxation* relaxation, size_t index) {
  return relaxation == nullptr ? nullptr : textAt(relaxation->relaxation.report().notes, index);
}

vorpipe_code vorpipe_relaxation_input(const vorpipe_relaxation* relaxation, vorpipe_input** input) {
  VORPIPE_NEEDS(relaxation, input);
  return guarded([&] { return giveMoved(movedOf(*relaxation), relaxation->input.surface, input); });
}

vorpipe_code vorpipe_relaxation_write(const vorpipe_relaxation* relaxation, const char* format,
                                      vorpipe_write write, void* user) {
  VORPIPE_NEEDS(relaxation, format, write);
  return guarded([&] { return writeMoved(movedOf(*relaxation), format, write, user); });
}

vorpipe_code vorpipe_relaxation_save(const vorpipe_relaxation* relaxation, const char* path) {
  VORPIPE_NEEDS(relaxation, path);
  return guarded([&] { return saveMoved(movedOf(*relaxation), path); });
}

vorpipe_code vorpipe_transport(vorpipe_session* session, const vorpipe_input* input,
                               const vorpipe_transport_options* options, vorpipe_transported** transported) {
  VORPIPE_NEEDS(session, input, transported);
  return guardedRun(*session, [&]() -> vorpipe_code {
    VORPIPE_TAKE(found, find(*session, *input, options));
    *transported = found.release();
    return VORPIPE_DONE;
  });
}

void vorpipe_transported_free(vorpipe_transported* transported) { delete transported; }

vorpipe_code vorpipe_transported_array(const vorpipe_transported* transported,
                                       vorpipe_transported_field field, vorpipe_array* array) {
  VORPIPE_NEEDS(transported, array);
  return guarded([&] { return give(arrayOf(*transported, field), array); });
}

vorpipe_transport_end vorpipe_transported_end(const vorpipe_transported* transported) {
  return transported == nullptr ? VORPIPE_TRANSPORT_CANCELLED
                                : static_cast<vorpipe_transport_end>(transported->found.end);
}

double vorpipe_transported_cost(const vorpipe_transported* transported) {
  return transported == nullptr ? 0 : transported->found.cost;
}

vorpipe_code vorpipe_transported_report(const vorpipe_transported* transported, vorpipe_report* report) {
  VORPIPE_NEEDS(transported, report);
  return guarded([&] { return giveReport(transported->found.report, report); });
}

const char* vorpipe_transported_note(const vorpipe_transported* transported, size_t index) {
  return transported == nullptr ? nullptr : textAt(transported->found.report.notes, index);
}

vorpipe_code vorpipe_transported_input(const vorpipe_transported* transported, vorpipe_input** input) {
  VORPIPE_NEEDS(transported, input);
  return guarded([&] { return giveMoved(movedOf(*transported), transported->surface, input); });
}

vorpipe_code vorpipe_transported_write(const vorpipe_transported* transported, const char* format,
                                       vorpipe_write write, void* user) {
  VORPIPE_NEEDS(transported, format, write);
  return guarded([&] { return writeMoved(movedOf(*transported), format, write, user); });
}

vorpipe_code vorpipe_transported_save(const vorpipe_transported* transported, const char* path) {
  VORPIPE_NEEDS(transported, path);
  return guarded([&] { return saveMoved(movedOf(*transported), path); });
}

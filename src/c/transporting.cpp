/// Weights for prescribed masses.
#include <cstddef>
#include <utility>

#include "base/try.h"
#include "c/array.h"
#include "c/failure.h"
#include "c/handles.h"
#include "c/moved_sites.h"
#include "c/moving_options.h"
#include "c/options.h"
#include "c/placed_input.h"
#include "c/session_use.h"
#include "c/structs.h"
#include "io/base/error.h"
#include "vorpipe/masses.h"

namespace vorpipe::c {
namespace {

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
  VORPIPE_TRY(checkMasses(wanted));
  constexpr std::array surfaces{Surface::none, Surface::free};
  const auto surface = chosen(surfaces, wanted.surface, "surface");
  if (!surface) return tl::unexpected(surface.error());
  auto cells = movingOptions(input, placed, wanted.search, wanted.search_neighbors);
  if (!cells) return tl::unexpected(std::move(cells.error()));
  auto options = optionsWith<TransportOptions>(std::move(*cells));
  options.surface = wanted.fill > 0 ? Surface::free : *surface;
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
  const auto wanted = taken(given, "vorpipe_transport_options");
  if (!wanted) return tl::unexpected(wanted.error());
  const auto placed = placedInput(input);
  if (!placed) return tl::unexpected(placed.error());
  auto options = transportOptions(input, **placed, *wanted);
  if (!options) return tl::unexpected(std::move(options.error()));
  const Sites& sites = *(*placed)->sites;
  if (wanted->normalize != 0 || wanted->fill > 0) {
    const double part = wanted->fill > 0 ? wanted->fill : 1;
    VORPIPE_TRY(fillDomain(session.session, sites.size(), part, *options));
  }
  auto found =
      transport(session.session, sites, *options, watcherOf(wanted->watch, wanted->watch_user, &toldOf));
  if (!found) return tl::unexpected(std::move(found.error()));
  auto made = std::make_unique<vorpipe_transported>(
      vorpipe_transported{*placed, input, options->surface, std::move(*found)});
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

vorpipe_code vorpipe_transport(vorpipe_session* session, const vorpipe_input* input,
                               const vorpipe_transport_options* options, vorpipe_transported** transported) {
  if (session == nullptr) return missing("session");
  if (input == nullptr) return missing("input");
  if (transported == nullptr) return missing("transported");
  return guardedRun(*session, [&]() -> vorpipe_code {
    auto found = find(*session, *input, options);
    if (!found) return fail(found.error());
    *transported = found->release();
    return VORPIPE_DONE;
  });
}

void vorpipe_transported_free(vorpipe_transported* transported) { delete transported; }

vorpipe_code vorpipe_transported_array(const vorpipe_transported* transported,
                                       vorpipe_transported_field field, vorpipe_array* array) {
  if (transported == nullptr) return missing("transported");
  if (array == nullptr) return missing("array");
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
  if (transported == nullptr) return missing("transported");
  if (report == nullptr) return missing("report");
  return guarded([&] { return giveReport(transported->found.report, report); });
}

const char* vorpipe_transported_note(const vorpipe_transported* transported, size_t index) {
  return transported == nullptr ? nullptr : textAt(transported->found.report.notes, index);
}

vorpipe_code vorpipe_transported_input(const vorpipe_transported* transported, vorpipe_input** input) {
  if (transported == nullptr) return missing("transported");
  if (input == nullptr) return missing("input");
  return guarded([&] { return giveMoved(movedOf(*transported), transported->surface, input); });
}

vorpipe_code vorpipe_transported_write(const vorpipe_transported* transported, const char* format,
                                       vorpipe_write write, void* user) {
  if (transported == nullptr) return missing("transported");
  if (format == nullptr) return missing("format");
  if (write == nullptr) return missing("write");
  return guarded([&] { return writeMoved(movedOf(*transported), format, write, user); });
}

vorpipe_code vorpipe_transported_save(const vorpipe_transported* transported, const char* path) {
  if (transported == nullptr) return missing("transported");
  if (path == nullptr) return missing("path");
  return guarded([&] { return saveMoved(movedOf(*transported), path); });
}

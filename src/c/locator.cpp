/// Finds the cell that contains a place.
#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "c/failure.h"
#include "c/handles.h"
#include "c/options.h"
#include "c/placed_input.h"
#include "c/surface.h"

using namespace vorpipe;
using namespace vorpipe::c;

static_assert(sizeof(Point) == 2 * sizeof(double));

vorpipe_code vorpipe_locator_create(const vorpipe_input* input, int32_t threads, vorpipe_locator** locator) {
  if (input == nullptr) return missing("input");
  if (locator == nullptr) return missing("locator");
  return guarded([&] {
    const auto count = threadsOf(threads);
    if (!count) return fail(count.error());
    const auto placed = placedInput(*input);
    if (!placed) return fail(placed.error());
    const auto options = cellsOptions(*input, **placed, nullptr);
    if (!options) return fail(options.error());
    auto made = Locator::make(*(*placed)->sites, *options, *count);
    if (!made) return fail(made.error());
    const bool has_air = input->surface == Surface::free;
    *locator = new vorpipe_locator{std::move(*made), has_air ? (*placed)->sites : nullptr,
                                   (*placed)->domain.projection};
    return vorpipe_code{VORPIPE_DONE};
  });
}

void vorpipe_locator_free(vorpipe_locator* locator) { delete locator; }

vorpipe_code vorpipe_locator_find(const vorpipe_locator* locator, const double* places, uint64_t count,
                                  uint32_t* sites) {
  if (locator == nullptr) return missing("locator");
  if (places == nullptr && count > 0) return missing("places");
  if (sites == nullptr && count > 0) return missing("sites");
  return guarded([&] {
    std::span given(reinterpret_cast<const Point*>(places), count);
    std::vector<Point> plane;
    if (locator->projection) {
      plane.resize(count);
      std::ranges::transform(given, plane.begin(),
                             [&](Point place) { return locator->projection->toPlane(place); });
      given = plane;
    }
    locator->locator.at(given, {sites, count});
    if (locator->discs != nullptr) leaveOutAir(*locator->discs, given.data(), count, sites);
    return vorpipe_code{VORPIPE_DONE};
  });
}

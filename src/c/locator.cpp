/// Which cell holds a place.
#include <span>
#include <utility>

#include "c/failure.h"
#include "c/handles.h"
#include "c/options.h"

using namespace vorpipe;
using namespace vorpipe::c;

static_assert(sizeof(Point) == 2 * sizeof(double));

vorpipe_code vorpipe_locator_create(const vorpipe_input* input, int32_t threads, vorpipe_locator** locator) {
  if (input == nullptr) return missing("input");
  if (locator == nullptr) return missing("locator");
  return guarded([&] {
    const auto count = threadsOf(threads);
    if (!count) return fail(count.error());
    const auto options = cellsOptions(*input, nullptr);
    if (!options) return fail(options.error());
    auto made = Locator::make(*input->sites, *options, *count);
    if (!made) return fail(made.error());
    *locator = new vorpipe_locator{std::move(*made)};
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
    locator->locator.at({reinterpret_cast<const Point*>(places), count}, {sites, count});
    return vorpipe_code{VORPIPE_DONE};
  });
}

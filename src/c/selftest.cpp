/// The self-test.
#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "c/failure.h"
#include "c/options.h"
#include "c/structs.h"
#include "io/base/error.h"
#include "io/base/field_text.h"
#include "selftest/selftest_json.h"
#include "vorpipe/selftest.h"

namespace vorpipe::c {
namespace {

Result<SelftestOptions> selftestOptions(const vorpipe_selftest_options* given) {
  const auto options = taken(given, "vorpipe_selftest_options");
  if (!options) return tl::unexpected(options.error());
  const auto threads = threadsOf(options->threads);
  if (!threads) return tl::unexpected(threads.error());
  auto mask = maskOf(options->disabled_count, options->disabled, options->limit_count, options->limits);
  if (!mask) return tl::unexpected(mask.error());
  SelftestOptions wanted;
  wanted.mask = std::move(*mask);
  if (options->backend != nullptr) wanted.backend = options->backend;
  if (options->device != nullptr) wanted.device = options->device;
  wanted.quick = options->quick != 0;
  if (options->seed != 0) wanted.seed = options->seed;
  wanted.threads = *threads;
  wanted.progress = progressOf(options->progress, options->progress_user);
  return wanted;
}

}  // namespace
}  // namespace vorpipe::c

using namespace vorpipe;
using namespace vorpipe::c;

vorpipe_code vorpipe_selftest(const vorpipe_selftest_options* options, vorpipe_write json, void* user) {
  return guarded([&] {
    const auto wanted = selftestOptions(options);
    if (!wanted) return fail(wanted.error());
    const auto report = selftest(*wanted);
    if (!report) return fail(report.error());
    const std::string text = jsonText(selftestJson(*report), 1);
    if (json != nullptr && json(user, text.data(), text.size()) != 0) {
      return fail(VORPIPE_DEVICE, "json: the caller refused it");
    }
    return report->passed() ? vorpipe_code{VORPIPE_DONE} : fail(VORPIPE_DIFFERENT, "a promise is broken");
  });
}

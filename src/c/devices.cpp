/// Devices, sessions, and how much memory runs take.
#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/try.h"
#include "c/calls.h"
#include "c/handles.h"
#include "c/vorpipe_c.h"
#include "io/base/error.h"
#include "io/base/field_text.h"
#include "io/cells/cells_file.h"
#include "io/cells/edges_file.h"
#include "io/pictures/picture_file.h"
#include "io/sites/sites_file.h"
#include "selftest/selftest_json.h"
#include "vorpipe.h"
#include "vorpipe/fluid.h"
#include "vorpipe/selftest.h"
#include "vorpipe/shapes.h"

namespace vorpipe::c {
namespace {

Result<BackendOptions> backendOptions(const vorpipe_session_options* given) {
  VORPIPE_LET(options, taken(given, "vorpipe_session_options"));
  VORPIPE_VAR(mask, maskOf(options.disabled_count, options.disabled, options.limit_count, options.limits));
  if (options.threads < 0) return inputError(fmt::format("threads: is {}", options.threads));
  BackendOptions backend;
  if (options.backend != nullptr) backend.name = options.backend;
  if (options.device != nullptr) backend.device = options.device;
  const auto known = backendNames();
  if (std::ranges::find(known, backend.name) == known.end()) {
    return inputError(fmt::format("backend: no backend {}", backend.name));
  }
  backend.threads = options.threads;
  backend.mask = std::move(mask);
  backend.validation = options.validation != 0;
  return backend;
}

vorpipe_device_info infoOf(const DeviceInfo& device) {
  vorpipe_device_info info{};
  info.usable = device.usable ? 1 : 0;
  info.backend = device.backend.c_str();
  info.name = device.name.c_str();
  info.driver = device.driver.c_str();
  info.type = device.type.c_str();
  info.reason = device.reason.c_str();
  return info;
}

/// Finds a name in a list of pairs; the end if it is missing.
template <class Pairs>
auto findNamed(const Pairs& pairs, const char* name) {
  return std::ranges::find_if(pairs, [&](const auto& pair) { return pair.first == name; });
}

/// Formats are extensions without their dot.
std::vector<std::string> formats(std::initializer_list<std::vector<std::string_view>> lists) {
  std::vector<std::string> names;
  for (const auto& extensions : lists) {
    for (const std::string_view extension : extensions) names.emplace_back(extension.substr(1));
  }
  return names;
}

const char* nameOf(vorpipe_list list, std::size_t index) {
  static const auto backends = backendNames(), maps = colormaps(), features = featureNames(),
                    limits = limitNames(), cells = formats({cellsExtensions()}),
                    sites = formats({sitesExtensions()}), edges = formats({edgesExtensions()}),
                    pictures = formats({pictureExtensions(), idsExtensions()}), cases = fluidCaseNames();
  switch (list) {
    case VORPIPE_BACKENDS:
      return textAt(backends, index);
    case VORPIPE_COLORMAPS:
      return textAt(maps, index);
    case VORPIPE_CELLS_FORMATS:
      return textAt(cells, index);
    case VORPIPE_FEATURES:
      return textAt(features, index);
    case VORPIPE_LIMITS:
      return textAt(limits, index);
    case VORPIPE_SITES_FORMATS:
      return textAt(sites, index);
    case VORPIPE_EDGES_FORMATS:
      return textAt(edges, index);
    case VORPIPE_PICTURE_FORMATS:
      return textAt(pictures, index);
    case VORPIPE_FLUID_CASES:
      return textAt(cases, index);
    default:
      return nullptr;
  }
}

Result<SelftestOptions> selftestOptions(const vorpipe_selftest_options* given) {
  VORPIPE_LET(options, taken(given, "vorpipe_selftest_options"));
  VORPIPE_LET(threads, threadsOf(options.threads));
  VORPIPE_VAR(mask, maskOf(options.disabled_count, options.disabled, options.limit_count, options.limits));
  SelftestOptions wanted;
  wanted.mask = std::move(mask);
  if (options.backend != nullptr) wanted.backend = options.backend;
  if (options.device != nullptr) wanted.device = options.device;
  wanted.quick = options.quick != 0;
  if (options.seed != 0) wanted.seed = options.seed;
  wanted.threads = threads;
  wanted.progress = progressOf(options.progress, options.progress_user);
  return wanted;
}

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

vorpipe_code vorpipe_devices_find(const vorpipe_session_options* options, vorpipe_devices** devices) {
  VORPIPE_NEEDS(devices);
  return guarded([&] {
    VORPIPE_TAKE(backend, backendOptions(options));
    *devices = new vorpipe_devices{vorpipe::devices(backend.mask)};
    return vorpipe_code{VORPIPE_DONE};
  });
}

void vorpipe_devices_free(vorpipe_devices* devices) { delete devices; }

size_t vorpipe_devices_count(const vorpipe_devices* devices) {
  return devices == nullptr ? 0 : devices->infos.size();
}

vorpipe_code vorpipe_devices_get(const vorpipe_devices* devices, size_t index, vorpipe_device_info* info) {
  VORPIPE_NEEDS(devices, info);
  return guarded([&] {
    if (index >= devices->infos.size()) {
      return fail(VORPIPE_INPUT, fmt::format("index: {} of {} devices", index, devices->infos.size()));
    }
    return codeOf(give(infoOf(devices->infos[index]), info, "vorpipe_device_info"));
  });
}

int32_t vorpipe_devices_feature(const vorpipe_devices* devices, size_t index, const char* feature) {
  if (devices == nullptr || feature == nullptr || index >= devices->infos.size()) return -1;
  const auto& features = devices->infos[index].features;
  const auto found = findNamed(features, feature);
  if (found == features.end()) return -1;
  return found->second ? 1 : 0;
}

vorpipe_code vorpipe_devices_limit(const vorpipe_devices* devices, size_t index, const char* limit,
                                   uint64_t* value) {
  VORPIPE_NEEDS(devices, limit, value);
  return guarded([&] {
    if (index >= devices->infos.size()) {
      return fail(VORPIPE_INPUT, fmt::format("index: {} of {} devices", index, devices->infos.size()));
    }
    const auto& limits = devices->infos[index].limits;
    const auto found = findNamed(limits, limit);
    if (found == limits.end()) {
      return fail(VORPIPE_INPUT, fmt::format("limit: the device has no {}", limit));
    }
    *value = found->second;
    return vorpipe_code{VORPIPE_DONE};
  });
}

vorpipe_code vorpipe_session_open(const vorpipe_session_options* options, vorpipe_session** session) {
  VORPIPE_NEEDS(session);
  return guarded([&] {
    VORPIPE_TAKE(backend, backendOptions(options));
    VORPIPE_TAKE(opened, vorpipe::Session::open(backend));
    *session = new vorpipe_session{std::move(opened), backend.threads};
    return vorpipe_code{VORPIPE_DONE};
  });
}

void vorpipe_session_free(vorpipe_session* session) { delete session; }

vorpipe_code vorpipe_session_device(const vorpipe_session* session, vorpipe_device_info* info) {
  VORPIPE_NEEDS(session, info);
  return guarded(
      [&] { return codeOf(give(infoOf(session->session.device()), info, "vorpipe_device_info")); });
}

const char* vorpipe_session_choice(const vorpipe_session* session) {
  return session == nullptr ? "" : session->session.choice().c_str();
}

const char* vorpipe_version() {
  // A string in the program itself, zero-terminated.
  return vorpipe::version().data();
}

const char* vorpipe_name(vorpipe_list list, size_t index) {
  try {
    return vorpipe::c::nameOf(list, index);
  } catch (...) {
    return nullptr;  // no memory
  }
}

vorpipe_code vorpipe_selftest(const vorpipe_selftest_options* options, vorpipe_write json, void* user) {
  return guarded([&] {
    VORPIPE_TAKE(wanted, selftestOptions(options));
    VORPIPE_TAKE(report, selftest(wanted));
    const std::string text = jsonText(selftestJson(report), 1);
    if (json != nullptr && json(user, text.data(), text.size()) != 0) {
      return fail(VORPIPE_DEVICE, "json: the caller refused it");
    }
    return report.passed() ? vorpipe_code{VORPIPE_DONE} : fail(VORPIPE_DIFFERENT, "a promise is broken");
  });
}

vorpipe_code vorpipe_cells_memory(const vorpipe_session* session, const vorpipe_input* input,
                                  const vorpipe_cells_options* options, uint64_t* bytes) {
  VORPIPE_NEEDS(session, input, bytes);
  return guarded([&] {
    VORPIPE_TAKE(placed, placedInput(*input));
    VORPIPE_TAKE(found, cellsOptions(*input, *placed, options));
    VORPIPE_TAKE(work, workloadOf(*placed->sites, found, ImagesFor::cells, session->session.device(),
                                  session->threads));
    MemoryPlan plan = begun(*input, *placed, work);
    planCells(plan, work, found.detail);
    takePlanePositions(plan, *placed, found.detail);
    *bytes = plan.peak();
    return vorpipe_code{VORPIPE_DONE};
  });
}

vorpipe_code vorpipe_render_memory(const vorpipe_session* session, const vorpipe_input* input,
                                   const vorpipe_render_options* options, uint64_t* bytes) {
  VORPIPE_NEEDS(session, input, bytes);
  return guarded([&] {
    VORPIPE_TAKE(placed, placedInput(*input));
    VORPIPE_TAKE(picture, renderOptions(*placed, options));
    VORPIPE_TAKE(work, workloadOf(*placed->sites, cellsOptions(picture), imagesFor(picture),
                                  session->session.device(), session->threads));
    MemoryPlan plan = begun(*input, *placed, work);
    planPicture(plan, work, picture);
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

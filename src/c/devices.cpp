/// Devices and sessions.
#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "c/failure.h"
#include "c/handles.h"
#include "c/options.h"
#include "c/structs.h"
#include "io/base/error.h"

namespace vorpipe::c {
namespace {

Result<BackendOptions> backendOptions(const vorpipe_session_options* given) {
  const auto options = taken(given, "vorpipe_session_options");
  if (!options) return tl::unexpected(options.error());
  auto mask = maskOf(options->disabled_count, options->disabled, options->limit_count, options->limits);
  if (!mask) return tl::unexpected(mask.error());
  if (options->threads < 0) return inputError(fmt::format("threads: is {}", options->threads));
  BackendOptions backend;
  if (options->backend != nullptr) backend.name = options->backend;
  if (options->device != nullptr) backend.device = options->device;
  const auto known = backendNames();
  if (std::ranges::find(known, backend.name) == known.end()) {
    return inputError(fmt::format("backend: no backend {}", backend.name));
  }
  backend.threads = options->threads;
  backend.mask = std::move(*mask);
  backend.validation = options->validation != 0;
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

}  // namespace
}  // namespace vorpipe::c

using namespace vorpipe::c;

vorpipe_code vorpipe_devices_find(const vorpipe_session_options* options, vorpipe_devices** devices) {
  if (devices == nullptr) return missing("devices");
  return guarded([&] {
    const auto backend = backendOptions(options);
    if (!backend) return fail(backend.error());
    *devices = new vorpipe_devices{vorpipe::devices(backend->mask)};
    return vorpipe_code{VORPIPE_DONE};
  });
}

void vorpipe_devices_free(vorpipe_devices* devices) { delete devices; }

size_t vorpipe_devices_count(const vorpipe_devices* devices) {
  return devices == nullptr ? 0 : devices->infos.size();
}

vorpipe_code vorpipe_devices_get(const vorpipe_devices* devices, size_t index, vorpipe_device_info* info) {
  if (devices == nullptr) return missing("devices");
  if (info == nullptr) return missing("info");
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
  if (devices == nullptr) return missing("devices");
  if (limit == nullptr) return missing("limit");
  if (value == nullptr) return missing("value");
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
  if (session == nullptr) return missing("session");
  return guarded([&] {
    const auto backend = backendOptions(options);
    if (!backend) return fail(backend.error());
    auto opened = vorpipe::Session::open(*backend);
    if (!opened) return fail(opened.error());
    *session = new vorpipe_session{std::move(*opened), backend->threads};
    return vorpipe_code{VORPIPE_DONE};
  });
}

void vorpipe_session_free(vorpipe_session* session) { delete session; }

vorpipe_code vorpipe_session_device(const vorpipe_session* session, vorpipe_device_info* info) {
  if (session == nullptr) return missing("session");
  if (info == nullptr) return missing("info");
  return guarded(
      [&] { return codeOf(give(infoOf(session->session.device()), info, "vorpipe_device_info")); });
}

const char* vorpipe_session_choice(const vorpipe_session* session) {
  return session == nullptr ? "" : session->session.choice().c_str();
}

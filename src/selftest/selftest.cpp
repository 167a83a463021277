#include "vorpipe/selftest.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <memory>
#include <new>
#include <utility>

#include "base/stopwatch.h"
#include "base/try.h"
#include "base/words.h"
#include "selftest/run_scenes.h"

namespace vorpipe {
namespace selftests {
namespace {

class SessionRuns final : public Runs {
 public:
  explicit SessionRuns(Session session) : session_(std::move(session)) {}

  Result<Rendering> render(const Sites& sites, const RenderOptions& options) override {
    return session_.render(sites, options);
  }
  Result<Diagram> cells(const Sites& sites, const CellsOptions& options) override {
    return session_.cells(sites, options);
  }
  Result<Arithmetic> arithmetic() override { return session_.arithmetic(); }

 private:
  Session session_;
};

/// The runs of a session opened with `options`; masks add their limits to the options' own.
OpenRuns sessionRuns(const BackendOptions& options) {
  return [options](const Mask& mask) -> Result<std::unique_ptr<Runs>> {
    BackendOptions masked = options;
    auto& limits = masked.mask.limits;
    limits.insert(limits.end(), mask.limits.begin(), mask.limits.end());
    VORPIPE_VAR(session, Session::open(masked));
    return std::make_unique<SessionRuns>(std::move(session));
  };
}

/// The name of the backend that `auto` and `vulkan` stand for here; any other name as it is.
Result<std::string> backendNamed(const SelftestOptions& options) {
  if (options.backend != "auto" && options.backend != "vulkan") return options.backend;
  BackendOptions chosen;
  chosen.name = options.backend;
  chosen.device = options.device;
  chosen.threads = options.threads;
  chosen.mask = options.mask;
  VORPIPE_LET(session, Session::open(chosen));
  return session.device().backend;
}

/// The devices that the options name. Errors (device): there is none, or the options name some and none is
/// usable.
Result<std::vector<SelftestDevice>> namedDevices(const SelftestOptions& options) {
  const auto names = backendNames();
  if (!options.backend.empty() && std::ranges::find(names, options.backend) == names.end()) {
    return tl::unexpected(Error{
        ErrorCode::input, fmt::format("there is no backend \"{}\"; see vorpipe devices", options.backend)});
  }
  VORPIPE_LET(backend, backendNamed(options));
  std::vector<SelftestDevice> named;
  std::map<std::string, int> next;
  for (DeviceInfo& info : devices(options.mask)) {
    SelftestDevice device;
    if (!info.name.empty()) device.index = next[info.backend]++;
    device.info = std::move(info);
    const bool wanted = backend.empty() || device.info.backend == backend;
    if (wanted && device.isNamed(options.device)) named.push_back(std::move(device));
  }
  const bool any_usable = std::ranges::any_of(named, [](const auto& device) { return device.info.usable; });
  if (any_usable) return named;
  if (named.empty()) {
    return tl::unexpected(
        Error{ErrorCode::device, fmt::format("there is no device '{}'{}; see vorpipe devices", options.device,
                                             backend.empty() ? "" : " of " + backend)});
  }
  return tl::unexpected(Error{ErrorCode::device, named.front().info.reason});
}

/// Options for opening a device: with validation, unless validation prevents that.
BackendOptions optionsOf(SelftestDevice& device, const SelftestOptions& options) {
  BackendOptions opened;
  opened.name = device.info.backend;
  opened.device = std::to_string(device.index);
  opened.threads = options.threads;
  opened.mask = options.mask;
  opened.waiting = options.waiting;
  if (!device.info.backend.starts_with("vulkan")) return opened;
  opened.validation = true;
  const auto with = Session::open(opened);
  device.validated = with.has_value();
  if (!with) {
    device.not_validated = with.error().message;
    opened.validation = false;
  }
  return opened;
}

Result<SelftestReport> run(const SelftestOptions& options) {
  const Stopwatch watch;
  SelftestReport report;
  report.seed = options.seed;
  report.quick = options.quick;
  VORPIPE_VAR(named, namedDevices(options));
  report.devices = std::move(named);
  std::vector<Tested> tested;
  for (std::size_t i = 0; i < report.devices.size(); i++) {
    SelftestDevice& device = report.devices[i];
    if (!device.info.usable) continue;
    const bool is_cpu = device.info.backend == "cpu";
    tested.push_back({i, sessionRuns(optionsOf(device, options)), is_cpu, !is_cpu});
  }
  BackendOptions reference;
  reference.name = "cpu";
  reference.threads = options.threads;
  VORPIPE_TRY(runScenes(sceneKinds(), tested, sessionRuns(reference), options, report));
  report.milliseconds = watch.milliseconds();
  return report;
}

}  // namespace
}  // namespace selftests

bool SelftestDevice::passed() const {
  return arithmetic_fault.empty() && std::ranges::all_of(runs, &SelftestRun::passed);
}

bool SelftestDevice::isNamed(std::string_view device) const {
  if (device.empty()) return true;
  return index >= 0 && isIndexOrPartOf(device, static_cast<std::size_t>(index), info.name);
}

bool SelftestReport::passed() const { return std::ranges::all_of(devices, &SelftestDevice::passed); }

Result<SelftestReport> selftest(const SelftestOptions& options) {
  try {
    return selftests::run(options);
  } catch (const std::bad_alloc&) {
    return tl::unexpected(Error{ErrorCode::device, "out of memory; --quick has smaller scenes"});
  }
}

}  // namespace vorpipe

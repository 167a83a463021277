/// The built-in test: every backend and device of the machine, compared with `cpu`.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vorpipe/devices.h"
#include "vorpipe/result.h"
#include "vorpipe/run.h"

namespace vorpipe {

/// Result of one scene on one device.
struct SelftestRun {
  std::string group, scene;  ///< "crowds", "1e-11 wide"
  std::string masked;        ///< features or limits masked on the device, as in "subPixelPrecisionBits=4"
  std::uint64_t sites = 0;   ///< their number
  std::uint64_t seed = 0;    ///< of the scene's random numbers
  double milliseconds = 0;   ///< of the device's own runs, picture and cells, without judging them
  std::vector<std::string> notes;  ///< from its reports: the device refused memory and got smaller parts
  std::string fault;               ///< the first promise that was broken, in one line; empty if none
  [[nodiscard]] bool passed() const { return fault.empty(); }
};

/// One device of one backend.
struct SelftestDevice {
  DeviceInfo info;  ///< masked as the options specify; an unusable one was not tested
  int index = -1;   ///< as for --device; negative if a backend has no device
  bool validated = false;
  std::string not_validated;  ///< reason; empty if it was validated, and for backends without validation
  std::vector<SelftestRun> runs;
  std::optional<Arithmetic> arithmetic;
  std::string arithmetic_fault;  ///< what in it exceeds vorpipe's bounds, or why it is unknown
  [[nodiscard]] bool passed() const;
  /// Whether `device`, as in SelftestOptions, names it.
  [[nodiscard]] bool isNamed(std::string_view device) const;
};

struct SelftestReport {
  std::uint64_t seed = 0;
  bool quick = false;
  std::vector<SelftestDevice> devices;
  double milliseconds = 0;
  /// Whether no promise was broken on any device that could be tested.
  [[nodiscard]] bool passed() const;
};

struct SelftestOptions {
  std::string backend;  ///< one of backendNames(); empty: all
  std::string device;   ///< an index, or a part of a name; empty: all
  bool quick = false;   ///< fewer and smaller scenes
  std::uint64_t seed = 1;
  int threads = 0;  ///< CPU threads; 0: all
  Mask mask;        ///< for all runs; some runs lower more limits
  Progress progress;
  Waiting waiting;  ///< called when a pipeline takes seconds; see BackendOptions::waiting
  /// Called with the results so far: once before the first scene, then after each group of scenes.
  std::function<void(const SelftestReport&, std::string_view group)> group_done;
};

/// The largest errors of float arithmetic that vorpipe tolerates, in ULP: those that Vulkan allows. A root
/// may be computed as 1 divided by an inverse root.
inline constexpr double allowed_quotient = 2.5, allowed_inverse_root = 2, allowed_root = 6.5;
inline constexpr double allowed_rounding = 1;  ///< of products, sums and differences
/// The fewest subpixel bits that vertices may be snapped to.
inline constexpr int allowed_subpixel_bits = 4;

/// Runs built-in scenes, pictures and cells, on each device that the options name. Compares both with the
/// results of `cpu` and verifies them by check(); `cpu` itself is verified only by check(). Validation layers
/// are on where available. The report lists the faults of devices. Errors: an unknown backend (input); no
/// such backend or device here (device); progress asked to stop.
Result<SelftestReport> selftest(const SelftestOptions& options);

}  // namespace vorpipe

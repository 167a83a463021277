/// The test that the program brings along: every backend and device of the machine it runs on, judged by
/// `cpu`.
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

/// What became of one scene on one device.
struct SelftestRun {
  std::string group, scene;        ///< "crowds", "1e-11 wide"
  std::string masked;              ///< what the device was made to lack, as in "subPixelPrecisionBits=4"
  std::uint64_t sites = 0;         ///< their number
  std::uint64_t seed = 0;          ///< of the scene's random numbers
  double milliseconds = 0;         ///< of the device's own runs, picture and cells, not of judging them
  std::vector<std::string> notes;  ///< of its reports: the device refused memory and got less at a time
  std::string fault;               ///< the first promise that was broken, in one line; empty if none
  [[nodiscard]] bool passed() const { return fault.empty(); }
};

/// One device of one backend.
struct SelftestDevice {
  DeviceInfo info;  ///< masked as the options say; one that is not usable was not tested
  int index = -1;   ///< as --device takes it; negative where a backend has no device
  bool validated = false;
  std::string not_validated;  ///< why; empty where it was, and for backends that have no validation
  std::vector<SelftestRun> runs;
  std::optional<Arithmetic> arithmetic;
  std::string arithmetic_fault;  ///< what of it is worse than vorpipe's bounds allow, or why it is not known
  [[nodiscard]] bool passed() const;
};

struct SelftestReport {
  std::uint64_t seed = 0;
  bool quick = false;
  std::vector<SelftestDevice> devices;
  double milliseconds = 0;
  /// No promise was broken, on any device that could be tested.
  [[nodiscard]] bool passed() const;
};

struct SelftestOptions {
  std::string backend;  ///< one of backendNames(); empty: all
  std::string device;   ///< an index, or a part of a name; empty: all
  bool quick = false;   ///< fewer and smaller scenes
  std::uint64_t seed = 1;
  int threads = 0;  ///< CPU threads; 0: all
  Mask mask;        ///< for all runs; some lower more limits
  Progress progress;
  Waiting waiting;  ///< told when a pipeline takes seconds; BackendOptions::waiting
  /// Called with what is known so far: once before the first scene, then after each group of scenes.
  std::function<void(const SelftestReport&, std::string_view group)> group_done;
};

/// The largest errors of float arithmetic that vorpipe is made for, in ULP: those that Vulkan allows. A root
/// may be computed as 1 divided by an inverse root.
inline constexpr double allowed_quotient = 2.5, allowed_inverse_root = 2, allowed_root = 6.5;
inline constexpr double allowed_rounding = 1;  ///< of products, sums and differences
/// The fewest bits of a place inside a pixel that vertices may be snapped to.
inline constexpr int allowed_subpixel_bits = 4;

/// Runs scenes of its own on each device that the options name, pictures and cells, and compares both with
/// those of `cpu`, and with what check() verifies; `cpu` itself is held to check() alone. Validation layers
/// are on where they are. What is wrong with a device is in the report. Errors: an unknown backend (input);
/// no such backend or device here (device); the progress said stop.
Result<SelftestReport> selftest(const SelftestOptions& options);

}  // namespace vorpipe

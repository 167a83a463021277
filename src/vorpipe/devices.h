/// Backends and their devices.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vorpipe/run.h"

namespace vorpipe {

/// Pretends that a device lacks features or has smaller limits, by their Vulkan names
/// (`geometryShader`; `maxTexelBufferElements`). A limit can only be lowered.
struct Mask {
  std::vector<std::string> disabled;
  std::vector<std::pair<std::string, std::uint64_t>> limits;
};

/// The names that BackendOptions::name takes.
std::vector<std::string> backendNames();

/// The names of features and of limits that a Mask takes.
std::vector<std::string> featureNames();
std::vector<std::string> limitNames();

/// Called from any thread, with one line, when a run has waited for something for seconds.
using Waiting = std::function<void(std::string_view what)>;

struct BackendOptions {
  std::string name = "auto";  ///< auto, vulkan, vulkan-geometry, vulkan-compute, opengl, cpu
  std::string device;         ///< empty: the best; else an index, or a part of a name, as in devices()
  int threads = 0;            ///< CPU threads; 0: all
  Mask mask;
  bool validation = false;  ///< Vulkan validation layers, core and synchronization
  Waiting waiting{};        ///< null: no reports
};

/// One device of one backend, usable or not.
struct DeviceInfo {
  std::string backend, name, driver;
  std::string type;  ///< discrete, integrated, virtual, cpu, other
  bool usable = false;
  std::string reason;  ///< why it is unusable, and what would help; empty if usable
  /// Other drivers were searched for hardware before this device was chosen; they stay loaded in the process.
  bool beside_drivers = false;
  std::vector<std::pair<std::string, bool>> features;
  std::vector<std::pair<std::string, std::uint64_t>> limits;
};

/// How a device rounds, as measured on it. Errors are the largest found, in units in the last place (ULP) of
/// the exact result; exact rounding gives 0.5.
struct Arithmetic {
  double quotient = 0, root = 0, inverse_root = 0, product = 0, sum = 0;
  double offset =
      0;  ///< of (a - b) + (c - d), declared precise: the smallest separation of sites depends on it
  bool fuses = false;           ///< rounds a b + c only once, where that is allowed
  bool fuses_precise = false;   ///< rounds it only once even where that is forbidden
  bool keeps_denormals = true;  ///< numbers below 2^-126; if false, they become 0
  /// Vertices are snapped to 1 / 2^bits of a pixel. most_subpixel_bits means that many or more; 0 means that
  /// the measured places make no sense. None if pictures are computed instead of drawn, or views are too
  /// small to measure it.
  std::optional<int> subpixel_bits;
  Report report;  ///< which backend and device measured it, and messages of the validation layers
};

inline constexpr int most_subpixel_bits = 10;

/// Every backend with its devices; a backend without devices has one entry that gives the reason.
std::vector<DeviceInfo> devices(const Mask& mask);

}  // namespace vorpipe

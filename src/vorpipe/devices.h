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

/// Called from any thread with what a run has been waiting for, for seconds: one line.
using Waiting = std::function<void(std::string_view what)>;

struct BackendOptions {
  std::string name = "auto";  ///< auto, vulkan, vulkan-geometry, vulkan-compute, opengl, cpu
  std::string device;         ///< empty: the best; else an index or a part of a name, as devices() lists
  int threads = 0;            ///< CPU threads; 0: all
  Mask mask;
  bool validation = false;  ///< Vulkan validation layers, core and synchronization
  Waiting waiting{};        ///< null: nobody is told
};

/// One device of one backend, usable or not.
struct DeviceInfo {
  std::string backend, name, driver;
  std::string type;  ///< discrete, integrated, virtual, cpu, other
  bool usable = false;
  std::string reason;  ///< why it cannot be used, and what would help; empty when usable
  /// Drivers that were looked through for hardware before this was taken: they stay in the process.
  bool beside_drivers = false;
  std::vector<std::pair<std::string, bool>> features;
  std::vector<std::pair<std::string, std::uint64_t>> limits;
};

/// How a device rounds, as measured on it. Errors are the largest that were found, in units in the last place
/// (ULP) of the exact result; exactly rounded is 0.5.
struct Arithmetic {
  double quotient = 0, root = 0, inverse_root = 0, product = 0, sum = 0;
  double offset = 0;            ///< of (a - b) + (c - d), declared precise: by this far sites are told apart
  bool fuses = false;           ///< rounds a b + c once, where it may
  bool fuses_precise = false;   ///< and where it must not
  bool keeps_denormals = true;  ///< numbers below 2^-126; else they are 0
  /// Vertices are snapped to 1 / 2^bits of a pixel; most_subpixel_bits stand for any more, and 0 for places
  /// that make no sense. None where pictures are not drawn but computed, or views are too small to tell.
  std::optional<int> subpixel_bits;
  Report report;  ///< who measured it, and what the validation layers said
};

inline constexpr int most_subpixel_bits = 10;

/// Every backend with its devices; a backend without any has one entry that says why.
std::vector<DeviceInfo> devices(const Mask& mask);

}  // namespace vorpipe

/// Backends and their devices.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

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

struct BackendOptions {
  std::string name = "auto";  ///< auto, vulkan, vulkan-geometry, vulkan-compute, opengl, cpu
  std::string device;         ///< empty: the best; else an index or a part of a name, as devices() lists
  int threads = 0;            ///< CPU threads; 0: all
  Mask mask;
  bool validation = false;  ///< Vulkan validation layers, core and synchronization
};

/// One device of one backend, usable or not.
struct DeviceInfo {
  std::string backend, name, driver;
  std::string type;  ///< discrete, integrated, virtual, cpu, other
  bool usable = false;
  std::string reason;  ///< why it cannot be used, and what would help; empty when usable
  std::vector<std::pair<std::string, bool>> features;
  std::vector<std::pair<std::string, std::uint64_t>> limits;
};

/// Every backend with its devices; a backend without any has one entry that says why.
std::vector<DeviceInfo> devices(const Mask& mask);

}  // namespace vorpipe

/// A Vulkan driver that fails, forgets or lies at will, between the program and the real one.
#pragma once

#include <volk.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <random>
#include <set>
#include <string>
#include <string_view>

namespace vorpipe::test {

/// While one lives, every device that is opened goes through it. Its members may change at any time.
class FaultyDriver {
 public:
  FaultyDriver();
  ~FaultyDriver();
  FaultyDriver(const FaultyDriver&) = delete;
  FaultyDriver& operator=(const FaultyDriver&) = delete;

  /// The call that answers `failure` instead of being made, counted from 1; 0: none. Only calls that can fail
  /// are counted.
  int failing_call = 0;
  VkResult failure = VK_ERROR_OUT_OF_DEVICE_MEMORY;

  /// The submission, or wait for one, at which its device is lost, counted from 1 over all devices; 0: none.
  /// A lost device stays lost.
  int losing_call = 0;
  /// Then all others are lost as well, those that are opened later too.
  bool loses_all = false;

  /// In bytes; larger allocations are refused.
  VkDeviceSize largest_allocation = ~VkDeviceSize{0};

  /// Whether what devices wrote for the host is replaced by numbers of `lies` when the host has waited for
  /// it.
  bool lies_to_host = false;
  /// Whether buffers that are storage and nothing else are for the host: those of the backend
  /// vulkan-geometry.
  bool storage_is_for_host = false;
  std::mt19937_64 lies;

  int calls = 0;        ///< that could fail
  int submissions = 0;  ///< and waits for them
  int refused = 0;      ///< allocations
  int lied = 0;         ///< buffers
  int alive = 0;        ///< objects that were made and not destroyed

  /// The functions of Vulkan that are made to fail, and whether one cannot.
  static std::set<std::string> canFail();
  static bool cannotFail(std::string_view name);

  // What the functions in between use.
  VkResult beforeCall();
  bool isLostNow(VkDevice device);
  void noteBuffer(VkBuffer buffer, const VkBufferCreateInfo& info);
  void noteMemory(VkBuffer buffer, VkDeviceMemory memory);
  void noteMapping(VkDeviceMemory memory, void* bytes);
  void forgetMemory(VkDeviceMemory memory);
  void forgetDevice(VkDevice device);
  void lie();
  std::recursive_mutex mutex;

 private:
  struct Mapped {
    std::uint32_t* words = nullptr;
    std::size_t count = 0;
    bool for_host = false;
  };

  PFN_vkGetInstanceProcAddr real_;
  std::set<VkDevice> lost_;
  std::map<VkBuffer, Mapped> buffers_;
  std::map<VkDeviceMemory, Mapped> memory_;
};

}  // namespace vorpipe::test

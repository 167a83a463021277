/// How long a device works on what it is given, by its own clock.
#pragma once

#include <volk.h>

#include <cstdint>

#include "backend/vulkan/handle.h"
#include "backend/vulkan/physical.h"

namespace vorpipe::vulkan {

class Clock {
 public:
  /// Tells nothing until it is replaced.
  Clock() = default;

  /// The clock of an opened device's queue; one that tells nothing if the queue has no timestamps.
  static Result<Clock> create(const Physical& physical, VkDevice device, const VolkDeviceTable& api);

  /// Records, into commands that are submitted once, that work begins and that all of it is done.
  void begin(const VolkDeviceTable& api, VkCommandBuffer commands) const;
  void end(const VolkDeviceTable& api, VkCommandBuffer commands) const;
  /// Adds what lay between, once the commands are done.
  Result<void> take(VkDevice device, const VolkDeviceTable& api);

  /// What was added so far; negative if this tells nothing.
  [[nodiscard]] double seconds() const { return pool_ ? seconds_ : -1; }

 private:
  Handle<VkQueryPool> pool_;  ///< two timestamps
  std::uint64_t valid_ = 0;   ///< the bits of one that count
  double seconds_per_tick_ = 0;
  double seconds_ = 0;
};

}  // namespace vorpipe::vulkan

/// Measures how long a device works, by its own clock.
#pragma once

#include <volk.h>

#include <cstdint>

#include "backend/vulkan/handle.h"
#include "backend/vulkan/physical.h"

namespace vorpipe::vulkan {

class Clock {
 public:
  /// Measures nothing until it is replaced.
  Clock() = default;

  /// Returns the clock of an opened device's queue; it measures nothing if the queue has no timestamps.
  static Result<Clock> create(const Physical& physical, VkDevice device, const VolkDeviceTable& api);

  /// Record the beginning and the end of all work into commands that are submitted once.
  void begin(const VolkDeviceTable& api, VkCommandBuffer commands) const;
  void end(const VolkDeviceTable& api, VkCommandBuffer commands) const;
  /// Adds the time between the two, once the commands are done.
  Result<void> take(VkDevice device, const VolkDeviceTable& api);

  /// Returns the time added so far; negative if this measures nothing.
  [[nodiscard]] double seconds() const { return pool_ ? seconds_ : -1; }

 private:
  Handle<VkQueryPool> pool_;  ///< two timestamps
  std::uint64_t valid_ = 0;   ///< the valid bits of a timestamp
  double seconds_per_tick_ = 0;
  double seconds_ = 0;
};

}  // namespace vorpipe::vulkan

/// The connection to the Vulkan loader, with or without validation.
#pragma once

#include <volk.h>

#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::vulkan {

/// Messages of the validation layers, which may come from any thread that calls Vulkan.
class MessageLog {
 public:
  void add(std::string message);
  /// The messages since the last call.
  std::vector<std::string> take();

 private:
  std::mutex mutex_;
  std::vector<std::string> messages_;
};

class Instance {
 public:
  /// Loads Vulkan 1.1. With validation, core and synchronization validation are on and every warning and
  /// error goes to messages(). `extensions` are enabled as well, for callers that show what they draw. Errors
  /// (device): no loader, no driver, no layer, no such extension.
  static Result<Instance> open(bool validation, std::span<const char* const> extensions = {});
  Instance(Instance&& other) noexcept;
  Instance& operator=(Instance&& other) noexcept;
  ~Instance();

  [[nodiscard]] VkInstance handle() const { return instance_; }
  [[nodiscard]] MessageLog& messages() const { return *log_; }

 private:
  Instance() = default;
  void close();

  std::unique_ptr<MessageLog> log_ = std::make_unique<MessageLog>();
  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
};

}  // namespace vorpipe::vulkan

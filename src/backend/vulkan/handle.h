/// A Vulkan object of a device that is destroyed with its owner.
#pragma once

#include <volk.h>

#include <string_view>
#include <utility>

#include "backend/vulkan/error.h"

namespace vorpipe::vulkan {

/// A structure of a given type, zero otherwise.
template <class T>
constexpr T structure(VkStructureType type) {
  T zero{};
  zero.sType = type;
  return zero;
}

template <class T>
class Handle {
 public:
  using Destroy = void(VKAPI_PTR*)(VkDevice, T, const VkAllocationCallbacks*);

  Handle() = default;
  Handle(VkDevice device, T object, Destroy destroy) : device_(device), object_(object), destroy_(destroy) {}
  Handle(Handle&& other) noexcept
      : device_(other.device_),
        object_(std::exchange(other.object_, T(VK_NULL_HANDLE))),
        destroy_(other.destroy_) {}
  Handle& operator=(Handle&& other) noexcept {
    if (this != &other) {
      reset();
      device_ = other.device_;
      object_ = std::exchange(other.object_, T(VK_NULL_HANDLE));
      destroy_ = other.destroy_;
    }
    return *this;
  }
  ~Handle() { reset(); }

  [[nodiscard]] T get() const { return object_; }
  explicit operator bool() const { return object_ != T(VK_NULL_HANDLE); }

 private:
  void reset() {
    if (object_ != T(VK_NULL_HANDLE)) destroy_(device_, object_, nullptr);
    object_ = T(VK_NULL_HANDLE);
  }

  VkDevice device_ = VK_NULL_HANDLE;
  T object_ = T(VK_NULL_HANDLE);
  Destroy destroy_ = nullptr;
};

/// Creates an object by one of the vkCreate functions and pairs it with its vkDestroy.
template <class T, class Info>
Result<Handle<T>> create(VkDevice device,
                         VkResult(VKAPI_PTR* make)(VkDevice, const Info*, const VkAllocationCallbacks*, T*),
                         typename Handle<T>::Destroy destroy, const Info& info, std::string_view call) {
  T object = T(VK_NULL_HANDLE);
  VORPIPE_TRY(check(make(device, &info, nullptr, &object), call));
  return Handle<T>(device, object, destroy);
}

}  // namespace vorpipe::vulkan

#include "faulty_device.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>
#include <span>
#include <string_view>
#include <utility>

#include "backend/vulkan/instance.h"

namespace vorpipe::test {
namespace {

FaultyDriver* driver = nullptr;
PFN_vkGetDeviceProcAddr real_device_proc = nullptr;

// The loader's own functions, which volk keeps from its first use on.
PFN_vkCreateInstance real_create_instance = nullptr;
PFN_vkEnumerateInstanceExtensionProperties real_instance_extensions = nullptr;
PFN_vkEnumerateInstanceLayerProperties real_instance_layers = nullptr;
PFN_vkDestroyInstance real_destroy_instance = nullptr;

VKAPI_ATTR VkResult VKAPI_CALL createInstance(const VkInstanceCreateInfo* info,
                                              const VkAllocationCallbacks* how, VkInstance* instance) {
  VkResult result = driver->beforeCall();
  if (result == VK_SUCCESS) result = real_create_instance(info, how, instance);
  const std::lock_guard lock(driver->mutex);
  if (result == VK_SUCCESS) driver->alive++;
  return result;
}

VKAPI_ATTR VkResult VKAPI_CALL instanceExtensions(const char* layer, std::uint32_t* count,
                                                  VkExtensionProperties* extensions) {
  const VkResult result = driver->beforeCall();
  return result == VK_SUCCESS ? real_instance_extensions(layer, count, extensions) : result;
}

VKAPI_ATTR VkResult VKAPI_CALL instanceLayers(std::uint32_t* count, VkLayerProperties* layers) {
  const VkResult result = driver->beforeCall();
  return result == VK_SUCCESS ? real_instance_layers(count, layers) : result;
}

VKAPI_ATTR void VKAPI_CALL destroyInstance(VkInstance instance, const VkAllocationCallbacks* how) {
  if (driver != nullptr) {
    const std::lock_guard lock(driver->mutex);
    driver->alive--;
  }
  real_destroy_instance(instance, how);
}

/// Stands in for function number `Which` of a device, of any kind that can fail.
template <std::size_t Which, class Function>
struct FailingCall;

template <std::size_t Which, class... Args>
struct FailingCall<Which, VkResult(VKAPI_PTR*)(Args...)> {
  static inline VkResult(VKAPI_PTR* real)(Args...) = nullptr;
  static VKAPI_ATTR VkResult VKAPI_CALL call(Args... args) {
    const VkResult result = driver->beforeCall();
    return result == VK_SUCCESS ? real(args...) : result;
  }
};

/// The same for what makes an object, which comes last.
template <std::size_t Which, class Function>
struct CreatingCall;

template <std::size_t Which, class... Args>
struct CreatingCall<Which, VkResult(VKAPI_PTR*)(Args...)> {
  static inline VkResult(VKAPI_PTR* real)(Args...) = nullptr;
  static VKAPI_ATTR VkResult VKAPI_CALL call(Args... args) {
    VkResult result = driver->beforeCall();
    if (result == VK_SUCCESS) result = real(args...);
    const std::lock_guard lock(driver->mutex);
    if (result == VK_SUCCESS) driver->alive++;
    return result;
  }
};

template <std::size_t Which, class Function>
struct DestroyingCall;

template <std::size_t Which, class Owner, class Object>
struct DestroyingCall<Which, void(VKAPI_PTR*)(Owner, Object, const VkAllocationCallbacks*)> {
  static inline void(VKAPI_PTR* real)(Owner, Object, const VkAllocationCallbacks*) = nullptr;
  static VKAPI_ATTR void VKAPI_CALL call(Owner owner, Object object, const VkAllocationCallbacks* how) {
    if (object != Object(VK_NULL_HANDLE)) {
      const std::lock_guard lock(driver->mutex);
      driver->alive--;
      if constexpr (std::is_same_v<Object, VkDeviceMemory>) driver->forgetMemory(object);
    }
    real(owner, object, how);
  }
};

PFN_vkQueueSubmit real_submit = nullptr;
PFN_vkWaitForFences real_wait = nullptr;
PFN_vkGetDeviceQueue real_get_queue = nullptr;
PFN_vkDestroyDevice real_destroy_device = nullptr;
PFN_vkAllocateMemory real_allocate = nullptr;
PFN_vkCreateBuffer real_create_buffer = nullptr;
PFN_vkBindBufferMemory real_bind = nullptr;
PFN_vkMapMemory real_map = nullptr;
std::map<VkQueue, VkDevice> device_of;

VKAPI_ATTR void VKAPI_CALL getQueue(VkDevice device, std::uint32_t family, std::uint32_t index,
                                    VkQueue* queue) {
  real_get_queue(device, family, index, queue);
  const std::lock_guard lock(driver->mutex);
  device_of[*queue] = device;
}

VKAPI_ATTR void VKAPI_CALL destroyDevice(VkDevice device, const VkAllocationCallbacks* how) {
  if (driver != nullptr) {
    const std::lock_guard lock(driver->mutex);
    driver->forgetDevice(device);
    driver->alive--;
  }
  real_destroy_device(device, how);
}

VKAPI_ATTR VkResult VKAPI_CALL submit(VkQueue queue, std::uint32_t count, const VkSubmitInfo* infos,
                                      VkFence fence) {
  const std::lock_guard lock(driver->mutex);
  if (driver->isLostNow(device_of[queue])) return VK_ERROR_DEVICE_LOST;
  const VkResult result = driver->beforeCall();
  return result == VK_SUCCESS ? real_submit(queue, count, infos, fence) : result;
}

// A wait that fails returns while the device is still at work.
VKAPI_ATTR VkResult VKAPI_CALL wait(VkDevice device, std::uint32_t count, const VkFence* fences, VkBool32 all,
                                    std::uint64_t timeout) {
  {
    const std::lock_guard lock(driver->mutex);
    if (driver->isLostNow(device)) return VK_ERROR_DEVICE_LOST;
    const VkResult result = driver->beforeCall();
    if (result != VK_SUCCESS) return result;
  }
  const VkResult result = real_wait(device, count, fences, all, timeout);
  const std::lock_guard lock(driver->mutex);
  if (driver->lies_to_host) driver->lie();
  return result;
}

VKAPI_ATTR VkResult VKAPI_CALL allocateMemory(VkDevice device, const VkMemoryAllocateInfo* info,
                                              const VkAllocationCallbacks* how, VkDeviceMemory* memory) {
  {
    const std::lock_guard lock(driver->mutex);
    if (info->allocationSize > driver->largest_allocation) {
      driver->refused++;
      return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    }
  }
  VkResult result = driver->beforeCall();
  if (result == VK_SUCCESS) result = real_allocate(device, info, how, memory);
  const std::lock_guard lock(driver->mutex);
  if (result == VK_SUCCESS) driver->alive++;
  return result;
}

VKAPI_ATTR VkResult VKAPI_CALL createBuffer(VkDevice device, const VkBufferCreateInfo* info,
                                            const VkAllocationCallbacks* how, VkBuffer* buffer) {
  VkResult result = driver->beforeCall();
  if (result == VK_SUCCESS) result = real_create_buffer(device, info, how, buffer);
  const std::lock_guard lock(driver->mutex);
  if (result == VK_SUCCESS) driver->alive++;
  if (result == VK_SUCCESS) driver->noteBuffer(*buffer, *info);
  return result;
}

VKAPI_ATTR VkResult VKAPI_CALL bindBuffer(VkDevice device, VkBuffer buffer, VkDeviceMemory memory,
                                          VkDeviceSize offset) {
  VkResult result = driver->beforeCall();
  if (result == VK_SUCCESS) result = real_bind(device, buffer, memory, offset);
  const std::lock_guard lock(driver->mutex);
  if (result == VK_SUCCESS) driver->noteMemory(buffer, memory);
  return result;
}

VKAPI_ATTR VkResult VKAPI_CALL mapMemory(VkDevice device, VkDeviceMemory memory, VkDeviceSize offset,
                                         VkDeviceSize size, VkMemoryMapFlags flags, void** data) {
  VkResult result = driver->beforeCall();
  if (result == VK_SUCCESS) result = real_map(device, memory, offset, size, flags, data);
  const std::lock_guard lock(driver->mutex);
  if (result == VK_SUCCESS) driver->noteMapping(memory, *data);
  return result;
}

template <template <std::size_t, class> class Kind, std::size_t Which, class Function>
PFN_vkVoidFunction instead(PFN_vkVoidFunction real) {
  Kind<Which, Function>::real = reinterpret_cast<Function>(real);
  return reinterpret_cast<PFN_vkVoidFunction>(&Kind<Which, Function>::call);
}

template <class Function>
PFN_vkVoidFunction insteadOf(PFN_vkVoidFunction found, Function& real, Function call) {
  real = reinterpret_cast<Function>(found);
  return reinterpret_cast<PFN_vkVoidFunction>(call);
}

#define VORPIPE_FAILING(name) \
  { #name, &instead < FailingCall, __LINE__, PFN_##name> }
#define VORPIPE_MAKING(name) \
  { #name, &instead < CreatingCall, __LINE__, PFN_##name> }
#define VORPIPE_DESTROYING(name) \
  { #name, &instead < DestroyingCall, __LINE__, PFN_##name> }

struct Replaced {
  std::string_view name;
  PFN_vkVoidFunction (*instead)(PFN_vkVoidFunction);
};

// Every function by which a backend makes, destroys or does something on a device, but for those above.
constexpr Replaced functions[] = {
    VORPIPE_FAILING(vkAcquireNextImageKHR),
    VORPIPE_FAILING(vkAllocateCommandBuffers),
    VORPIPE_FAILING(vkAllocateDescriptorSets),
    VORPIPE_FAILING(vkBeginCommandBuffer),
    VORPIPE_FAILING(vkBindImageMemory),
    VORPIPE_FAILING(vkDeviceWaitIdle),
    VORPIPE_FAILING(vkEndCommandBuffer),
    VORPIPE_FAILING(vkGetQueryPoolResults),
    VORPIPE_FAILING(vkGetSwapchainImagesKHR),
    VORPIPE_FAILING(vkQueuePresentKHR),
    VORPIPE_FAILING(vkResetCommandPool),
    VORPIPE_FAILING(vkResetFences),
    VORPIPE_MAKING(vkCreateBufferView),
    VORPIPE_MAKING(vkCreateCommandPool),
    VORPIPE_MAKING(vkCreateComputePipelines),
    VORPIPE_MAKING(vkCreateDescriptorPool),
    VORPIPE_MAKING(vkCreateDescriptorSetLayout),
    VORPIPE_MAKING(vkCreateFence),
    VORPIPE_MAKING(vkCreateFramebuffer),
    VORPIPE_MAKING(vkCreateGraphicsPipelines),
    VORPIPE_MAKING(vkCreateImage),
    VORPIPE_MAKING(vkCreateImageView),
    VORPIPE_MAKING(vkCreatePipelineCache),
    VORPIPE_MAKING(vkCreatePipelineLayout),
    VORPIPE_MAKING(vkCreateQueryPool),
    VORPIPE_MAKING(vkCreateRenderPass),
    VORPIPE_MAKING(vkCreateSampler),
    VORPIPE_MAKING(vkCreateSemaphore),
    VORPIPE_MAKING(vkCreateShaderModule),
    VORPIPE_MAKING(vkCreateSwapchainKHR),
    VORPIPE_DESTROYING(vkDestroyBuffer),
    VORPIPE_DESTROYING(vkDestroyBufferView),
    VORPIPE_DESTROYING(vkDestroyCommandPool),
    VORPIPE_DESTROYING(vkDestroyDescriptorPool),
    VORPIPE_DESTROYING(vkDestroyDescriptorSetLayout),
    VORPIPE_DESTROYING(vkDestroyFence),
    VORPIPE_DESTROYING(vkDestroyFramebuffer),
    VORPIPE_DESTROYING(vkDestroyImage),
    VORPIPE_DESTROYING(vkDestroyImageView),
    VORPIPE_DESTROYING(vkDestroyPipeline),
    VORPIPE_DESTROYING(vkDestroyPipelineCache),
    VORPIPE_DESTROYING(vkDestroyPipelineLayout),
    VORPIPE_DESTROYING(vkDestroyQueryPool),
    VORPIPE_DESTROYING(vkDestroyRenderPass),
    VORPIPE_DESTROYING(vkDestroySampler),
    VORPIPE_DESTROYING(vkDestroySemaphore),
    VORPIPE_DESTROYING(vkDestroyShaderModule),
    VORPIPE_DESTROYING(vkDestroySwapchainKHR),
    VORPIPE_DESTROYING(vkFreeMemory),
};

// The same for an instance.
constexpr Replaced instance_functions[] = {
    VORPIPE_FAILING(vkEnumerateDeviceExtensionProperties),
    VORPIPE_FAILING(vkEnumeratePhysicalDevices),
    VORPIPE_FAILING(vkGetPhysicalDeviceSurfaceCapabilitiesKHR),
    VORPIPE_FAILING(vkGetPhysicalDeviceSurfaceFormatsKHR),
    VORPIPE_FAILING(vkGetPhysicalDeviceSurfaceSupportKHR),
    VORPIPE_MAKING(vkCreateDebugUtilsMessengerEXT),
    VORPIPE_MAKING(vkCreateDevice),
    VORPIPE_DESTROYING(vkDestroyDebugUtilsMessengerEXT),
};

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL deviceProc(VkDevice device, const char* raw_name) {
  const PFN_vkVoidFunction real = real_device_proc(device, raw_name);
  const std::string_view name = raw_name;
  if (driver == nullptr || real == nullptr) return real;
  if (name == "vkQueueSubmit") return insteadOf(real, real_submit, PFN_vkQueueSubmit{&submit});
  if (name == "vkWaitForFences") return insteadOf(real, real_wait, PFN_vkWaitForFences{&wait});
  if (name == "vkGetDeviceQueue") return insteadOf(real, real_get_queue, PFN_vkGetDeviceQueue{&getQueue});
  if (name == "vkDestroyDevice")
    return insteadOf(real, real_destroy_device, PFN_vkDestroyDevice{&destroyDevice});
  if (name == "vkAllocateMemory")
    return insteadOf(real, real_allocate, PFN_vkAllocateMemory{&allocateMemory});
  if (name == "vkCreateBuffer") return insteadOf(real, real_create_buffer, PFN_vkCreateBuffer{&createBuffer});
  if (name == "vkBindBufferMemory") return insteadOf(real, real_bind, PFN_vkBindBufferMemory{&bindBuffer});
  if (name == "vkMapMemory") return insteadOf(real, real_map, PFN_vkMapMemory{&mapMemory});
  for (const auto& function : functions) {
    if (function.name == name) return function.instead(real);
  }
  return real;
}

PFN_vkGetInstanceProcAddr real_instance_proc = nullptr;

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instanceProc(VkInstance instance, const char* name) {
  const PFN_vkVoidFunction real = real_instance_proc(instance, name);
  if (driver == nullptr || real == nullptr) return real;
  const std::string_view wanted = name;
  if (wanted == "vkGetDeviceProcAddr") {
    return insteadOf(real, real_device_proc, PFN_vkGetDeviceProcAddr{&deviceProc});
  }
  if (wanted == "vkDestroyInstance") {
    return insteadOf(real, real_destroy_instance, PFN_vkDestroyInstance{&destroyInstance});
  }
  if (wanted == "vkDestroyDevice") {
    return insteadOf(real, real_destroy_device, PFN_vkDestroyDevice{&destroyDevice});
  }
  for (const Replaced& function : instance_functions) {
    if (function.name == wanted) return function.instead(real);
  }
  return real;
}

}  // namespace

// The loader's functions are known once an instance has been opened; every later instance looks its own up
// again.
FaultyDriver::FaultyDriver() {
  static const auto loaded = vulkan::Instance::open(false).has_value();
  real_ = loaded ? vkGetInstanceProcAddr : nullptr;
  real_instance_proc = real_;
  driver = this;
  if (!loaded) return;
  vkGetInstanceProcAddr = instanceProc;
  real_create_instance = std::exchange(vkCreateInstance, createInstance);
  real_instance_extensions = std::exchange(vkEnumerateInstanceExtensionProperties, instanceExtensions);
  real_instance_layers = std::exchange(vkEnumerateInstanceLayerProperties, instanceLayers);
}

FaultyDriver::~FaultyDriver() {
  driver = nullptr;
  if (real_ == nullptr) return;
  vkGetInstanceProcAddr = real_;
  vkCreateInstance = real_create_instance;
  vkEnumerateInstanceExtensionProperties = real_instance_extensions;
  vkEnumerateInstanceLayerProperties = real_instance_layers;
}

std::set<std::string> FaultyDriver::canFail() {
  // Those with a function of their own.
  std::set<std::string> names = {"vkAllocateMemory",
                                 "vkBindBufferMemory",
                                 "vkCreateBuffer",
                                 "vkCreateInstance",
                                 "vkEnumerateInstanceExtensionProperties",
                                 "vkEnumerateInstanceLayerProperties",
                                 "vkMapMemory",
                                 "vkQueueSubmit",
                                 "vkWaitForFences"};
  for (const auto list :
       {std::span<const Replaced>(functions), std::span<const Replaced>(instance_functions)}) {
    for (const Replaced& function : list) {
      if (!function.name.starts_with("vkDestroy") && function.name != "vkFreeMemory")
        names.emplace(function.name);
    }
  }
  return names;
}

bool FaultyDriver::cannotFail(std::string_view name) {
  // What they record fails when recording ends; what they destroy is gone.
  if (name.starts_with("vkCmd") || name.starts_with("vkDestroy")) return true;
  // They return nothing; of a name that has no function, the last one says so, which is an error of its own.
  constexpr std::string_view names[] = {"vkFreeMemory",
                                        "vkGetBufferMemoryRequirements",
                                        "vkGetDeviceQueue",
                                        "vkGetImageMemoryRequirements",
                                        "vkGetPhysicalDeviceFeatures",
                                        "vkGetPhysicalDeviceFormatProperties",
                                        "vkGetPhysicalDeviceMemoryProperties",
                                        "vkGetPhysicalDeviceMemoryProperties2",
                                        "vkGetPhysicalDeviceProperties",
                                        "vkGetPhysicalDeviceProperties2",
                                        "vkGetPhysicalDeviceQueueFamilyProperties",
                                        "vkUpdateDescriptorSets",
                                        "vkGetInstanceProcAddr"};
  return std::ranges::find(names, name) != std::end(names);
}

VkResult FaultyDriver::beforeCall() {
  const std::lock_guard lock(mutex);
  return ++calls == failing_call ? failure : VK_SUCCESS;
}

bool FaultyDriver::isLostNow(VkDevice device) {
  if (lost_.contains(device) || (loses_all && losing_call > 0 && submissions >= losing_call)) return true;
  if (++submissions != losing_call) return false;
  lost_.insert(device);
  return true;
}

// What the host reads: buffers that are copied to, or filled and then written.
void FaultyDriver::noteBuffer(VkBuffer buffer, const VkBufferCreateInfo& info) {
  const bool for_host = (info.usage & VK_BUFFER_USAGE_TRANSFER_DST_BIT) != 0 ||
                        (storage_is_for_host && info.usage == VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  buffers_[buffer] = {nullptr, static_cast<std::size_t>(info.size / sizeof(std::uint32_t)), for_host};
}

void FaultyDriver::noteMemory(VkBuffer buffer, VkDeviceMemory memory) { memory_[memory] = buffers_[buffer]; }

void FaultyDriver::noteMapping(VkDeviceMemory memory, void* bytes) {
  memory_[memory].words = static_cast<std::uint32_t*>(bytes);
}

void FaultyDriver::forgetMemory(VkDeviceMemory memory) { memory_.erase(memory); }

// Another one may get its handle.
void FaultyDriver::forgetDevice(VkDevice device) { lost_.erase(device); }

void FaultyDriver::lie() {
  constexpr std::array<std::uint32_t, 8> numbers = {0,           1,           0x7FFFFFFFU, 0x80000000U,
                                                    0xFFFFFFFFU, 0x7FC00000U, 0xFF800000U, 0x00000301U};
  for (auto& [memory, mapped] : memory_) {
    if (mapped.words == nullptr || !mapped.for_host) continue;
    lied++;
    for (std::size_t k = 0; k < mapped.count; k++) {
      const auto any = lies();
      if (any % 4 == 0) mapped.words[k] = numbers[(any >> 8) % numbers.size()];
      if (any % 4 == 1) mapped.words[k] = static_cast<std::uint32_t>(any >> 32);
    }
  }
}

}  // namespace vorpipe::test

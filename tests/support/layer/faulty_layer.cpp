// A Vulkan layer that makes any device a worse one, for tests of the whole program:
//   VORPIPE_LAYER_SUBPIXEL_BITS=N         it reports N sub-pixel bits
//   VORPIPE_LAYER_LARGEST_ALLOCATION=N    it refuses allocations of more than N bytes
//   VORPIPE_LAYER_LOST_AT=K               it is lost at the K-th submission of the process, and stays lost
//   VORPIPE_LAYER_ALL_LOST=1              from then on all devices are lost
//   VORPIPE_LAYER_COMPILES_FOR=N          it takes N seconds for the first pipeline of the process
//   VORPIPE_LAYER_THREADS_FILE=FILE       LP_NUM_THREADS is written to FILE when a device is opened
#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <thread>

namespace {

// The functions of the next layer or driver. They are asked for when the instance or device is made: later
// the loader would answer with those of the first layer again.
struct NextInstance {
  VkInstance handle;
  PFN_vkGetInstanceProcAddr proc;
  PFN_vkCreateDevice create_device;
  PFN_vkGetPhysicalDeviceProperties properties;
  PFN_vkGetPhysicalDeviceProperties2 properties2;
};
struct NextDevice {
  VkDevice handle;
  PFN_vkGetDeviceProcAddr proc;
  PFN_vkAllocateMemory allocate_memory;
  PFN_vkQueueSubmit queue_submit;
  PFN_vkCreateGraphicsPipelines create_graphics;
};

std::mutex mutex;
std::map<void*, NextInstance> instances;
std::map<void*, NextDevice> devices;
std::set<void*> lost;
std::uint64_t submissions = 0;

// The pointer that the loader puts at the beginning of a handle: the same for all handles of an instance, and
// for all of a device.
template <class Handle>
void* keyOf(Handle handle) {
  void* key = nullptr;
  std::memcpy(&key, handle, sizeof(key));
  return key;
}

std::uint64_t setting(const char* name, std::uint64_t otherwise) {
  const char* value = std::getenv(name);
  return value != nullptr ? std::strtoull(value, nullptr, 10) : otherwise;
}

template <class Handle>
NextInstance nextOfInstance(Handle handle) {
  const std::lock_guard lock(mutex);
  return instances.at(keyOf(handle));
}

template <class Handle>
NextDevice nextOfDevice(Handle handle) {
  const std::lock_guard lock(mutex);
  return devices.at(keyOf(handle));
}

template <class Function, class Proc, class Handle>
void ask(Proc proc, Handle handle, const char* name, Function& function) {
  function = reinterpret_cast<Function>(proc(handle, name));
}

// The structure in the chain of `info` that links to the next layer; the loader adds one for each function.
template <class Link, class Info>
Link* linkIn(const Info* info, VkStructureType type) {
  for (const auto* each = static_cast<const VkBaseInStructure*>(info->pNext); each != nullptr;
       each = each->pNext) {
    auto* const link = const_cast<Link*>(reinterpret_cast<const Link*>(each));
    if (each->sType == type && link->function == VK_LAYER_LINK_INFO) return link;
  }
  return nullptr;
}

VKAPI_ATTR VkResult VKAPI_CALL createInstance(const VkInstanceCreateInfo* info,
                                              const VkAllocationCallbacks* how, VkInstance* instance) {
  auto* const link = linkIn<VkLayerInstanceCreateInfo>(info, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
  if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
  const auto proc = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  const auto create = reinterpret_cast<PFN_vkCreateInstance>(proc(VK_NULL_HANDLE, "vkCreateInstance"));
  const VkResult result = create(info, how, instance);
  if (result != VK_SUCCESS) return result;
  NextInstance next{*instance, proc, nullptr, nullptr, nullptr};
  ask(proc, *instance, "vkCreateDevice", next.create_device);
  ask(proc, *instance, "vkGetPhysicalDeviceProperties", next.properties);
  ask(proc, *instance, "vkGetPhysicalDeviceProperties2", next.properties2);
  const std::lock_guard lock(mutex);
  instances[keyOf(*instance)] = next;
  return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL createDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                            const VkAllocationCallbacks* how, VkDevice* device) {
  auto* const link = linkIn<VkLayerDeviceCreateInfo>(info, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
  if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
  const auto proc = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  if (const char* file = std::getenv("VORPIPE_LAYER_THREADS_FILE"); file != nullptr) {
    const char* threads = std::getenv("LP_NUM_THREADS");
    std::ofstream(file) << (threads != nullptr ? threads : "none") << "\n";
  }
  const VkResult result = nextOfInstance(physical).create_device(physical, info, how, device);
  if (result != VK_SUCCESS) return result;
  NextDevice next{*device, proc, nullptr, nullptr, nullptr};
  ask(proc, *device, "vkAllocateMemory", next.allocate_memory);
  ask(proc, *device, "vkQueueSubmit", next.queue_submit);
  ask(proc, *device, "vkCreateGraphicsPipelines", next.create_graphics);
  const std::lock_guard lock(mutex);
  devices[keyOf(*device)] = next;
  lost.erase(keyOf(*device));
  return VK_SUCCESS;
}

void lower(VkPhysicalDeviceProperties& properties) {
  const auto bits = setting("VORPIPE_LAYER_SUBPIXEL_BITS", properties.limits.subPixelPrecisionBits);
  properties.limits.subPixelPrecisionBits = static_cast<std::uint32_t>(bits);
}

VKAPI_ATTR void VKAPI_CALL getProperties(VkPhysicalDevice physical, VkPhysicalDeviceProperties* properties) {
  nextOfInstance(physical).properties(physical, properties);
  lower(*properties);
}

VKAPI_ATTR void VKAPI_CALL getProperties2(VkPhysicalDevice physical,
                                          VkPhysicalDeviceProperties2* properties) {
  nextOfInstance(physical).properties2(physical, properties);
  lower(properties->properties);
}

VKAPI_ATTR VkResult VKAPI_CALL allocateMemory(VkDevice device, const VkMemoryAllocateInfo* info,
                                              const VkAllocationCallbacks* how, VkDeviceMemory* memory) {
  if (info->allocationSize > setting("VORPIPE_LAYER_LARGEST_ALLOCATION", UINT64_MAX)) {
    return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  }
  return nextOfDevice(device).allocate_memory(device, info, how, memory);
}

// Whether the queue's device is lost by now, or lost by this submission. The queue has the device's key.
bool isLost(VkQueue queue) {
  const std::lock_guard lock(mutex);
  if (lost.contains(keyOf(queue))) return true;
  if (!lost.empty() && setting("VORPIPE_LAYER_ALL_LOST", 0) == 1) return true;
  if (++submissions != setting("VORPIPE_LAYER_LOST_AT", 0)) return false;
  lost.insert(keyOf(queue));
  return true;
}

VKAPI_ATTR VkResult VKAPI_CALL queueSubmit(VkQueue queue, std::uint32_t count, const VkSubmitInfo* infos,
                                           VkFence fence) {
  if (isLost(queue)) return VK_ERROR_DEVICE_LOST;
  return nextOfDevice(queue).queue_submit(queue, count, infos, fence);
}

// A backend makes one of these when it is opened.
VKAPI_ATTR VkResult VKAPI_CALL createGraphics(VkDevice device, VkPipelineCache cache, std::uint32_t count,
                                              const VkGraphicsPipelineCreateInfo* infos,
                                              const VkAllocationCallbacks* how, VkPipeline* pipelines) {
  static std::once_flag first;
  std::call_once(first, [] {
    std::this_thread::sleep_for(std::chrono::seconds(setting("VORPIPE_LAYER_COMPILES_FOR", 0)));
  });
  return nextOfDevice(device).create_graphics(device, cache, count, infos, how, pipelines);
}

template <class Function>
PFN_vkVoidFunction plain(Function function) {
  return reinterpret_cast<PFN_vkVoidFunction>(function);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL deviceProc(VkDevice device, const char* raw_name);
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instanceProc(VkInstance instance, const char* raw_name);

PFN_vkVoidFunction ownOfDevice(std::string_view name) {
  if (name == "vkGetDeviceProcAddr") return plain(&deviceProc);
  if (name == "vkAllocateMemory") return plain(&allocateMemory);
  if (name == "vkQueueSubmit") return plain(&queueSubmit);
  if (name == "vkCreateGraphicsPipelines") return plain(&createGraphics);
  return nullptr;
}

PFN_vkVoidFunction ownOfInstance(std::string_view name) {
  if (name == "vkGetInstanceProcAddr") return plain(&instanceProc);
  if (name == "vkCreateInstance") return plain(&createInstance);
  if (name == "vkCreateDevice") return plain(&createDevice);
  if (name == "vkGetPhysicalDeviceProperties") return plain(&getProperties);
  if (name == "vkGetPhysicalDeviceProperties2") return plain(&getProperties2);
  return ownOfDevice(name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL deviceProc(VkDevice device, const char* raw_name) {
  if (const auto own = ownOfDevice(raw_name); own != nullptr) return own;
  const NextDevice next = nextOfDevice(device);
  return next.proc(next.handle, raw_name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instanceProc(VkInstance instance, const char* raw_name) {
  if (const auto own = ownOfInstance(raw_name); own != nullptr) return own;
  if (instance == VK_NULL_HANDLE) return nullptr;
  const NextInstance next = nextOfInstance(instance);
  return next.proc(next.handle, raw_name);
}

}  // namespace

extern "C" [[gnu::visibility("default")]] VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* negotiated) {
  negotiated->loaderLayerInterfaceVersion = 2;
  negotiated->pfnGetInstanceProcAddr = instanceProc;
  negotiated->pfnGetDeviceProcAddr = deviceProc;
  negotiated->pfnGetPhysicalDeviceProcAddr = nullptr;
  return VK_SUCCESS;
}

// Stands in for the Vulkan loader, so that pipelines are made for a graphics card that is not there. Where
// RADV_FORCE_FAMILY names a card of AMD's, Mesa's driver RADV compiles for it and runs nothing: it has no
// memory, no queue and no fences, and programs refuse it. Here such a device gets a heap; fences and command
// buffers are made up, and what is to be run is dropped. All answers are zeros.
#include <dlfcn.h>
#include <vulkan/vulkan.h>

#include <cstdint>
#include <map>
#include <string_view>

namespace {

constexpr VkDeviceSize heap_bytes = VkDeviceSize{8} << 30;

PFN_vkGetInstanceProcAddr loader = nullptr;
PFN_vkGetDeviceProcAddr driver = nullptr;
PFN_vkGetPhysicalDeviceMemoryProperties memory_of = nullptr;
PFN_vkGetPhysicalDeviceMemoryProperties2 more_memory_of = nullptr;
PFN_vkGetBufferMemoryRequirements needs_of_buffer = nullptr;
PFN_vkGetImageMemoryRequirements needs_of_image = nullptr;

void addHeap(VkPhysicalDeviceMemoryProperties& memory) {
  if (memory.memoryHeapCount != 0) return;
  memory.memoryHeapCount = memory.memoryTypeCount = 1;
  memory.memoryHeaps[0] = {heap_bytes, VK_MEMORY_HEAP_DEVICE_LOCAL_BIT};
  memory.memoryTypes[0] = {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
                               VK_MEMORY_PROPERTY_HOST_COHERENT_BIT | VK_MEMORY_PROPERTY_HOST_CACHED_BIT,
                           0};
}

VKAPI_ATTR void VKAPI_CALL getMemory(VkPhysicalDevice device, VkPhysicalDeviceMemoryProperties* memory) {
  memory_of(device, memory);
  addHeap(*memory);
}

VKAPI_ATTR void VKAPI_CALL getMoreMemory(VkPhysicalDevice device, VkPhysicalDeviceMemoryProperties2* memory) {
  more_memory_of(device, memory);
  addHeap(memory->memoryProperties);
  for (auto* next = static_cast<VkBaseOutStructure*>(memory->pNext); next != nullptr; next = next->pNext) {
    if (next->sType != VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT) continue;
    reinterpret_cast<VkPhysicalDeviceMemoryBudgetPropertiesEXT*>(next)->heapBudget[0] = heap_bytes;
  }
}

VKAPI_ATTR void VKAPI_CALL getNeedsOfBuffer(VkDevice device, VkBuffer buffer, VkMemoryRequirements* needs) {
  needs_of_buffer(device, buffer, needs);
  needs->memoryTypeBits = 1;
}

VKAPI_ATTR void VKAPI_CALL getNeedsOfImage(VkDevice device, VkImage image, VkMemoryRequirements* needs) {
  needs_of_image(device, image, needs);
  needs->memoryTypeBits = 1;
}

/// A handle that is not null, and that nobody looks behind.
template <class Handle>
Handle madeUp() {
  static std::uint64_t there;
  return (Handle)(&there);  // NOLINT: handles are pointers on some machines, numbers on others
}

VKAPI_ATTR VkResult VKAPI_CALL makeFence(VkDevice /*device*/, const VkFenceCreateInfo* /*how*/,
                                         const VkAllocationCallbacks* /*memory*/, VkFence* fence) {
  *fence = madeUp<VkFence>();
  return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL makePool(VkDevice /*device*/, const VkCommandPoolCreateInfo* /*how*/,
                                        const VkAllocationCallbacks* /*memory*/, VkCommandPool* pool) {
  *pool = madeUp<VkCommandPool>();
  return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL makeCommands(VkDevice /*device*/, const VkCommandBufferAllocateInfo* how,
                                            VkCommandBuffer* commands) {
  for (std::uint32_t k = 0; k < how->commandBufferCount; ++k) commands[k] = madeUp<VkCommandBuffer>();
  return VK_SUCCESS;
}

/// For a function whose arguments do not matter.
VkResult drop() { return VK_SUCCESS; }

template <class Function>
PFN_vkVoidFunction plain(Function function) {
  return reinterpret_cast<PFN_vkVoidFunction>(function);
}

/// Remembers the driver's function, and hands out its replacement.
template <class Function>
PFN_vkVoidFunction replaced(Function& original, PFN_vkVoidFunction function, Function replacement) {
  original = reinterpret_cast<Function>(function);
  return plain(replacement);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL functionOfDevice(VkDevice device, const char* name) {
  static const std::map<std::string_view, PFN_vkVoidFunction> made_up{
      {"vkCreateFence", plain(makeFence)},
      {"vkCreateCommandPool", plain(makePool)},
      {"vkAllocateCommandBuffers", plain(makeCommands)},
      {"vkDestroyFence", plain(drop)},
      {"vkResetFences", plain(drop)},
      {"vkWaitForFences", plain(drop)},
      {"vkGetFenceStatus", plain(drop)},
      {"vkQueueSubmit", plain(drop)},
      {"vkQueueWaitIdle", plain(drop)},
      {"vkDeviceWaitIdle", plain(drop)},
      {"vkBeginCommandBuffer", plain(drop)},
      {"vkEndCommandBuffer", plain(drop)},
      {"vkResetCommandBuffer", plain(drop)},
      {"vkFreeCommandBuffers", plain(drop)},
      {"vkResetCommandPool", plain(drop)},
      {"vkDestroyCommandPool", plain(drop)},
  };
  const auto function = driver(device, name);
  const std::string_view called = name;
  if (function == nullptr) return nullptr;
  if (called.starts_with("vkCmd")) return plain(drop);
  if (const auto found = made_up.find(called); found != made_up.end()) return found->second;
  if (called == "vkGetBufferMemoryRequirements") return replaced(needs_of_buffer, function, getNeedsOfBuffer);
  if (called == "vkGetImageMemoryRequirements") return replaced(needs_of_image, function, getNeedsOfImage);
  return function;
}

}  // namespace

extern "C" VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vkGetInstanceProcAddr(VkInstance instance,
                                                                          const char* name) {
  if (loader == nullptr) {
    void* const library = dlopen(VULKAN_LOADER, RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) return nullptr;
    loader = reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library, "vkGetInstanceProcAddr"));
  }
  const auto function = loader(instance, name);
  const std::string_view called = name;
  if (function == nullptr) return nullptr;
  if (called == "vkGetInstanceProcAddr") return plain(vkGetInstanceProcAddr);
  if (called == "vkGetDeviceProcAddr") return replaced(driver, function, functionOfDevice);
  if (called == "vkGetPhysicalDeviceMemoryProperties") return replaced(memory_of, function, getMemory);
  if (called == "vkGetPhysicalDeviceMemoryProperties2" ||
      called == "vkGetPhysicalDeviceMemoryProperties2KHR") {
    return replaced(more_memory_of, function, getMoreMemory);
  }
  return function;
}

#include "backend/vulkan/instance.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "backend/vulkan/error.h"
#include "backend/vulkan/handle.h"
#include "base/try.h"

namespace vorpipe::vulkan {
namespace {

constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";
constexpr const char* driver_remedy =
    "install mesa-vulkan-drivers (Debian/Ubuntu) or your GPU's driver, or use --backend cpu";

// volk keeps the entry points in globals. Every instance gets the same ones from the loader, so two threads
// only must not write them at once.
std::mutex& volkMutex() {
  static std::mutex mutex;
  return mutex;
}

Result<void> loadVulkan() {
  const std::lock_guard lock(volkMutex());
  static const VkResult loaded = volkInitialize();
  if (loaded != VK_SUCCESS) {
    return deviceError(std::string("no Vulkan loader (libvulkan.so.1) here: ") + driver_remedy);
  }
  if (volkGetInstanceVersion() < VK_API_VERSION_1_1) {
    return deviceError(std::string("the Vulkan loader is older than Vulkan 1.1: ") + driver_remedy);
  }
  return {};
}

bool hasExtension(const char* layer, const char* name) {
  std::uint32_t count = 0;
  if (vkEnumerateInstanceExtensionProperties(layer, &count, nullptr) != VK_SUCCESS) return false;
  std::vector<VkExtensionProperties> extensions(count);
  const VkResult result = vkEnumerateInstanceExtensionProperties(layer, &count, extensions.data());
  if (result != VK_SUCCESS && result != VK_INCOMPLETE) return false;
  extensions.resize(count);
  return std::ranges::any_of(extensions, [&](const VkExtensionProperties& extension) {
    return std::strcmp(extension.extensionName, name) == 0;
  });
}

Result<void> findValidationLayer() {
  std::uint32_t count = 0;
  VORPIPE_TRY(
      check(vkEnumerateInstanceLayerProperties(&count, nullptr), "vkEnumerateInstanceLayerProperties"));
  std::vector<VkLayerProperties> layers(count);
  const VkResult result = vkEnumerateInstanceLayerProperties(&count, layers.data());
  if (result != VK_INCOMPLETE) VORPIPE_TRY(check(result, "vkEnumerateInstanceLayerProperties"));
  layers.resize(count);
  const bool found = std::ranges::any_of(layers, [](const VkLayerProperties& layer) {
    return std::strcmp(layer.layerName, validation_layer) == 0;
  });
  if (found) return {};
  return deviceError(std::string("the Vulkan layer ") + validation_layer +
                     " is not installed: install vulkan-validationlayers (Debian/Ubuntu)");
}

VKAPI_ATTR VkBool32 VKAPI_CALL keepMessage(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                           VkDebugUtilsMessageTypeFlagsEXT,
                                           const VkDebugUtilsMessengerCallbackDataEXT* data, void* log) {
  // Newer layers' text (1.4.309) no longer begins with the identifier, which is what people search for.
  std::string message = data->pMessage;
  if (data->pMessageIdName != nullptr && message.find(data->pMessageIdName) == std::string::npos) {
    message = std::string(data->pMessageIdName) + ": " + message;
  }
  static_cast<MessageLog*>(log)->add(std::move(message));
  return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messengerInfo(MessageLog& log) {
  auto info =
      structure<VkDebugUtilsMessengerCreateInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
  info.messageSeverity =
      VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  // Not GENERAL: the loader warns there about drivers that this run does not use. Not PERFORMANCE: it warns
  // about outputs of the geometry shaders that OpenGL captures and Vulkan ignores on purpose.
  info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
  info.pfnUserCallback = keepMessage;
  info.pUserData = &log;
  return info;
}

// Creates the instance and loads its entry points.
Result<VkInstance> createInstance(bool validation, std::span<const char* const> wanted, MessageLog& log) {
  auto application = structure<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
  application.pApplicationName = "vorpipe";
  application.apiVersion = VK_API_VERSION_1_1;
  auto info = structure<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
  info.pApplicationInfo = &application;
  std::vector<const char*> extensions(wanted.begin(), wanted.end());
  if (hasExtension(nullptr, VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME)) {
    extensions.push_back(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
    info.flags = VK_INSTANCE_CREATE_ENUMERATE_PORTABILITY_BIT_KHR;
  }
  VkDebugUtilsMessengerCreateInfoEXT messenger = messengerInfo(log);
  const VkValidationFeatureEnableEXT synchronization =
      VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
  auto features = structure<VkValidationFeaturesEXT>(VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT);
  features.enabledValidationFeatureCount = 1;
  features.pEnabledValidationFeatures = &synchronization;
  features.pNext = &messenger;
  if (validation) {
    extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &validation_layer;
    info.pNext = &features;
  }
  info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  VkInstance instance = VK_NULL_HANDLE;
  const VkResult result = vkCreateInstance(&info, nullptr, &instance);
  if (result == VK_ERROR_INCOMPATIBLE_DRIVER) {
    return deviceError(std::string("no Vulkan driver here: ") + driver_remedy);
  }
  VORPIPE_TRY(check(result, "vkCreateInstance"));
  const std::lock_guard lock(volkMutex());
  volkLoadInstanceOnly(instance);
  return instance;
}

}  // namespace

void MessageLog::add(std::string message) {
  const std::lock_guard lock(mutex_);
  messages_.push_back(std::move(message));
}

std::vector<std::string> MessageLog::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(messages_, {});
}

Result<Instance> Instance::open(bool validation, std::span<const char* const> extensions) {
  VORPIPE_TRY(loadVulkan());
  if (validation) VORPIPE_TRY(findValidationLayer());
  Instance opened;
  VORPIPE_VAR(instance, createInstance(validation, extensions, *opened.log_));
  opened.instance_ = instance;
  if (validation) {
    // An extension's entry point belongs to the instance that enabled it, unlike volk's globals.
    const auto create_messenger = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(opened.instance_, "vkCreateDebugUtilsMessengerEXT"));
    if (create_messenger == nullptr) return deviceError("the Vulkan loader lacks VK_EXT_debug_utils");
    const VkDebugUtilsMessengerCreateInfoEXT info = messengerInfo(*opened.log_);
    VORPIPE_TRY(check(create_messenger(opened.instance_, &info, nullptr, &opened.messenger_),
                      "vkCreateDebugUtilsMessengerEXT"));
  }
  return opened;
}

Instance::Instance(Instance&& other) noexcept
    : log_(std::move(other.log_)),
      instance_(std::exchange(other.instance_, VK_NULL_HANDLE)),
      messenger_(std::exchange(other.messenger_, VK_NULL_HANDLE)) {}

Instance& Instance::operator=(Instance&& other) noexcept {
  if (this != &other) {
    close();
    log_ = std::move(other.log_);
    instance_ = std::exchange(other.instance_, VK_NULL_HANDLE);
    messenger_ = std::exchange(other.messenger_, VK_NULL_HANDLE);
  }
  return *this;
}

Instance::~Instance() { close(); }

void Instance::close() {
  if (instance_ == VK_NULL_HANDLE) return;
  if (messenger_ != VK_NULL_HANDLE) {
    const auto destroy_messenger = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"));
    destroy_messenger(instance_, messenger_, nullptr);
  }
  vkDestroyInstance(instance_, nullptr);
  instance_ = VK_NULL_HANDLE;
}

}  // namespace vorpipe::vulkan

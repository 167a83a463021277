#include "backend/registry/registry.h"

#include <fmt/core.h>

#include "backend/capabilities.h"
#include "backend/cpu/cpu.h"
#include "backend/cpu/exact_tier.h"
#include "backend/opengl/opengl_backend.h"
#include "backend/vulkan/vulkan_backend.h"
#include "base/try.h"

namespace vorpipe {
namespace {

using Made = Result<std::unique_ptr<Backend>>;

Result<OpenedBackend> opened(Made made, std::string choice = {}) {
  if (!made) return tl::unexpected(made.error());
  return OpenedBackend{std::move(*made), std::move(choice)};
}

bool isHardware(const Made& made) { return made && (*made)->info().device.type != "cpu"; }

Result<OpenedBackend> openVulkan(const BackendOptions& options, Drivers drivers) {
  VORPIPE_VAR(made, makeVulkanBackend(options, drivers));
  if (!made.without_compute) {
    return opened(std::move(made.backend),
                  "vulkan took vulkan-compute: it needs no geometry shader and runs on all threads");
  }
  return opened(
      std::move(made.backend),
      fmt::format("vulkan took vulkan-geometry: vulkan-compute failed ({})", made.without_compute->message));
}

// Returns the backends that take over when one fails during work: the others, in the order of the choice.
// Those that could not be opened before will not open then either. A caller who names a device does not mean
// the host's processors.
std::vector<std::string> othersAfter(const BackendOptions& options, std::string_view taken) {
  std::vector<std::string> order = {"vulkan-compute", "vulkan-geometry"};
  if (options.name == "auto") {
    if (taken == "cpu") return {};
    order.emplace_back("opengl");
    if (options.device.empty()) order.emplace_back("cpu");
  } else if (options.name != "vulkan") {
    return {};
  }
  std::erase(order, taken);
  return order;
}

// A caller who names or masks a device means a device, even one with a software driver.
bool meansDevice(const BackendOptions& options) {
  return !options.device.empty() || !options.mask.disabled.empty() || !options.mask.limits.empty();
}

Result<OpenedBackend> openAuto(const BackendOptions& options) {
  const Drivers drivers = meansDevice(options) ? Drivers::any : Drivers::hardware;
  auto vulkan = openVulkan(options, drivers);
  const auto took = [&](std::string_view why) -> Result<OpenedBackend> {
    vulkan->choice = fmt::format("auto took {}: {}", vulkan->backend->info().device.backend, why);
    return std::move(vulkan);
  };
  if (vulkan && vulkan->backend->info().device.type != "cpu") return took("it has a hardware device");
  auto opengl = makeOpenGlBackend(options, drivers);
  if (isHardware(opengl)) {
    return opened(std::move(opengl), "auto took opengl: Vulkan has no hardware device here, OpenGL has");
  }
  if (vulkan) return took("no hardware device, but a software driver for Vulkan");
  if (opengl) {
    return opened(
        std::move(opengl),
        fmt::format("auto took opengl: no hardware device, and Vulkan failed ({})", vulkan.error().message));
  }
  if (!options.device.empty()) return tl::unexpected(vulkan.error());
  auto cpu = opened(makeCpuBackend(options), fmt::format("auto took cpu: no hardware device (vulkan: {}; {})",
                                                         vulkan.error().message, opengl.error().message));
  if (cpu) cpu->beside_drivers = true;
  return cpu;
}

}  // namespace

Result<OpenedBackend> openBackend(const BackendOptions& options) {
  Capabilities any;
  VORPIPE_TRY(applyMask(any, options.mask));
  const auto& name = options.name;
  if (name == "auto" || name == "vulkan") {
    auto chosen = name == "auto" ? openAuto(options) : openVulkan(options, Drivers::any);
    if (chosen) chosen->others = othersAfter(options, chosen->backend->info().device.backend);
    return chosen;
  }
  if (name == "vulkan-geometry") return opened(makeVulkanGeometryBackend(options));
  if (name == "vulkan-compute") return opened(makeVulkanComputeBackend(options));
  if (name == "opengl") return opened(makeOpenGlBackend(options));
  if (name == "cpu") {
    VORPIPE_TRY(checkCpuDevice(options.device));
    return opened(makeCpuBackend(options));
  }
  return tl::unexpected(Error{
      ErrorCode::input, fmt::format("there is no backend \"{}\"; known are auto, vulkan, vulkan-geometry, "
                                    "vulkan-compute, opengl, cpu",
                                    name)});
}

std::unique_ptr<ExactTier> openExactTier(int threads) { return makeExactTier(threads); }

std::unique_ptr<PlaceSearch> openPlaceSearch(const SiteSet& sites, int threads) {
  return makePlaceSearch(sites, threads);
}

std::vector<std::string> backendNames() {
  return {"auto", "vulkan", "vulkan-geometry", "vulkan-compute", "opengl", "cpu"};
}

std::vector<DeviceInfo> devices(const Mask& mask) {
  auto all = listVulkanDevices(mask);
  for (auto& device : listOpenGlDevices(mask)) all.push_back(std::move(device));
  all.push_back(cpuDevice());
  return all;
}

}  // namespace vorpipe

#include <fmt/core.h>

#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands/command.h"
#include "cli/options/options.h"
#include "io/base/field_text.h"

namespace vorpipe::cli {
namespace {

using Json = nlohmann::ordered_json;

struct DevicesCommand {
  Mask mask;
  bool json = false;
};

/// A device with its index within its backend, for --device; none for an entry that says why a backend has no
/// device.
struct IndexedDevice {
  DeviceInfo info;
  std::optional<int> index;
};

std::vector<IndexedDevice> indexed(std::vector<DeviceInfo> infos) {
  std::map<std::string, int> next;
  std::vector<IndexedDevice> result;
  for (DeviceInfo& info : infos) {
    std::optional<int> index;
    if (!info.name.empty()) index = next[info.backend]++;
    result.push_back({std::move(info), index});
  }
  return result;
}

void printJson(const std::vector<IndexedDevice>& listed) {
  Json array = Json::array();
  for (const auto& [info, index] : listed) {
    Json features = Json::object(), limits = Json::object();
    for (const auto& [name, present] : info.features) features[name] = present;
    for (const auto& [name, value] : info.limits) limits[name] = value;
    array.push_back({{"backend", info.backend},
                     {"index", index ? Json(*index) : Json(nullptr)},
                     {"name", info.name},
                     {"driver", info.driver},
                     {"type", info.type},
                     {"usable", info.usable},
                     {"reason", info.usable ? Json(nullptr) : Json(info.reason)},
                     {"features", std::move(features)},
                     {"limits", std::move(limits)}});
  }
  fmt::print("{}", jsonText(array, 2));
}

void printDevice(const IndexedDevice& device) {
  const DeviceInfo& info = device.info;
  if (device.index) fmt::print("  {}  {}; {}; {}\n", *device.index, info.name, info.driver, info.type);
  if (!info.usable) fmt::print("     cannot be used: {}\n", info.reason);
  for (const auto& [name, present] : info.features)
    fmt::print("     {:<34} {}\n", name, present ? "yes" : "no");
  for (const auto& [name, value] : info.limits) fmt::print("     {:<34} {}\n", name, value);
}

void printTable(const std::vector<IndexedDevice>& listed) {
  std::string_view backend;
  for (const IndexedDevice& device : listed) {
    if (device.info.backend != backend) {
      backend = device.info.backend;
      fmt::print("{}\n", backend);
    }
    printDevice(device);
  }
}

Result<ExitCode> listDevices(const DevicesCommand& command) {
  const auto listed = indexed(devices(command.mask));
  command.json ? printJson(listed) : printTable(listed);
  return exit_done;
}

}  // namespace

void addDevices(CommandLine& line) {
  auto command = std::make_shared<DevicesCommand>();
  Options options =
      line.addSubcommand("devices", "lists every backend with its devices, or why one cannot be used",
                         [command](const Invocation&) { return listDevices(*command); });
  options.group("Output");
  options.addFlag("--json", command->json, "prints JSON");
  addMaskOptions(options, command->mask);
}

}  // namespace vorpipe::cli

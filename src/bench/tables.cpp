#include "bench/tables.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <cmath>

#include "io/base/field_text.h"

namespace vorpipe::bench {

double exponentOf(const std::vector<std::pair<double, double>>& points) {
  double x_mean = 0, y_mean = 0;
  for (const auto& [x, y] : points) {
    x_mean += std::log(x) / static_cast<double>(points.size());
    y_mean += std::log(y) / static_cast<double>(points.size());
  }
  double along = 0, across = 0;
  for (const auto& [x, y] : points) {
    const double off = std::log(x) - x_mean;
    along += off * off;
    across += off * (std::log(y) - y_mean);
  }
  return across / along;
}

std::vector<std::string> noteIfCut(std::string_view option, std::uint64_t most, std::uint64_t wanted) {
  if (most >= wanted) return {};
  return {fmt::format("Cut short: {} {} of {}.", option, most, wanted)};
}

std::string markdown(const Conditions& conditions) {
  const auto& [machine, opened, unusable, settings] = conditions;
  std::string text = "## vorpipe bench\n\n" + markdown(machine);
  for (const auto& [name, device] : opened) {
    const std::string backend = name == device.backend ? "" : fmt::format(" ({})", device.backend);
    text += fmt::format("- {}{}: {}; {}\n", name, backend, device.name, device.driver);
  }
  for (const std::string& line : unusable) text += fmt::format("- {}\n", line);
  const int threads = settings.options.threads;
  return text + fmt::format(
                    "- medians of {}{} after one to warm up, in brackets the median deviation from them; "
                    "what stands in one table was measured in turns; {}\n",
                    settings.repetitions,
                    settings.repetitions < usual_repetitions ? " (rough: 7 are usual)" : "",
                    threads > 0 ? fmt::format("{} threads", threads) : "all threads");
}

std::string reportJson(const Conditions& conditions, std::span<const Table> tables) {
  using Json = nlohmann::ordered_json;
  const auto& [machine, opened, unusable, settings] = conditions;
  Json devices = Json::array(), found = Json::array();
  for (const auto& [name, device] : opened) {
    devices.push_back({{"name", name},
                       {"backend", device.backend},
                       {"device", device.name},
                       {"driver", device.driver},
                       {"type", device.type}});
  }
  for (const Table& table : tables) found.push_back(json(table));
  const Json report = {
      {"machine", json(machine)},
      {"backends", std::move(devices)},
      {"not_measured", unusable},
      {"repetitions", settings.repetitions},
      {"max_sites", settings.max_sites},
      {"max_side", settings.max_side},
      {"threads", settings.options.threads > 0 ? Json(settings.options.threads) : Json(nullptr)},
      {"tables", std::move(found)}};
  return jsonText(report, 1);
}

}  // namespace vorpipe::bench

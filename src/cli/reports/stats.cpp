#include "cli/reports/stats.h"

#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "io/text/json_text.h"

namespace vorpipe::cli {
namespace {

using Json = nlohmann::ordered_json;

Json time(double milliseconds) { return milliseconds < 0 ? Json(nullptr) : Json(milliseconds); }

/// Of this process. What getrusage says of a process on Linux may be its parent's, before it became another
/// program.
std::uint64_t peakMemoryBytes() {
  constexpr std::uint64_t kilobyte = 1024;
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    std::uint64_t peak = 0;
    if (word == "VmHWM:" && status >> peak) return peak * kilobyte;
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
  constexpr std::uint64_t unit = 1;
#else
  constexpr std::uint64_t unit = kilobyte;
#endif
  return static_cast<std::uint64_t>(usage.ru_maxrss) * unit;
}

std::string_view axesOf(Periodic periodic) {
  switch (periodic) {
    case Periodic::x:
      return "x";
    case Periodic::y:
      return "y";
    default:
      return "xy";
  }
}

/// By what, how and from which value to which.
Json colorJson(const ColorKey& key) {
  const std::string_view by = key.color == ColorBy::area        ? "area"
                              : key.color == ColorBy::neighbors ? "neighbors"
                                                                : "weight";
  const std::string_view scale = key.scale == ColorScale::log        ? "log"
                                 : key.scale == ColorScale::quantile ? "quantile"
                                                                     : "linear";
  return {{"by", by}, {"scale", scale}, {"range", {key.range.low, key.range.high}}};
}

}  // namespace

void addShape(nlohmann::ordered_json& json, const Input& input) {
  const auto& weight = input.sites.weight;
  const auto& rings = input.outline.ring_offsets;
  json["outline"] = nullptr;
  if (!input.outline.empty()) {
    json["outline"] = {{"polygons", input.outline.polygon_offsets.size() - 1}, {"rings", rings.size() - 1}};
  }
  json["periodic"] = input.periodic == Periodic::none ? Json(nullptr) : Json(axesOf(input.periodic));
  json["weights"] = nullptr;
  if (!weight.empty()) {
    const auto [least, greatest] = std::ranges::minmax(weight);
    json["weights"] = {least, greatest};
  }
}

std::string statsJson(const Stats& stats) {
  const Report& report = stats.report;
  const Box& domain = stats.input.domain;
  const Times& times = report.time_ms;
  Json json;
  json["version"] = version();
  json["command"] = stats.command;
  json["backend"] = report.backend;
  json["device"] = report.device;
  json["driver"] = report.driver;
  json["notes"] = report.notes;
  json["sites"] = stats.input.sites.size();
  json["seed"] = stats.input.seed ? Json(*stats.input.seed) : Json(nullptr);
  json["domain"] = {domain.xmin, domain.ymin, domain.xmax, domain.ymax};
  addShape(json, stats.input);
  json["status"] = {{"ok", report.ok}, {"empty", report.empty}, {"duplicate", report.duplicate}};
  json["hidden"] = stats.input.sites.weight.empty() ? Json(nullptr) : Json(report.hidden);
  json["resolved"] = {{"retried", report.retried},
                      {"double", report.in_double},
                      {"exact", report.exact},
                      {"pixels", report.pixels}};
  json["area_sum"] = stats.area_sum ? Json(*stats.area_sum) : Json(nullptr);
  json["mass_sum"] = stats.mass_sum ? Json(*stats.mass_sum) : Json(nullptr);
  json["color"] = stats.color ? colorJson(*stats.color) : Json(nullptr);
  json["time_ms"] = {
      {"read", time(stats.input.read_ms)}, {"order", time(times.order)},    {"upload", time(times.upload)},
      {"search", time(times.search)},      {"cells", time(times.cells)},    {"draw", time(times.draw)},
      {"download", time(times.download)},  {"write", time(stats.write_ms)}, {"total", time(stats.total_ms)}};
  json["forecast_memory_bytes"] = stats.forecast;
  json["peak_memory_bytes"] = peakMemoryBytes();
  return jsonText(json, 2);
}

}  // namespace vorpipe::cli

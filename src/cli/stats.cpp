#include "cli/stats.h"

#include <sys/resource.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/parallel.h"
#include "bench/machine.h"
#include "io/base/field_text.h"

namespace vorpipe::cli {
namespace {

using Json = nlohmann::ordered_json;

Json time(double milliseconds) { return milliseconds < 0 ? Json(nullptr) : Json(milliseconds); }

/// Returns this process's peak. On Linux, getrusage may include the parent's peak from before exec.
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

Json fileJson(const LoggedFile& file) {
  return {{"path", file.path}, {"bytes", file.contents.bytes}, {"xxh128", file.contents.xxh128}};
}

std::string searchText(const SearchOptions& search) {
  return search.method == Search::grid ? "grid" : fmt::format("flann:{}", search.neighbors);
}

/// Adds what is needed to reproduce the run.
void addLog(Json& json, const RunLog& log) {
  json["arguments"] = log.invocation().arguments;
  json["inputs"] = Json::array();
  for (const LoggedFile& file : log.inputs()) json["inputs"].push_back(fileJson(file));
  json["outputs"] = Json::array();
  for (const WrittenFile& written : log.outputs()) {
    Json file = fileJson(written.file);
    if (!written.timeless.empty()) file["xxh128_without_times"] = written.timeless;
    json["outputs"].push_back(std::move(file));
  }
}

/// Returns what determines the colors, their scale and the range of values.
Json colorJson(const ColorKey& key) {
  const std::string_view by = key.color == ColorBy::area        ? "area"
                              : key.color == ColorBy::neighbors ? "neighbors"
                                                                : "weight";
  const std::string_view scale = key.scale == ColorScale::log        ? "log"
                                 : key.scale == ColorScale::quantile ? "quantile"
                                                                     : "linear";
  return {{"by", by}, {"scale", scale}, {"range", {key.range.low, key.range.high}}};
}

Json relaxationJson(const RelaxFigures& figures) {
  // With weights there is no reference to compare with.
  const auto part = [](double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); };
  return {{"method", figures.method},
          {"diagrams", figures.diagrams},
          {"end", figures.end},
          {"energy", {figures.first.energy, figures.last.energy}},
          {"hexagonal", {part(figures.first.hexagonal), part(figures.last.hexagonal)}},
          {"farthest", {figures.first.farthest, figures.last.farthest}}};
}

Json transportJson(const TransportFigures& figures) {
  const TransportStep& last = figures.last;
  return {{"surface", figures.free_surface ? Json("free") : Json(nullptr)},
          {"diagrams", figures.diagrams},
          {"newton", figures.newton},
          {"end", figures.end},
          {"worst", last.worst},
          {"norm", last.norm},
          {"mass", figures.mass},
          {"cost", figures.cost}};
}

Json fluidJson(const FluidFigures& figures) {
  const FluidStep &first = figures.first, &last = figures.last;
  return {{"scheme", figures.scheme},
          {"epsilon", figures.scheme == "springs" ? Json(figures.epsilon) : Json(nullptr)},
          {"end", figures.end},
          {"step", {first.step, last.step}},
          {"time", {first.time, last.time}},
          {"kinetic", {first.kinetic, last.kinetic}},
          {"potential", {first.potential, last.potential}},
          {"spring", {first.spring, last.spring}},
          {"energy", {first.energy(), last.energy()}},
          {"energy_drift", figures.drift},
          {"momentum", {last.momentum.x, last.momentum.y}},
          {"worst_area", figures.worst},
          {"farthest", {first.farthest, last.farthest}}};
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
  json["projection"] = nullptr;
  if (input.projection) {
    const Point center = input.projection->center();
    json["projection"] = {
        {"name", "Lambert azimuthal equal-area"}, {"center", {center.x, center.y}}, {"unit", "km"}};
  }
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
  const std::string_view revision = bench::revision();
  json["revision"] = revision.empty() ? Json(nullptr) : Json(revision);
  json["command"] = stats.command;
  addLog(json, stats.log);
  json["backend"] = report.backend;
  json["device"] = report.device;
  json["driver"] = report.driver;
  json["choice"] = stats.log.choice.empty() ? Json(nullptr) : Json(stats.log.choice);
  json["notes"] = report.notes;
  json["search"] = searchText(stats.log.search);
  json["threads"] = threadCount(stats.log.threads);
  json["sites"] = stats.tiles ? stats.tiles->sites : stats.input.sites.size();
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
  if (stats.relaxation) json["relaxation"] = relaxationJson(*stats.relaxation);
  if (stats.transport) json["transport"] = transportJson(*stats.transport);
  if (stats.fluid) json["fluid"] = fluidJson(*stats.fluid);
  if (const auto& tiles = stats.tiles)
    json["tiles"] = {{"count", tiles->tiles}, {"largest", tiles->largest}, {"open", tiles->open}};
  json["time_ms"] = {
      {"read", time(stats.input.read_ms)}, {"order", time(times.order)},    {"upload", time(times.upload)},
      {"search", time(times.search)},      {"cells", time(times.cells)},    {"draw", time(times.draw)},
      {"download", time(times.download)},  {"write", time(stats.write_ms)}, {"total", time(stats.total_ms)}};
  json["pipelines"] = Json::array();
  for (const PipelineTime& made : report.pipelines)
    json["pipelines"].push_back({{"name", made.name}, {"time_ms", made.milliseconds}});
  json["forecast_memory_bytes"] = stats.forecast;
  json["peak_memory_bytes"] = peakMemoryBytes();
  return jsonText(json, 2);
}

}  // namespace vorpipe::cli

#include "cli/stats.h"

#include <fmt/core.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <utility>

#include "base/option_names.h"
#include "base/parallel.h"
#include "bench/machine.h"
#include "io/base/error.h"
#include "io/base/field_text.h"

namespace vorpipe::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Hashes the bytes that it passes on.
class HashingSink final : public ByteSink {
 public:
  explicit HashingSink(ByteSink& to) : ByteSink(to.name()), to_(to) {}
  Result<void> write(std::string_view bytes) override {
    hash_.add(bytes);
    return to_.write(bytes);
  }
  [[nodiscard]] Contents contents() const { return hash_.contents(); }

 private:
  ByteSink& to_;
  ContentHash hash_;
};

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

/// What is wrong; empty: nothing.
using Problem = std::string;

std::string textAt(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

Problem readArguments(const nlohmann::json& object, RecordedRun& run) {
  const auto found = object.find("arguments");
  if (found == object.end()) {
    return "has no \"arguments\": an older version wrote it, or it is not from --stats";
  }
  const bool texts = found->is_array() && std::ranges::all_of(*found, [](const nlohmann::json& value) {
                       return value.is_string();
                     });
  if (!texts || found->empty()) return "\"arguments\" is no list of texts";
  run.arguments = found->get<std::vector<std::string>>();
  return {};
}

Problem readFiles(const nlohmann::json& object, const char* key, std::vector<WrittenFile>& files) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_array()) return fmt::format("has no list \"{}\"", key);
  for (const nlohmann::json& entry : *found) {
    const auto bytes = entry.is_object() ? entry.find("bytes") : entry.end();
    const bool whole = entry.is_object() && bytes != entry.end() && bytes->is_number_unsigned() &&
                       !textAt(entry, "path").empty() && !textAt(entry, "xxh128").empty();
    if (!whole) {
      return fmt::format("\"{}\", number {}: has no \"path\", \"bytes\" and \"xxh128\"", key,
                         files.size() + 1);
    }
    files.push_back({{textAt(entry, "path"), {bytes->get<std::uint64_t>(), textAt(entry, "xxh128")}},
                     textAt(entry, "xxh128_without_times")});
  }
  return {};
}

}  // namespace

RunLog::RunLog(const Invocation& invocation, bool stats_wanted)
    : invocation_(invocation),
      hashes_(stats_wanted || invocation.stats != nullptr),
      reads_(hashes_ ? ReadLog::Notes::contents : ReadLog::Notes::names) {}

Result<void> RunLog::noteOutput(ByteSink& to, const std::function<Result<void>(ByteSink&)>& write) {
  if (!hashes_) return write(to);
  HashingSink hashing(to);
  auto written = write(hashing);
  if (written) outputs_.push_back({{to.name(), hashing.contents()}, std::exchange(timeless_, {})});
  return written;
}

Result<void> RunLog::writeTimed(ByteSink& to, const std::function<std::string(bool with_times)>& text) {
  if (hashes_) {
    ContentHash hash;
    hash.add(text(false));
    timeless_ = hash.contents().xxh128;
  }
  return to.write(text(true));
}

void addSums(Json& json, const Diagram& diagram) {
  json["area_sum"] = areaSum(diagram);
  if (!diagram.mass.empty())
    json["mass_sum"] = std::accumulate(diagram.mass.begin(), diagram.mass.end(), 0.0);
}

Json resolvedJson(const Report& report) {
  return {{"retried", report.retried},
          {"double", report.in_double},
          {"exact", report.exact},
          {"pixels", report.pixels}};
}

void addShape(Json& json, const Input& input) {
  const auto& weight = input.sites.weight;
  const auto& rings = input.outline.ring_offsets;
  json["outline"] = nullptr;
  if (!input.outline.empty()) {
    json["outline"] = {{"polygons", input.outline.polygon_offsets.size() - 1}, {"rings", rings.size() - 1}};
  }
  json["periodic"] = input.periodic == Periodic::none ? Json(nullptr) : Json(nameOf(input.periodic));
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
  json["sites"] = stats.input.sites.size();
  json["seed"] = stats.input.seed ? Json(*stats.input.seed) : Json(nullptr);
  json["domain"] = {domain.xmin, domain.ymin, domain.xmax, domain.ymax};
  addShape(json, stats.input);
  json["status"] = {{"ok", report.ok}, {"empty", report.empty}, {"duplicate", report.duplicate}};
  json["hidden"] = stats.input.sites.weight.empty() ? Json(nullptr) : Json(report.hidden);
  json["resolved"] = resolvedJson(report);
  for (const char* figure : {"area_sum", "mass_sum", "color"}) json[figure] = nullptr;
  stats.addFigures(json);
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

Result<RecordedRun> recordedRun(const std::string& name, std::string_view text) {
  const nlohmann::json object = nlohmann::json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (object.is_discarded()) return inputError(name + ": is no JSON");
  if (!object.is_object()) return inputError(name + ": is no JSON object, as --stats writes");
  RecordedRun run;
  Problem problem = readArguments(object, run);
  std::vector<WrittenFile> inputs;
  if (problem.empty()) problem = readFiles(object, "inputs", inputs);
  if (problem.empty()) problem = readFiles(object, "outputs", run.outputs);
  if (!problem.empty()) return inputError(fmt::format("{}: {}", name, problem));
  for (WrittenFile& input : inputs) run.inputs.push_back(std::move(input.file));
  run.version = textAt(object, "version");
  run.revision = textAt(object, "revision");
  run.backend = textAt(object, "backend");
  run.device = textAt(object, "device");
  return run;
}

}  // namespace vorpipe::cli

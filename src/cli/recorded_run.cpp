#include "cli/recorded_run.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "io/base/error.h"
#include "io/base/input_file.h"

namespace vorpipe::cli {
namespace {

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

Result<RecordedRun> readRecordedRun(const std::string& path) {
  auto file = InputFile::open(path);
  if (!file) return tl::unexpected(std::move(file.error()));
  constexpr std::size_t most = std::size_t{1} << 24;
  const auto text = readText(*file, most);
  if (!text) return tl::unexpected(text.error());
  return recordedRun(file->name(), *text);
}

}  // namespace vorpipe::cli

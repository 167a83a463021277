#include "cli/fluid_folders.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "io/base/error.h"
#include "io/base/output_file.h"
#include "io/base/quoted.h"

namespace vorpipe::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view list_of_series = "series.pvd";

/// Returns the names in a folder, except leftovers of killed runs; none if there is no folder.
Result<std::vector<std::string>> namesIn(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code code;
  if (!fs::exists(folder, code)) return names;
  for (fs::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code)) {
    std::string name = entry->path().filename().string();
    if (!isLeftOver(name)) names.push_back(std::move(name));
  }
  if (code) return inputError(fmt::format("{}: {}", folder, code.message()));
  std::ranges::sort(names);
  return names;
}

/// Returns the number between `begin` and `end` in a name, if it has at least `digits` digits.
std::optional<std::uint64_t> numberIn(std::string_view name, std::string_view begin, std::string_view end,
                                      std::size_t digits) {
  if (!name.starts_with(begin) || !name.ends_with(end)) return std::nullopt;
  if (name.size() < begin.size() + digits + end.size()) return std::nullopt;
  std::uint64_t number = 0;
  const char* const last = name.data() + name.size() - end.size();
  const auto [stop, error] = std::from_chars(name.data() + begin.size(), last, number);
  return error == std::errc() && stop == last ? std::optional(number) : std::nullopt;
}

std::optional<std::uint64_t> stepIn(std::string_view name) { return numberIn(name, "step-", ".vtp", 6); }

tl::unexpected<Error> strange(const std::string& folder, const std::string& name, std::string_view what) {
  return inputError(fmt::format("{}: holds {}, which is none of {}", folder, vorpipe::inQuotes(name), what));
}

}  // namespace

std::string seriesFileOf(std::uint64_t step) { return fmt::format("step-{:06}.vtp", step); }

Result<void> openSeries(const std::string& folder) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (code) return inputError(fmt::format("{}: {}", folder, code.message()));
  const auto names = namesIn(folder);
  if (!names) return tl::unexpected(names.error());
  if (names->empty()) return {};
  return inputError(folder + ": the folder holds something; a series wants an empty one");
}

Result<std::vector<SeriesStep>> goOnWithSeries(const std::string& folder, const FluidState& from) {
  const auto names = namesIn(folder);
  if (!names) return tl::unexpected(names.error());
  if (names->empty()) return openSeries(folder).map([] { return std::vector<SeriesStep>(); });
  for (const std::string& name : *names) {
    if (name != list_of_series && !stepIn(name)) return strange(folder, name, "a series");
  }
  auto steps = readSeries((fs::path(folder) / list_of_series).string());
  if (!steps) return steps;
  std::erase_if(*steps, [&](const SeriesStep& step) { return stepIn(step.file).value_or(0) > from.step; });
  const bool has_step = !steps->empty() && stepIn(steps->back().file) == from.step;
  if (has_step && steps->back().time == from.time) return steps;
  return inputError(
      fmt::format("{}: its series has no step {} at time {}, which the checkpoint is of; name another "
                  "folder",
                  folder, from.step, from.time));
}

Result<NextFrame> goOnWithFrames(const std::string& folder, std::uint64_t step, std::uint64_t every) {
  const auto names = namesIn(folder);
  if (!names) return tl::unexpected(names.error());
  const std::uint64_t own = 1 + step / every;
  if (names->empty()) return NextFrame{own, false};
  std::uint64_t last = 0;
  for (const std::string& name : *names) {
    const auto number = numberIn(name, "frame-", ".png", 5);
    if (!number) return strange(folder, name, "numbered pictures");
    last = std::max(last, *number);
  }
  // The next picture may be of a step without a checkpoint: a run ended there, or before the checkpoint.
  if (last == own || last == own + 1) return NextFrame{own + 1, true};
  return inputError(fmt::format(
      "{}: its last picture is {}, where a run with --every {} has {} up to step {}; name another folder",
      folder, last, every, own, step));
}

}  // namespace vorpipe::cli

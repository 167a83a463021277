#include "cli/run_end.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cassert>

#include "cli/progress.h"

namespace vorpipe::cli {

Error nothingToDo(std::string_view example) {
  return {ErrorCode::input,
          fmt::format("-o: name what to write, as in -o {} (or give --stats or --check)", example)};
}

bool validationIsSilent(const Report& report, std::string_view name) {
  for (const std::string& message : report.validation_messages) {
    printError(fmt::format("validation: {}{}{}", name, name.empty() ? "" : ": ", message));
  }
  return report.validation_messages.empty();
}

Result<bool> passesCheck(const Result<std::vector<std::string>>& broken) {
  if (!broken) return tl::unexpected(broken.error());
  for (const std::string& promise : *broken) printError("--check: " + promise);
  return broken->empty();
}

Result<std::vector<OutputFile>> openOutputs(std::span<const std::string> paths) {
  stopOnSignals();
  auto files = createOutputs(paths);
  if (files) removeOnSignals(*files);
  return files;
}

Result<void> writeOutputs(std::span<OutputFile> files, std::span<const Writer> writers) {
  assert(files.size() == writers.size());
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (const auto written = writers[i](files[i]); !written) return written;
  }
  ignoreSignals();
  if (const auto go_on = stopIfAsked(); !go_on) return go_on;
  return commitAll(files);
}

std::string outcomeText(std::span<const std::string> paths, const Report& report) {
  return fmt::format("{}{}{} cells ({} empty, {} duplicate)", fmt::join(paths, ", "),
                     paths.empty() ? "" : ": ", report.ok, report.empty, report.duplicate);
}

std::string runText(const Report& report, double milliseconds, bool checked) {
  return fmt::format("{} on {}, {:.3f} s{}", report.backend, report.device, milliseconds / 1000,
                     checked ? ", checked" : "");
}

}  // namespace vorpipe::cli

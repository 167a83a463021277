#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/try.h"
#include "bench/child.h"
#include "bench/tables.h"

namespace vorpipe::bench {
namespace {

struct Kind {
  const char* what;
  const char* command;
  std::vector<std::string> arguments;
};

/// The settings as the options of a run.
std::vector<std::string> optionsOf(const Settings& settings, const std::string& backend) {
  const BackendOptions& options = settings.options;
  std::vector<std::string> words = {"--backend", backend, "--quiet"};
  if (!options.device.empty()) words.insert(words.end(), {"--device", options.device});
  if (options.threads > 0) words.insert(words.end(), {"--threads", std::to_string(options.threads)});
  for (const auto& feature : options.mask.disabled) words.insert(words.end(), {"--disable", feature});
  for (const auto& [name, value] : options.mask.limits) {
    words.insert(words.end(), {"--limit", fmt::format("{}={}", name, value)});
  }
  return words;
}

/// The peak of a run in bytes, as its --stats report.
Result<std::uint64_t> peakOf(const Lab& lab, const Kind& kind, const std::string& backend,
                             std::uint64_t sites, const std::string& folder,
                             const std::function<bool()>& go_on) {
  const std::string stats = folder + "/stats.json";
  std::vector<std::string> words = {kind.command, "--sites", fmt::format("random:{}", sites), "--stats",
                                    stats};
  const auto options = optionsOf(lab.settings(), backend);
  words.insert(words.end(), options.begin(), options.end());
  words.insert(words.end(), kind.arguments.begin(), kind.arguments.end());
  VORPIPE_TRY(runChild(lab.settings().program, words, folder + "/errors", go_on));
  std::ifstream file(stats);
  const auto json = nlohmann::json::parse(file, nullptr, false);
  const auto peak = json.find("peak_memory_bytes");
  if (json.is_discarded() || peak == json.end() || !peak->is_number_unsigned()) {
    return tl::unexpected(Error{ErrorCode::device, "the run did not say what memory it took"});
  }
  return peak->get<std::uint64_t>();
}

std::vector<Kind> kindsIn(const std::string& folder) {
  return {{"cells: measures", "cells", {}},
          {"cells: everything", "cells", {"-o", folder + "/cells.npz"}},
          {"picture 500 x 500", "render", {"-o", folder + "/picture.png", "--size", "500x500"}}};
}

/// Runs one kind on one backend with increasing numbers of sites.
Result<void> addRows(Lab& lab, const Kind& kind, const std::string& backend,
                     const std::vector<std::uint64_t>& sizes, const std::string& folder,
                     const std::function<bool()>& go_on, Table& table, Curve& curve) {
  std::uint64_t peak_before = 0, sites_before = 0;
  for (const auto sites : sizes) {
    const auto peak = peakOf(lab, kind, backend, sites, folder, go_on);
    if (!peak && peak.error().code == ErrorCode::cancelled) return tl::unexpected(peak.error());
    std::vector<Cell> row = {backend, std::string(kind.what), sites};
    if (peak) {
      const auto bytes = static_cast<double>(*peak), count = static_cast<double>(sites);
      row.insert(row.end(), {1e-6 * bytes, bytes / count});
      row.push_back(peak_before > 0 ? Cell((bytes - static_cast<double>(peak_before)) /
                                           (count - static_cast<double>(sites_before)))
                                    : Cell(Missing{}));
      curve.points.emplace_back(count, 1e-6 * bytes);
      peak_before = *peak;
      sites_before = sites;
    } else {
      const bool tried = peak.error().code != ErrorCode::input;
      if (tried) lab.noteFailure(fmt::format("{}, {}: {}", backend, kind.what, peak.error().message));
      row.insert(row.end(),
                 {Missing{(tried ? "" : "not tried: ") + peak.error().message}, Missing{}, Missing{}});
    }
    table.rows.push_back(std::move(row));
  }
  return {};
}

}  // namespace

Result<Findings> memory(Lab& lab) {
  const Settings& settings = lab.settings();
  const std::vector<std::uint64_t> wanted = {10'000, 100'000, 1'000'000, 10'000'000};
  const auto sizes = sizesUpTo(wanted, settings.max_sites);
  Table table{"memory",
              "Memory: the peak of one run in a process of its own, random sites",
              {{"backend", "backend"},
               {"job", "job"},
               {"sites", "sites"},
               {"peak_megabytes", "peak, MB"},
               {"bytes_per_site", "bytes per site"},
               {"bytes_per_further_site", "bytes per further site"}}};
  Findings findings;
  Plot plot{"Peak memory, cells: measures", "sites", "MB", {}};
  const TemporaryFolder folder;
  if (folder.path().empty()) {
    table.notes = {"Not measured: no temporary folder can be made here."};
    return Findings{{std::move(table)}, {}};
  }
  // Output to it is counted and discarded.
  std::error_code ignored;
  std::filesystem::create_symlink("/dev/null", folder.path() + "/cells.npz", ignored);
  const auto kinds = kindsIn(folder.path());
  const auto all = static_cast<double>(kinds.size() * settings.backends.size());
  double done = 0;
  const auto go_on = [&] { return !settings.progress || settings.progress("memory", done / all); };
  for (const auto& backend : settings.backends) {
    for (const Kind& kind : kinds) {
      Curve curve{backend, {}};
      VORPIPE_TRY(addRows(lab, kind, backend, sizes, folder.path(), go_on, table, curve));
      if (&kind == &kinds.front()) plot.curves.push_back(std::move(curve));
      ++done;
    }
  }
  table.notes = noteOfLimit(lab, wanted.back());
  table.notes.emplace_back(
      "One run each. The program, its libraries and the driver are part of it, and so is what a software "
      "device holds; the memory of a graphics card is not. Everything is written as .npz, to /dev/null.");
  findings.tables = {std::move(table)};
  findings.plots = {std::move(plot)};
  return findings;
}

}  // namespace vorpipe::bench

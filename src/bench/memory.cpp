#include <fcntl.h>
#include <fmt/core.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <thread>

#include "base/try.h"
#include "bench/tables.h"

#ifdef __APPLE__
extern char** environ;
#endif

namespace vorpipe::bench {
namespace {

constexpr auto glance = std::chrono::milliseconds(20);
constexpr mode_t readable = 0600;

tl::unexpected<Error> failure(std::string message) {
  return tl::unexpected(Error{ErrorCode::device, std::move(message)});
}

std::string lastLine(const std::string& path) {
  std::ifstream file(path);
  std::string last;
  for (std::string line; std::getline(file, line);) {
    if (!line.empty()) last = line;
  }
  return last;
}

Result<pid_t> start(const std::string& program, const std::vector<std::string>& arguments,
                    const std::string& errors) {
  std::vector<std::string> words = {program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  const std::unique_ptr<posix_spawn_file_actions_t, int (*)(posix_spawn_file_actions_t*)> release(
      &files, posix_spawn_file_actions_destroy);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                   readable);
  pid_t child = 0;
  const int code = posix_spawn(&child, program.c_str(), &files, nullptr, pointers.data(), environ);
  if (code != 0) return failure(fmt::format("{}: {}", program, std::strerror(code)));
  return child;
}

/// A temporary folder that exists as long as this object.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::error_code none;
    std::string name = (std::filesystem::temp_directory_path(none) / "vorpipe-bench-XXXXXX").string();
    if (!none && mkdtemp(name.data()) != nullptr) path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  /// Empty if it could not be made.
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// Runs `program` with arguments, its standard error in the file `errors`, and waits for it. Errors: it
/// refused its arguments with exit code 2 (input), could not be started or failed (device), in the words of
/// its last line; `keep_running` returned false, and it was ended (cancelled).
Result<void> runChild(const std::string& program, const std::vector<std::string>& arguments,
                      const std::string& errors, const std::function<bool()>& keep_running) {
  VORPIPE_LET(child, start(program, arguments, errors));
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (!keep_running()) {
      kill(child, SIGKILL);
      waitpid(child, &status, 0);
      return tl::unexpected(Error{ErrorCode::cancelled, "interrupted"});
    }
    std::this_thread::sleep_for(glance);
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  const std::string said = lastLine(errors);
  if (WIFSIGNALED(status)) {
    return failure(fmt::format("ended by signal {}{}{}", WTERMSIG(status), said.empty() ? "" : ": ", said));
  }
  constexpr std::string_view name = "vorpipe: ";
  constexpr int refused = 2;
  return tl::unexpected(Error{WEXITSTATUS(status) == refused ? ErrorCode::input : ErrorCode::device,
                              said.starts_with(name) ? said.substr(name.size()) : said});
}

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
                             const std::function<bool()>& keep_running) {
  const std::string stats = folder + "/stats.json";
  std::vector<std::string> words = {kind.command, "--sites", fmt::format("random:{}", sites), "--stats",
                                    stats};
  const auto options = optionsOf(lab.settings(), backend);
  words.insert(words.end(), options.begin(), options.end());
  words.insert(words.end(), kind.arguments.begin(), kind.arguments.end());
  VORPIPE_TRY(runChild(lab.settings().program, words, folder + "/errors", keep_running));
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
                     const std::function<bool()>& keep_running, Table& table, Curve& curve) {
  std::uint64_t peak_before = 0, sites_before = 0;
  for (const auto sites : sizes) {
    const auto peak = peakOf(lab, kind, backend, sites, folder, keep_running);
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
  const auto sizes = upTo(wanted, settings.max_sites);
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
  const auto keep_running = [&] { return !settings.progress || settings.progress("memory", done / all); };
  for (const auto& backend : settings.backends) {
    for (const Kind& kind : kinds) {
      Curve curve{backend, {}};
      VORPIPE_TRY(addRows(lab, kind, backend, sizes, folder.path(), keep_running, table, curve));
      if (&kind == &kinds.front()) plot.curves.push_back(std::move(curve));
      ++done;
    }
  }
  table.notes = noteIfCut("--max-sites", lab.settings().max_sites, wanted.back());
  table.notes.emplace_back(
      "One run each. The program, its libraries and the driver are part of it, and so is what a software "
      "device holds; the memory of a graphics card is not. Everything is written as .npz, to /dev/null.");
  findings.tables = {std::move(table)};
  findings.plots = {std::move(plot)};
  return findings;
}

}  // namespace vorpipe::bench

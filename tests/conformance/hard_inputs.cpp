/// Runs random hard inputs on every backend for --seconds, and prints the promises that are broken. The exit
/// code is 1 if one is.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "support/devices/backends.h"
#include "support/hard/hard_files.h"

namespace vorpipe::test {
namespace {

struct Wanted {
  double seconds = 60;
  std::string seed = "random";
  std::uint64_t first = 0;
  std::optional<std::uint64_t> only;
  std::vector<std::string> backends{"all"};
  std::string folder, like;
  std::uint64_t shown = 10, shrunk = 1;
  double shrink_seconds = 10;
  bool no_cells = false, no_pictures = false, list = false;
};

void addOptions(CLI::App& app, Wanted& wanted) {
  app.add_option("--seconds", wanted.seconds, "how long new inputs are begun")->capture_default_str();
  app.add_option("--seed", wanted.seed, "a number, or random: a new one, which is printed")
      ->capture_default_str();
  app.add_option("--first", wanted.first, "number of the first input")->capture_default_str();
  app.add_option("--case", wanted.only, "this one alone");
  app.add_option("--like", wanted.like,
                 "only inputs whose description has this in it, as in 'lifted weights'");
  app.add_option("--backends", wanted.backends, "names, or all that can be used")->delimiter(',');
  app.add_option("--write", wanted.folder, "where inputs that fail are written, made smaller");
  app.add_option("--shown", wanted.shown, "faults of each kind that are printed")->capture_default_str();
  app.add_option("--shrunk", wanted.shrunk, "faults of each kind whose inputs are made smaller")
      ->capture_default_str();
  app.add_option("--shrink", wanted.shrink_seconds, "seconds that making one smaller may take")
      ->capture_default_str();
  app.add_flag("--no-cells", wanted.no_cells, "only pictures");
  app.add_flag("--no-pictures", wanted.no_pictures, "only cells");
  app.add_flag("--list", wanted.list, "names every input before it is run");
}

double secondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

std::uint64_t seedOf(const std::string& text) {
  if (text == "random") return std::random_device()();
  std::uint64_t seed = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (code != std::errc() || end != text.data() + text.size())
    throw CLI::ValidationError("--seed", "is a number or random");
  return seed;
}

bool isValidated() {
  const char* value = std::getenv("VORPIPE_VALIDATION");
  return value != nullptr && std::string_view(value) == "1";
}

Result<std::vector<Session>> openAll(const std::vector<std::string>& named) {
  std::vector<Session> sessions;
  const bool all = named == std::vector<std::string>{"all"};
  for (const auto& name :
       all ? std::vector<std::string>(backend_names.begin(), backend_names.end()) : named) {
    if (const auto reason = whyUnusable(name); all && !reason.empty() && !isExpected(name)) {
      fmt::print("{} is left out: {}\n", name, reason);
      continue;
    }
    BackendOptions options;
    options.name = name;
    options.validation = isValidated();
    auto session = Session::open(options);
    if (!session) return tl::unexpected(session.error());
    sessions.push_back(std::move(*session));
  }
  return sessions;
}

/// The input that is being run, for sayUnderWay().
std::string under_way;

/// Prints the input that was run when a failed assertion or a segmentation fault ended the process.
extern "C" void sayUnderWay(int signal) {
  [[maybe_unused]] const auto written = write(STDOUT_FILENO, under_way.data(), under_way.size());
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

/// What has been run, and what failed.
class Findings {
 public:
  Findings(const Wanted& wanted, std::vector<Session>& sessions) : wanted_(wanted) {
    for (auto& session : sessions) sessions_.push_back(&session);
  }

  void run(const HardInput& input) {
    ++inputs_;
    sites_ += input.sites.size();
    const auto description = describe(input);
    if (wanted_.list) fmt::print("{}\n", description);
    std::fflush(stdout);
    under_way.assign(description).append(" ends the process\n");
    const auto result = runHardInput(
        input, sessions_, {!wanted_.no_cells, !wanted_.no_pictures, input.sites.size() < 500 ? 1 : 0});
    if (result.refused) {
      ++refused_;
      if (wanted_.list) fmt::print("  refused: {}\n", result.refusal);
    }
    if (!result.faults.empty()) ++failed_;
    for (const auto& fault : result.faults) note(input, fault);
  }

  /// Returns whether all promises are kept.
  [[nodiscard]] bool report() const {
    fmt::print("{} inputs of {} sites in all, {} refused, {} failed\n", inputs_, sites_, refused_, failed_);
    for (const auto& [kind, count] : kinds_) fmt::print("  {:5} x {}\n", count, kind);
    // An input that is refused tests nothing, so that few may be.
    if (10 * refused_ > inputs_ && inputs_ > 20) {
      fmt::print("more than a tenth was refused\n");
      return false;
    }
    return failed_ == 0;
  }

 private:
  void note(const HardInput& input, const HardFault& fault) {
    const auto times = ++kinds_[fault.kind()];
    if (times > wanted_.shown) return;
    fmt::print("FAULT {}\n  {} {}: {}\n", describe(input), fault.backend, fault.run, fault.message);
    if (times <= wanted_.shrunk) shrink(input, fault);
    std::fflush(stdout);
  }

  void shrink(const HardInput& input, const HardFault& fault) {
    std::vector<Session*> both{sessions_.front()};
    for (auto* const session : sessions_) {
      if (session->device().backend == fault.backend && session != both.front()) both.push_back(session);
    }
    const auto least = shrunken(input, fault, both, wanted_.shrink_seconds);
    const auto folder = wanted_.folder.empty() ? std::string(".") : wanted_.folder;
    const auto stem =
        fmt::format("{}/{}-{}-{}-{}", folder, fault.backend, fault.run, input.seed, input.number);
    fmt::print("  {} of {} sites do as well: {}\n", least.sites.size(), input.sites.size(),
               commandOf(least, fault, stem));
    if (wanted_.folder.empty()) {
      fmt::print("  --write FOLDER writes the file\n");
    } else {
      writeHardInput(least, stem);
    }
  }

  const Wanted& wanted_;
  std::vector<Session*> sessions_;
  std::uint64_t inputs_ = 0, sites_ = 0, refused_ = 0, failed_ = 0;
  std::map<std::string, std::uint64_t> kinds_;
};

int run(int argc, char** argv) {
  Wanted wanted;
  CLI::App app("Runs hard inputs, which are new every time.");
  addOptions(app, wanted);
  CLI11_PARSE(app, argc, argv);
  const auto begin = std::chrono::steady_clock::now();
  const auto seed = seedOf(wanted.seed);
  auto sessions = openAll(wanted.backends);
  if (!sessions) {
    fmt::print(stderr, "hard_inputs: {}\n", sessions.error().message);
    return 3;
  }
  if (!wanted.folder.empty()) std::filesystem::create_directories(wanted.folder);
  fmt::print("seed {}\n", seed);
  for (const int fatal : {SIGABRT, SIGSEGV, SIGFPE}) std::signal(fatal, sayUnderWay);
  Findings findings(wanted, *sessions);
  if (wanted.only) {
    findings.run(makeHardInput(seed, *wanted.only));
  } else {
    for (auto number = wanted.first; secondsSince(begin) < wanted.seconds; ++number) {
      const auto input = makeHardInput(seed, number);
      if (describe(input).find(wanted.like) != std::string::npos) findings.run(input);
    }
  }
  return findings.report() ? 0 : 1;
}

}  // namespace
}  // namespace vorpipe::test

int main(int argc, char** argv) {
  try {
    return vorpipe::test::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "hard_inputs: {}\n", error.what());
    return 2;
  }
}

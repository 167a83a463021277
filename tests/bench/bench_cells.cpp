/// How fast cells are: vorpipe's backends and other programs on the same sites, all of it in one run,
/// repeated in random order, so that what else the machine does falls on all alike. First each has to be
/// right.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/cells_contest.h"
#include "bench/driver_threads.h"
#include "cli/kept_memory.h"
#include "io/sites/sites_file.h"

namespace vorpipe::test {
namespace {

struct Wanted {
  std::uint64_t sites = 1000000;
  std::uint64_t seed = 1;
  double weights = 0;
  int repetitions = 7;
  bool polygons = false;
  std::vector<int> threads{0};
  std::vector<std::string> backends{"vulkan-compute", "cpu"};
  std::vector<std::string> patterns{"random"};
  std::vector<std::string> peers;
  std::string node_modules = NODE_MODULES;
  std::string json;
};

constexpr std::string_view d3_name = "d3";

std::string peerNames() {
  std::string names;
  for (const auto& peer : builtPeers()) names += peer.name + ", ";
  return names.append(d3_name);
}

void addOptions(CLI::App& app, Wanted& wanted) {
  std::string patterns;
  for (const auto* kinds : {&dataSetKinds(), &weightedSetKinds()}) {
    for (const auto& kind : *kinds) patterns += fmt::format("\n  {}: {}", kind.name, kind.difficulty);
  }
  app.footer("Patterns:" + patterns);
  app.add_option("--sites", wanted.sites, "how many")->capture_default_str();
  app.add_option("--seed", wanted.seed, "of sites and weights")->capture_default_str();
  app.add_option(
         "--weights", wanted.weights,
         "random weights for those without: up to this many squares of the mean distance of neighbors")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--patterns", wanted.patterns, "names, or all without weights; or files of sites")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--backends", wanted.backends, "names")->delimiter(',')->capture_default_str();
  app.add_option("--threads", wanted.threads, "of vorpipe, one line for each; 0 is all")
      ->delimiter(',')
      ->capture_default_str();
  app.add_flag("--polygons", wanted.polygons, "all of vorpipe's diagram, not its measures alone");
  app.add_option("--peers", wanted.peers, "names, or none; all by default: " + peerNames())->delimiter(',');
  app.add_option("--node-modules", wanted.node_modules, "where npm has put d3-delaunay")
      ->capture_default_str();
  app.add_option("--repetitions", wanted.repetitions, "of each measurement; 0: only check that all agree")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  app.add_option("--json", wanted.json, "a file to write the figures to");
}

/// Those that are named, or all; notes say which are not there, and why.
Result<std::vector<Peer>> choosePeers(const Wanted& wanted, std::vector<std::string>& notes) {
  std::vector<Peer> chosen;
  if (wanted.peers == std::vector<std::string>{"none"}) return chosen;
  auto all = builtPeers();
  if (auto d3 = d3Delaunay(wanted.node_modules)) {
    all.push_back(std::move(*d3));
  } else {
    notes.push_back(d3.error().message + ": not measured");
  }
  if (wanted.peers.empty()) return all;
  for (const auto& name : wanted.peers) {
    const auto found = std::ranges::find(all, name, &Peer::name);
    if (found == all.end())
      return tl::unexpected(Error{ErrorCode::input, fmt::format("--peers: no {} here", name)});
    chosen.push_back(std::move(*found));
    all.erase(found);
  }
  return chosen;
}

Result<void> openSessions(const Wanted& wanted, Contestants& contestants) {
  for (const auto& name : wanted.backends) {
    for (const int threads : wanted.threads) {
      BackendOptions options;
      options.name = name;
      options.threads = threads;
      setDriverThreads(threads);
      auto session = Session::open(options);
      if (!session) return tl::unexpected(session.error());
      contestants.sessions.push_back({std::move(*session), threads});
    }
  }
  return {};
}

/// A file's sites, where the pattern names one; else those of the pattern.
Result<DataSet> makeSet(const std::string& pattern, const Wanted& wanted) {
  const std::filesystem::path path = pattern;
  if (!path.has_extension()) return makeDataSet(pattern, wanted.sites, wanted.seed);
  auto table = readSites(pattern);
  if (!table) return tl::unexpected(table.error());
  const Box domain = boxAround(table->sites);
  return DataSet{path.stem().string(), std::move(table->sites), domain};
}

Result<void> makeRounds(const Wanted& wanted, std::deque<Round>& rounds) {
  BackendOptions cpu;
  cpu.name = "cpu";
  auto judge = Session::open(cpu);
  if (!judge) return tl::unexpected(judge.error());
  for (const auto& pattern : wanted.patterns) {
    auto set = makeSet(pattern, wanted);
    if (!set) return tl::unexpected(set.error());
    Round round{makeInput(std::move(*set), wanted.weights, wanted.seed), {}};
    CellsOptions options{};
    options.domain = round.input.set.domain;
    auto reference = judge->cells(round.input.set.sites, options);
    if (!reference) return tl::unexpected(reference.error());
    round.reference = std::move(*reference);
    rounds.push_back(std::move(round));
  }
  return {};
}

Result<bool> measure(const Wanted& wanted) {
  Contestants contestants;
  std::vector<std::string> notes;
  auto peers = choosePeers(wanted, notes);
  if (!peers) return tl::unexpected(peers.error());
  contestants.peers = std::move(*peers);
  contestants.detail = wanted.polygons ? Detail::everything : Detail::measures;
  if (auto opened = openSessions(wanted, contestants); !opened) return tl::unexpected(opened.error());
  std::deque<Round> rounds;
  if (auto made = makeRounds(wanted, rounds); !made) return tl::unexpected(made.error());
  Contests contests;
  addContests(contestants, rounds, contests);
  return contests.hold("bench_cells", wanted.repetitions, notes, wanted.json);
}

int run(int argc, char** argv) {
  Wanted wanted;
  CLI::App app("Measures cells of vorpipe and of other programs, which are single-threaded.");
  addOptions(app, wanted);
  CLI11_PARSE(app, argc, argv);
  if (wanted.patterns == std::vector<std::string>{"all"}) {
    wanted.patterns.clear();
    for (const auto& kind : dataSetKinds()) wanted.patterns.emplace_back(kind.name);
  }
  const auto right = measure(wanted);
  if (right) return *right ? 0 : 1;
  fmt::print(stderr, "bench_cells: {}\n", right.error().message);
  return right.error().code == ErrorCode::input ? 2 : 3;
}

}  // namespace
}  // namespace vorpipe::test

int main(int argc, char** argv) {
  vorpipe::keepFreedMemory();
  try {
    return vorpipe::test::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_cells: {}\n", error.what());
    return 2;
  }
}

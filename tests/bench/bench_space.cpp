/// How fast cells in space are: vorpipe and other programs on the same sites, as bench_cells has it of the
/// plane.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <deque>
#include <exception>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "bench/contest.h"
#include "bench/space_agreement.h"
#include "cli/kept_memory.h"
#include "io/sites/space_source.h"
#include "support/sites/random_sites.h"

namespace vorpipe::test {
namespace {

constexpr Box3 unit_cube{0, 0, 0, 1, 1, 1};
constexpr double volume_slack = 1e-12;  // for the sum of all of vorpipe's cells

struct Wanted {
  std::uint64_t sites = 1000000;
  std::uint64_t seed = 1;
  int repetitions = 7;
  bool polyhedra = false;
  std::vector<int> threads{1, 2};
  std::vector<std::string> patterns{"random"};
  std::vector<std::string> peers;
  std::string json;
};

/// Sites, as vorpipe takes them and as peers do, and what is right there.
struct Round {
  std::string name;
  Sites3 sites;
  SpaceInput scaled;
  Diagram3 reference;
};

std::vector<SpacePeer> builtPeers() {
  return {
#ifdef WITH_CGAL
      cgalInSpace(),
#endif
#ifdef WITH_VORO
      voroInSpace(),
#endif
#ifdef WITH_VORO_DEV
      voroDevelopment(),
#endif
  };
}

void addOptions(CLI::App& app, Wanted& wanted) {
  std::string peers;
  for (const auto& peer : builtPeers()) peers += (peers.empty() ? "" : ", ") + peer.name;
  app.add_option("--sites", wanted.sites, "about how many")->capture_default_str();
  app.add_option("--seed", wanted.seed, "of sites")->capture_default_str();
  app.add_option(
         "--patterns", wanted.patterns,
         "names of generators; fcc~1e-5 has noise, in mean distances; random%0.01 is on a grid of that step")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--threads", wanted.threads, "of each program that has them, one line for each")
      ->delimiter(',')
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_flag("--polyhedra", wanted.polyhedra, "these, too, not measures alone");
  app.add_option("--peers", wanted.peers, "names, or none; all by default: " + peers)->delimiter(',');
  app.add_option("--repetitions", wanted.repetitions, "of each measurement; 0: only check that all agree")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  app.add_option("--json", wanted.json, "a file to write the figures to");
}

tl::unexpected<Error> refused(std::string what) {
  return tl::unexpected(Error{ErrorCode::input, std::move(what)});
}

Result<std::vector<SpacePeer>> choosePeers(const Wanted& wanted) {
  auto all = builtPeers();
  if (wanted.peers.empty()) return all;
  std::vector<SpacePeer> chosen;
  if (wanted.peers == std::vector<std::string>{"none"}) return chosen;
  for (const auto& name : wanted.peers) {
    const auto found = std::ranges::find(all, name, &SpacePeer::name);
    if (found == all.end()) return refused(fmt::format("--peers: no {} here", name));
    chosen.push_back(*found);
  }
  return chosen;
}

/// What stands behind a mark in a pattern, which loses it; 0 if there is none.
Result<double> taken(std::string& pattern, char mark) {
  const auto at = pattern.find(mark);
  if (at == std::string::npos) return 0.0;
  double value = 0;
  const char* const end = pattern.data() + pattern.size();
  const auto [last, failed] = std::from_chars(pattern.data() + at + 1, end, value);
  if (failed != std::errc() || last != end || !(value > 0))
    return refused(fmt::format("--patterns: {} has no number above 0 behind {}", pattern, mark));
  pattern.resize(at);
  return value;
}

/// In the unit cube, and no two at one place: programs do not agree about what becomes of those.
Result<Sites3> makeSites(std::string pattern, const Wanted& wanted) {
  const auto step = taken(pattern, '%');
  if (!step) return tl::unexpected(step.error());
  const auto noise = taken(pattern, '~');
  if (!noise) return tl::unexpected(noise.error());
  auto table = loadSpaceSites(fmt::format("{}:{}", pattern, wanted.sites), wanted.seed, {}, {});
  if (!table) return tl::unexpected(table.error());
  Sites3& sites = table->sites;
  Random random(wanted.seed);
  const double reach = *noise / std::cbrt(static_cast<double>(sites.size()));
  for (Point3& p : sites) {
    for (double* x : {&p.x, &p.y, &p.z}) {
      *x += reach * (2 * random.uniform() - 1);
      // Not on the walls, where Voro++ does not take them.
      if (*step > 0) *x = (std::clamp(std::floor(*x / *step), 0.0, std::floor(1 / *step) - 1) + 0.5) * *step;
      *x = std::clamp(*x, 0.0, 1.0);
    }
  }
  if (*step > 0) {
    std::ranges::sort(sites);
    sites.erase(std::unique(sites.begin(), sites.end()), sites.end());
    std::ranges::shuffle(sites, std::mt19937_64(wanted.seed));
  }
  return std::move(sites);
}

Result<void> makeRounds(const Wanted& wanted, std::deque<Round>& rounds) {
  auto judge = Session::open({.name = "cpu", .device = "", .threads = 0, .mask = {}});
  if (!judge) return tl::unexpected(judge.error());
  for (const auto& pattern : wanted.patterns) {
    auto sites = makeSites(pattern, wanted);
    if (!sites) return tl::unexpected(sites.error());
    const double side = std::exp2(std::round(std::log2(std::cbrt(static_cast<double>(sites->size())))));
    SpaceInput scaled{*sites, side};
    for (Point3& p : scaled.sites) p = {p.x * side, p.y * side, p.z * side};
    auto reference = judge->cells(std::span<const Point3>(*sites), {unit_cube, Detail3::polyhedra, {}});
    if (!reference) return tl::unexpected(reference.error());
    rounds.push_back({pattern, std::move(*sites), std::move(scaled), std::move(*reference)});
  }
  return {};
}

tl::unexpected<Error> wrong(std::string what) {
  return tl::unexpected(Error{ErrorCode::device, std::move(what)});
}

Result<void> runSession(Session& session, const Round& round, Contest& line, Purpose purpose) {
  const auto detail = line.job == Job::polyhedra ? Detail3::polyhedra : Detail3::measures;
  const JobWatch watch;
  const auto diagram = session.cells(std::span<const Point3>(round.sites), {unit_cube, detail, {}});
  const Taken taken = watch.taken();
  if (!diagram) return tl::unexpected(diagram.error());
  line.add(taken, purpose);
  if (!(std::abs(volumeSum(*diagram) - 1) <= volume_slack))
    return wrong("volumes do not add up to the cube's");
  if (purpose != Purpose::check) return {};
  const auto diff = diffCells(round.reference, *diagram);
  if (!diff) return tl::unexpected(diff.error());
  if (!diff->agree()) return wrong("wrong cells");
  return {};
}

Result<void> runPeer(const SpacePeer& peer, int threads, const Round& round, Contest& line, Purpose purpose) {
  std::string differs;
  if (line.job == Job::triangulation) {
    const auto done = peer.triangulate(round.scaled, threads);
    if (!done) return tl::unexpected(done.error());
    line.add(done->taken, purpose);
    if (purpose == Purpose::check) differs = disagreement(*done, round.reference);
  } else {
    const auto detail = line.job == Job::polyhedra ? Detail3::polyhedra : Detail3::measures;
    const auto done = peer.measure(round.scaled, threads, detail);
    if (!done) return tl::unexpected(done.error());
    line.add(done->taken, purpose);
    if (purpose == Purpose::check) differs = disagreement(round.scaled, *done, round.reference);
  }
  if (!differs.empty()) return wrong(std::move(differs));
  return {};
}

void addPeer(const SpacePeer& peer, int threads, const std::vector<Job>& jobs, const Round& round,
             Contests& contests) {
  const auto run = [&peer, threads, &round](Contest& of, Purpose purpose) {
    return runPeer(peer, threads, round, of, purpose);
  };
  Contest line{
      peer.what, peer.version, std::to_string(threads), Job::triangulation, {round.name, round.sites.size()},
      true};
  if (peer.triangulate) contests.add(line, run);
  if (!peer.measure) return;
  for (const Job job : jobs) {
    line.job = job;
    contests.add(line, run);
  }
}

Result<bool> measure(const Wanted& wanted) {
  const auto peers = choosePeers(wanted);
  if (!peers) return tl::unexpected(peers.error());
  std::deque<Session> sessions;
  for (const int threads : wanted.threads) {
    auto session = Session::open({.name = "cpu", .device = "", .threads = threads, .mask = {}});
    if (!session) return tl::unexpected(session.error());
    sessions.push_back(std::move(*session));
  }
  std::deque<Round> rounds;
  if (auto made = makeRounds(wanted, rounds); !made) return tl::unexpected(made.error());
  std::vector<Job> jobs{Job::full};
  if (wanted.polyhedra) jobs.push_back(Job::polyhedra);
  Contests contests;
  for (const auto& round : rounds) {
    for (std::size_t s = 0; s < sessions.size(); ++s) {
      Contest line{"vorpipe cpu", std::string(version()),           std::to_string(wanted.threads[s]),
                   Job::full,     {round.name, round.sites.size()}, false};
      for (const Job job : jobs) {
        line.job = job;
        contests.add(line, [&session = sessions[s], &round](Contest& of, Purpose purpose) {
          return runSession(session, round, of, purpose);
        });
      }
    }
    for (const auto& peer : *peers) {
      if (!peer.threaded) addPeer(peer, 1, jobs, round, contests);
      for (const int threads : peer.threaded ? wanted.threads : std::vector<int>{})
        addPeer(peer, threads, jobs, round, contests);
    }
  }
  return contests.hold("bench_space", wanted.repetitions, {}, wanted.json);
}

int run(int argc, char** argv) {
  Wanted wanted;
  CLI::App app("Measures cells in space of vorpipe and of other programs.");
  addOptions(app, wanted);
  CLI11_PARSE(app, argc, argv);
  const auto right = measure(wanted);
  if (right) return *right ? 0 : 1;
  fmt::print(stderr, "bench_space: {}\n", right.error().message);
  return right.error().code == ErrorCode::input ? 2 : 3;
}

}  // namespace
}  // namespace vorpipe::test

int main(int argc, char** argv) {
  vorpipe::keepFreedMemory();
  try {
    return vorpipe::test::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_space: {}\n", error.what());
    return 2;
  }
}

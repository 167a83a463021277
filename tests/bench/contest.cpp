#include "bench/contest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bench/taken.h"

namespace vorpipe::test {
namespace {

constexpr double short_run = 2;       // seconds
constexpr double area_slack = 1e-12;  // of the domain, for the sum of all of vorpipe's cells

tl::unexpected<Error> wrong(std::string what) {
  return tl::unexpected(Error{ErrorCode::device, std::move(what)});
}

Result<void> check(const Diagram& diagram, const Round& round) {
  const Box& domain = round.input.set.domain;
  const double area = (domain.xmax - domain.xmin) * (domain.ymax - domain.ymin);
  if (!(std::abs(areaSum(diagram) - area) <= area_slack * area))
    return wrong("areas do not add up to the domain's");
  return {};
}

Result<void> runSession(Session& session, Detail detail, Contest& contest, Purpose purpose) {
  CellsOptions options{};
  options.domain = contest.round->input.set.domain;
  options.detail = detail;
  const JobWatch watch;
  const auto diagram = session.cells(contest.round->input.set.sites, options);
  const Taken taken = watch.taken();
  if (!diagram) return tl::unexpected(diagram.error());
  contest.add(taken, purpose);
  if (purpose == Purpose::warm_up) return {};
  if (purpose == Purpose::count) return check(*diagram, *contest.round);
  const auto diff = diffCells(contest.round->reference, *diagram);
  if (!diff) return tl::unexpected(diff.error());
  if (!diff->agree()) return wrong("wrong cells");
  return check(*diagram, *contest.round);
}

Result<void> runTriangulation(const Peer& peer, Contest& contest, Purpose purpose) {
  const auto done = peer.triangulate(contest.round->input);
  if (!done) return tl::unexpected(done.error());
  const auto expected = contest.round->reference.triangles.size();
  if (done->triangles != expected)
    return wrong(fmt::format("{} triangles, not {}", done->triangles, expected));
  contest.add(done->taken, purpose);
  return {};
}

Result<void> runPeer(const Peer& peer, Contest& contest, Purpose purpose) {
  const auto done = peer.measure(contest.round->input);
  if (!done) return tl::unexpected(done.error());
  contest.add(done->taken, purpose);
  if (purpose == Purpose::warm_up) return {};
  auto differs = purpose == Purpose::count ? done->cells.areaDisagreement()
                                           : done->cells.disagreement(contest.round->reference);
  if (!differs.empty()) return wrong(std::move(differs));
  return {};
}

/// The line with the best median among those that `wanted` takes.
template <class Wanted>
const Contest* fastest(const std::deque<Contest>& contests, const Round& round, const Wanted& wanted) {
  const Contest* best = nullptr;
  for (const auto& contest : contests) {
    if (contest.round != &round || !contest.wasRight() || !wanted(contest)) continue;
    if (best == nullptr || bench::median(contest.seconds) < bench::median(best->seconds)) best = &contest;
  }
  return best;
}

bench::Cell speedAgainst(const Contest* other, const Contest& contest) {
  if (other == nullptr) return bench::Missing{};
  return bench::median(other->seconds) / bench::median(contest.seconds);
}

}  // namespace

std::vector<bench::Course> makeCourses(Contestants& contestants, const std::deque<Round>& rounds,
                                       std::deque<Contest>& contests) {
  std::vector<bench::Course> courses;
  const auto add = [&](Contest made, auto run) {
    auto& contest = contests.emplace_back(std::move(made));
    const auto name =
        fmt::format("{}, {} of {}", contest.program, contest.job == Job::full ? "full job" : "triangulation",
                    contest.round->input.set.name);
    courses.push_back({name, [&contest, run](bool counts) -> Result<void> {
                         if (!counts) return run(contest, Purpose::check);
                         if (contest.last_seconds < short_run) {
                           if (auto warmed = run(contest, Purpose::warm_up); !warmed) return warmed;
                         }
                         return run(contest, Purpose::count);
                       }});
  };
  for (const auto& round : rounds) {
    for (auto& opened : contestants.sessions) {
      const auto& device = opened.session.device();
      add({"vorpipe " + device.backend, fmt::format("{} on {}", version(), device.name),
           opened.threads == 0 ? "all" : std::to_string(opened.threads), Job::full, &round, false},
          [&session = opened.session, detail = contestants.detail](Contest& contest, Purpose purpose) {
            return runSession(session, detail, contest, purpose);
          });
    }
    const bool weighted = !round.input.sites.weight.empty();
    for (const auto& peer : contestants.peers) {
      if (weighted ? !peer.with_weights : !peer.without_weights) continue;
      const Contest contest{peer.what, peer.version, "1", Job::triangulation, &round, true};
      if (peer.triangulate)
        add(contest, [&peer](Contest& c, Purpose purpose) { return runTriangulation(peer, c, purpose); });
      Contest full = contest;
      full.job = Job::full;
      add(full, [&peer](Contest& c, Purpose purpose) { return runPeer(peer, c, purpose); });
    }
  }
  for (std::size_t k = 0; k < courses.size(); ++k) contests[k].course = &courses[k];
  return courses;
}

bench::Table makeTable(const Round& round, const std::deque<Contest>& contests) {
  const auto& set = round.input.set;
  bench::Table table{fmt::format("peers {}", set.name),
                     fmt::format("{} sites: {}", set.sites.size(), set.name),
                     {{"program", "program"},
                      {"version", "version"},
                      {"threads", "threads"},
                      {"job", "job"},
                      {"seconds", "seconds, median (spread)"},
                      {"least", "least"},
                      {"cpu_seconds", "CPU seconds, all threads"},
                      {"speed_to_triangulation", "speed, CGAL's triangulation = 1"},
                      {"speed_to_full_job", "speed, fastest full job of the others = 1"}}};
  const auto* cgal = fastest(contests, round, [](const Contest& contest) {
    return contest.is_peer && contest.job == Job::triangulation && contest.program.starts_with("CGAL");
  });
  const auto* full = fastest(
      contests, round, [](const Contest& contest) { return contest.is_peer && contest.job == Job::full; });
  for (const auto& contest : contests) {
    if (contest.round != &round) continue;
    const bool is_full = contest.job == Job::full;
    std::vector<bench::Cell> row{contest.program, contest.version, contest.threads,
                                 is_full ? "full" : "triangulation"};
    if (contest.wasRight()) {
      row.insert(row.end(),
                 {contest.seconds, bench::least(contest.seconds), contest.cpu_seconds,
                  speedAgainst(cgal, contest), is_full ? speedAgainst(full, contest) : bench::Missing{}});
    } else {
      row.insert(row.end(), {bench::Missing{"failed: " + contest.course->failed}, bench::Missing{},
                             bench::Missing{}, bench::Missing{}, bench::Missing{}});
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace vorpipe::test

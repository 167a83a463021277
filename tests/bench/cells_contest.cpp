#include "bench/cells_contest.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace vorpipe::test {
namespace {

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

Result<void> runSession(Session& session, Detail detail, const Round& round, Contest& line, Purpose purpose) {
  CellsOptions options{};
  options.domain = round.input.set.domain;
  options.detail = detail;
  const JobWatch watch;
  const auto diagram = session.cells(round.input.set.sites, options);
  const Taken taken = watch.taken();
  if (!diagram) return tl::unexpected(diagram.error());
  line.add(taken, purpose);
  if (purpose == Purpose::warm_up) return {};
  if (purpose == Purpose::count) return check(*diagram, round);
  const auto diff = diffCells(round.reference, *diagram);
  if (!diff) return tl::unexpected(diff.error());
  if (!diff->agree()) return wrong("wrong cells");
  return check(*diagram, round);
}

Result<void> runTriangulation(const Peer& peer, const Round& round, Contest& line, Purpose purpose) {
  const auto done = peer.triangulate(round.input);
  if (!done) return tl::unexpected(done.error());
  const auto expected = round.reference.triangles.size();
  if (done->triangles != expected)
    return wrong(fmt::format("{} triangles, not {}", done->triangles, expected));
  line.add(done->taken, purpose);
  return {};
}

Result<void> runPeer(const Peer& peer, const Round& round, Contest& line, Purpose purpose) {
  const auto done = peer.measure(round.input);
  if (!done) return tl::unexpected(done.error());
  line.add(done->taken, purpose);
  if (purpose == Purpose::warm_up) return {};
  auto differs =
      purpose == Purpose::count ? done->cells.areaDisagreement() : done->cells.disagreement(round.reference);
  if (!differs.empty()) return wrong(std::move(differs));
  return {};
}

}  // namespace

void addContests(Contestants& contestants, const std::deque<Round>& rounds, Contests& contests) {
  for (const auto& round : rounds) {
    const auto& set = round.input.set;
    const ContestSites sites{set.name, set.sites.size()};
    for (auto& opened : contestants.sessions) {
      const auto& device = opened.session.device();
      contests.add({"vorpipe " + device.backend, fmt::format("{} on {}", version(), device.name),
                    opened.threads == 0 ? "all" : std::to_string(opened.threads), Job::full, sites, false},
                   [&, detail = contestants.detail](Contest& line, Purpose purpose) {
                     return runSession(opened.session, detail, round, line, purpose);
                   });
    }
    const bool weighted = !round.input.sites.weight.empty();
    for (const auto& peer : contestants.peers) {
      if (weighted ? !peer.with_weights : !peer.without_weights) continue;
      Contest line{peer.what, peer.version, "1", Job::triangulation, sites, true};
      if (peer.triangulate) {
        contests.add(
            line, [&](Contest& of, Purpose purpose) { return runTriangulation(peer, round, of, purpose); });
      }
      line.job = Job::full;
      contests.add(line, [&](Contest& of, Purpose purpose) { return runPeer(peer, round, of, purpose); });
    }
  }
}

}  // namespace vorpipe::test

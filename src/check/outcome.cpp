#include <fmt/core.h>

#include <array>
#include <bit>
#include <span>

#include "check/checks.h"

namespace vorpipe::core::checks {
namespace {

std::size_t hash(Point p) {
  // Adding 0 makes -0 and 0, which are equal, one bit pattern.
  const auto x = std::bit_cast<std::uint64_t>(p.x + 0.0), y = std::bit_cast<std::uint64_t>(p.y + 0.0);
  std::uint64_t bits = (x ^ std::rotl(y, 32)) * 0x9E3779B97F4A7C15u;
  bits ^= bits >> 32;
  bits *= 0xD6E8FEB86659FD93u;
  return bits ^ bits >> 32;
}

/// For each site, the owner of its position: the heaviest, then the first. In a periodic domain scaled
/// weights are compared, which rounds those below 1e-308.
std::vector<std::uint32_t> ownersOfPositions(const CheckedSites& run) {
  const SitePlaces places(run);
  std::vector<std::uint32_t> slots(std::bit_ceil(2 * run.size() + 1), no_site), first(run.size());
  const std::size_t mask = slots.size() - 1;
  for (std::uint32_t i = 0; i < run.size(); ++i) {
    std::size_t slot = hash(places.at(i)) & mask;
    while (slots[slot] != no_site && !(places.at(slots[slot]) == places.at(i))) slot = (slot + 1) & mask;
    if (slots[slot] == no_site) slots[slot] = i;
    first[i] = slots[slot];
  }
  if (!run.weighted) return first;
  const double scale = run.repeats() ? run.scale : 1;
  const auto weight = [&](std::uint32_t i) { return run.sites.weight[i] * scale * scale; };
  std::vector<std::uint32_t> heaviest = first;
  for (std::uint32_t i = 0; i < run.size(); ++i) {
    auto& best = heaviest[first[i]];
    if (weight(i) > weight(best)) best = i;
  }
  for (auto& owner : first) owner = heaviest[owner];
  return first;
}

}  // namespace

bool checkOutcome(const CheckedSites& run, const Outcome& outcome, Broken& broken) {
  // No structured binding, which lambdas of Clang before 16 cannot capture.
  const std::span<const Status> status = outcome.status;
  const std::span<const std::uint32_t> owner = outcome.owner;
  const Report& report = outcome.report;
  if (status.size() != run.size() || owner.size() != run.size()) {
    broken.add("statuses", fmt::format("{} sites have {} statuses and {} owners", run.size(), status.size(),
                                       owner.size()));
    return false;
  }
  const auto owners = ownersOfPositions(run);
  const bool owned = broken.expect("owners", run.size(), run.threads, [&](std::size_t i) {
    return owner[i] == owners[i]
               ? std::string()
               : fmt::format("site {} is owned by site {}, but site {} has its position first", i, owner[i],
                             owners[i]);
  });
  broken.expect("statuses", run.size(), run.threads, [&](std::size_t i) -> std::string {
    const bool duplicate = status[i] == Status::duplicate;
    if (status[i] > Status::duplicate) return fmt::format("site {} has none that is known", i);
    if (duplicate != (owners[i] != i)) {
      return fmt::format("site {} is {}a duplicate", i, duplicate ? "" : "not ");
    }
    const bool may_be_empty = run.weighted || run.outline != nullptr || !run.inDomain(run.site(i));
    if (status[i] != Status::empty || may_be_empty) return {};
    return fmt::format("site {} lies in the domain and cannot be empty", i);
  });
  std::array<std::uint64_t, 4> counts{};
  for (const Status each : status) ++counts[std::min<std::size_t>(static_cast<std::size_t>(each), 3)];
  if (counts != std::array<std::uint64_t, 4>{report.ok, report.empty, report.duplicate, 0}) {
    broken.add("statuses", fmt::format("{} ok, {} empty, {} duplicate; the report says {}, {}, {}", counts[0],
                                       counts[1], counts[2], report.ok, report.empty, report.duplicate));
  }
  return owned;
}

}  // namespace vorpipe::core::checks

#include "cells/device_eligible.h"

#include <atomic>
#include <cmath>
#include <numeric>

#include "base/inside.h"
#include "base/parallel.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t device_eligible_grain = std::size_t{1} << 16;

bool fitsFloat(const SiteSet& sites, std::size_t i) {
  constexpr double most_distance = 1e15, most_weight = 1e18;
  return std::abs(sites.x[i]) <= most_distance && std::abs(sites.y[i]) <= most_distance &&
         (sites.weight.empty() || std::abs(sites.weight[i]) <= most_weight);
}

}  // namespace

std::vector<std::uint32_t> allOf(const SiteSet& sites) {
  std::vector<std::uint32_t> all(sites.size());
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

Triage sortOut(const SiteSet& sites, int threads) {
  std::atomic<std::size_t> outside{0};
  std::atomic<bool> fit{true};
  parallelFor(sites.size(), device_eligible_grain, threads, [&](std::size_t begin, std::size_t end) {
    std::size_t count = 0;
    bool all_fit = true;
    for (auto i = begin; i < end; ++i) {
      count += isInside(sites.domain, sites.x[i], sites.y[i]) ? 0u : 1u;
      all_fit = all_fit && fitsFloat(sites, i);
    }
    outside += count;
    if (!all_fit) fit = false;
  });
  Triage triage;
  if (!fit) {
    triage.outside = allOf(sites);
    return triage;
  }
  if (outside == 0) {
    triage.inside = allOf(sites);
    return triage;
  }
  triage.inside.reserve(sites.size() - outside);
  triage.outside.reserve(outside);
  for (std::uint32_t i = 0; i < sites.size(); ++i) {
    (isInside(sites.domain, sites.x[i], sites.y[i]) ? triage.inside : triage.outside).push_back(i);
  }
  return triage;
}

}  // namespace vorpipe::core

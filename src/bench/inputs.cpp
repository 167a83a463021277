#include <fmt/core.h>

#include <algorithm>

#include "base/try.h"
#include "bench/tables.h"

namespace vorpipe::bench {
namespace {

/// Adds the rows of one backend: the cost of a site relative to one of the first input.
void addRows(const std::vector<const Outcome*>& outcomes, Table& table) {
  const Outcome& first = *outcomes.front();
  for (const Outcome* outcome : outcomes) {
    const auto& report = outcome->report;
    std::vector<Cell> row = {outcome->job.backend, outcome->job.sites, outcome->sites,
                             figure(*outcome, outcome->seconds)};
    if (outcome->measured()) {
      const auto cost = [](const Outcome& of) { return median(of.seconds) / static_cast<double>(of.sites); };
      const double own = cost(*outcome);
      row.emplace_back(1e9 * own);
      row.push_back(first.measured() ? Cell(own / cost(first)) : Cell(Missing{}));
      row.insert(row.end(), {median(outcome->stage(Stage::resolve)) / median(outcome->seconds) * 100,
                             report.retried, report.in_double, report.exact, report.duplicate});
    } else {
      row.insert(row.end(), 7, Missing{});
    }
    table.rows.push_back(std::move(row));
  }
}

}  // namespace

Result<Findings> inputs(Lab& lab) {
  constexpr std::uint64_t wanted = 1'000'000;
  const std::uint64_t count = std::min<std::uint64_t>(wanted, lab.settings().max_sites);
  std::vector<std::string> sites;
  for (const char* pattern : {"random", "jitter", "square", "hex", "clusters", "circle"}) {
    sites.push_back(fmt::format("{}:{}", pattern, count));
  }
  for (const DataSet& file : lab.settings().files) sites.push_back(file.name);
  std::vector<std::vector<const Outcome*>> outcomes;
  for (const auto& backend : lab.settings().backends) {
    auto& of_backend = outcomes.emplace_back();
    for (const auto& name : sites) of_backend.push_back(&lab.plan({backend, name}));
  }
  VORPIPE_TRY(lab.measure("inputs"));
  Table table{"inputs",
              "Inputs: all cells, areas, centroids and neighbors",
              {{"backend", "backend"},
               {"input", "sites from"},
               {"sites", "sites"},
               {"seconds", "s"},
               {"nanoseconds_per_site", "ns per site"},
               {"over_random", "cost per site, random = 1"},
               {"resolve_percent", "resolve, % of time"},
               {"retried", "cells with more room"},
               {"in_double", "in double"},
               {"exact", "exact"},
               {"duplicates", "duplicates"}}};
  for (const auto& of_backend : outcomes) addRows(of_backend, table);
  table.notes = noteOfLimit(lab, wanted);
  if (lab.settings().files.empty()) table.notes.emplace_back("No real data: name files with --sites.");
  return Findings{{std::move(table)}, {}};
}

}  // namespace vorpipe::bench

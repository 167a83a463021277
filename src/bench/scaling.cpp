#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <map>

#include "base/try.h"
#include "bench/tables.h"

namespace vorpipe::bench {
namespace {

constexpr std::uint64_t million = 1'000'000;

/// The times of one backend along an axis: sites, threads or pixels.
struct Line {
  std::string backend;
  std::vector<std::pair<double, const Outcome*>> points;

  [[nodiscard]] std::vector<std::pair<double, double>> medians(
      Samples Outcome::*of = &Outcome::seconds) const {
    std::vector<std::pair<double, double>> result;
    for (const auto& [x, outcome] : points) {
      if (outcome->measured()) result.emplace_back(x, median(outcome->*of));
    }
    return result;
  }

  /// Returns the least time per unit of x, over all measurements.
  [[nodiscard]] double leastCost(Samples Outcome::*of = &Outcome::seconds) const {
    double cost = std::numeric_limits<double>::infinity();
    for (const auto& [x, y] : medians(of)) cost = std::min(cost, y / x);
    return cost;
  }
};

using Lines = std::vector<Line>;

template <class Axis, class JobAt>
Lines planLines(Lab& lab, const Axis& axis, const JobAt& job_at) {
  Lines lines;
  for (const auto& backend : lab.settings().backends) {
    Line line{backend, {}};
    for (const auto at : axis) {
      Job job = job_at(at);
      job.backend = backend;
      line.points.emplace_back(static_cast<double>(at), &lab.plan(job));
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

Cell exponent(const std::vector<std::pair<double, double>>& points) {
  if (points.size() < 2) return Missing{"needs two sizes"};
  return exponentOf(points);
}

Table sitesTable(const Lines& lines) {
  Table table{"scaling_sites",
              "Scaling in sites: all cells of random sites, areas, centroids and neighbors",
              {{"backend", "backend"},
               {"sites", "sites"},
               {"seconds", "s"},
               {"million_sites_per_second", "million sites/s"},
               {"nanoseconds_per_site", "ns per site"},
               {"over_least", "cost per site, least = 1"},
               {"cpu_seconds", "CPU s"},
               {"cpu_over_least", "CPU per site, least = 1"}}};
  for (const Line& line : lines) {
    const double least_cost = line.leastCost(), least_cpu = line.leastCost(&Outcome::cpu_seconds);
    for (const auto& [x, outcome] : line.points) {
      std::vector<Cell> row = {line.backend, outcome->sites, figure(*outcome, outcome->seconds)};
      if (outcome->measured()) {
        const double cost = median(outcome->seconds) / x;
        row.insert(row.end(), {1e-6 / cost, 1e9 * cost, cost / least_cost, outcome->cpu_seconds,
                               median(outcome->cpu_seconds) / x / least_cpu});
      } else {
        row.insert(row.end(), 5, Missing{});
      }
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

Table fitTable(const Lines& sites, const Lines& pixels) {
  Table table{"scaling_fit",
              "Slopes: the exponent e of time as a power of what grows, by least squares over the medians",
              {{"backend", "backend"},
               {"sites_exponent", "time ~ sites^e"},
               {"cpu_exponent", "CPU time ~ sites^e"},
               {"worst_cost", "dearest site, cheapest = 1"},
               {"pixels_exponent", "picture ~ pixels^e"}}};
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const double least_cost = sites[i].leastCost();
    double worst = 0;
    for (const auto& [x, y] : sites[i].medians()) worst = std::max(worst, y / x / least_cost);
    table.rows.push_back({sites[i].backend, exponent(sites[i].medians()),
                          exponent(sites[i].medians(&Outcome::cpu_seconds)),
                          worst > 0 ? Cell(worst) : Cell(Missing{}), exponent(pixels[i].medians())});
  }
  return table;
}

Table threadsTable(const Lines& lines, std::uint64_t sites) {
  Table table{"scaling_threads",
              fmt::format("Scaling in threads: the cells of random:{}", sites),
              {{"backend", "backend"},
               {"threads", "threads"},
               {"seconds", "s"},
               {"speed_up", "speed, one thread = 1"},
               {"cpu_seconds", "CPU s"}}};
  for (const Line& line : lines) {
    const Outcome& alone = *line.points.front().second;
    for (const auto& [x, outcome] : line.points) {
      const bool both = alone.measured() && outcome->measured();
      table.rows.push_back({line.backend, static_cast<std::uint64_t>(x), figure(*outcome, outcome->seconds),
                            both ? Cell(median(alone.seconds) / median(outcome->seconds)) : Cell(Missing{}),
                            outcome->measured() ? Cell(outcome->cpu_seconds) : Cell(Missing{})});
    }
  }
  return table;
}

Table pixelsTable(const Lines& lines, std::uint64_t sites) {
  Table table{"scaling_pixels",
              fmt::format("Scaling in pixels: pictures of random:{}", sites),
              {{"backend", "backend"},
               {"side", "pixels, squared"},
               {"seconds", "s"},
               {"draw", "clip and draw s"},
               {"download", "download s"}}};
  for (const Line& line : lines) {
    for (const auto& [x, outcome] : line.points) {
      table.rows.push_back({line.backend, static_cast<std::uint64_t>(outcome->job.side),
                            figure(*outcome, outcome->seconds), figure(*outcome, outcome->stage(Stage::draw)),
                            figure(*outcome, outcome->stage(Stage::download))});
    }
  }
  return table;
}

Plot plotOf(const Lines& lines, std::string title, std::string x, double unit) {
  Plot plot{std::move(title), std::move(x), "seconds", {}};
  for (const Line& line : lines) {
    Curve curve{line.backend, line.medians()};
    for (auto& point : curve.points) point.first *= unit;
    plot.curves.push_back(std::move(curve));
  }
  return plot;
}

/// 1, 2, 4 and so on, and all.
std::vector<int> threadCounts(int all) {
  std::vector<int> counts;
  for (int threads = 1; threads < all; threads *= 2) counts.push_back(threads);
  counts.push_back(all);
  return counts;
}

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

Result<Findings> scaling(Lab& lab) {
  const std::uint64_t most = lab.settings().max_sites;
  const std::vector<std::uint64_t> wanted = {10'000,      30'000,      100'000,      300'000,
                                             1 * million, 3 * million, 10 * million, 16 * million};
  const Lines sites = planLines(lab, upTo(wanted, most), [](std::uint64_t count) {
    return Job{"", fmt::format("random:{}", count)};
  });
  const std::uint64_t for_threads = std::min(most, million),
                      for_pixels = std::min<std::uint64_t>(most, 100'000);
  const Lines threads = planLines(lab, threadCounts(lab.threads()), [&](int count) {
    Job job{"", fmt::format("random:{}", for_threads)};
    job.threads = count;
    return job;
  });
  Lines pixels = planLines(lab, upTo<int>({500, 1000, 2000, 4000}, lab.settings().max_side), [&](int side) {
    return Job{"", fmt::format("random:{}", for_pixels), side};
  });
  for (Line& line : pixels) {
    for (auto& [x, outcome] : line.points) x *= x;
  }
  VORPIPE_TRY(lab.measure("scaling"));

  Findings findings;
  findings.tables = {sitesTable(sites), fitTable(sites, pixels), threadsTable(threads, for_threads),
                     pixelsTable(pixels, for_pixels)};
  findings.tables.front().notes = noteIfCut("--max-sites", lab.settings().max_sites, wanted.back());
  findings.tables.back().notes =
      noteIfCut("--max-side", static_cast<std::uint64_t>(lab.settings().max_side), largest_picture);
  findings.plots = {plotOf(sites, "All cells of random sites", "sites", 1),
                    plotOf(threads, fmt::format("Cells of random:{}", for_threads), "threads", 1),
                    plotOf(pixels, fmt::format("Pictures of random:{}", for_pixels), "pixels", 1)};
  return findings;
}

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
  table.notes = noteIfCut("--max-sites", lab.settings().max_sites, wanted);
  if (lab.settings().files.empty()) table.notes.emplace_back("No real data: name files with --sites.");
  return Findings{{std::move(table)}, {}};
}

}  // namespace vorpipe::bench

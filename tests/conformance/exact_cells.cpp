/// Compares the cells of any sites, on any backend, with exact ones: for inputs that are too large for
/// a test, or come from elsewhere. Exits with 1 when a promise is broken.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "io/sites/sites_file.h"
#include "support/devices/backends.h"
#include "support/exact/exact_comparison.h"
#include "support/exact/exact_triangles.h"
#include "support/sites/data_sets.h"

namespace vorpipe::test {
namespace {

struct Wanted {
  std::vector<std::string> inputs;
  std::vector<std::string> backends;
  std::vector<double> domain;
  std::vector<std::string> disabled, limits;
  std::string search = "grid";
  double weight_scale = 1;
  std::uint64_t count = 2000;
  std::uint64_t seed = 1;
  int threads = 0;
  bool measures = false;
};

std::vector<DataSetKind> allKinds() {
  auto kinds = dataSetKinds();
  kinds.insert(kinds.end(), weightedSetKinds().begin(), weightedSetKinds().end());
  return kinds;
}

void addOptions(CLI::App& app, Wanted& wanted) {
  std::string sets;
  for (const auto& kind : allKinds()) sets += fmt::format("\n  {}: {}", kind.name, kind.difficulty);
  app.footer("Data sets:" + sets);
  app.add_option("inputs", wanted.inputs,
                 "files of sites, data sets as NAME or NAME:N, all, or weighted: all that have weights")
      ->required();
  app.add_option("--backends", wanted.backends, "names; all that can be used")->delimiter(',');
  app.add_option("--domain", wanted.domain, "XMIN,YMIN,XMAX,YMAX instead of the input's own")
      ->delimiter(',')
      ->expected(4);
  app.add_option("--weight-scale", wanted.weight_scale, "what weights of files are multiplied by")
      ->capture_default_str();
  app.add_option("--search", wanted.search, "grid, or flann:K")->capture_default_str();
  app.add_option("--sites", wanted.count, "N of data sets named without it")->capture_default_str();
  app.add_option("--seed", wanted.seed, "of data sets")->capture_default_str();
  app.add_option("--threads", wanted.threads, "of the CPU; 0 is all")->capture_default_str();
  app.add_flag("--measures", wanted.measures, "ask for measures alone, not for polygons and triangles");
  app.add_option("--disable", wanted.disabled, "a feature")->take_all();
  app.add_option("--limit", wanted.limits, "NAME=VALUE")->take_all();
}

double secondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

Result<DataSet> load(const std::string& input, const Wanted& wanted) {
  const auto colon = input.find(':');
  const auto name = input.substr(0, colon);
  const auto kinds = allKinds();
  DataSet set;
  if (std::ranges::find(kinds, name, &DataSetKind::name) != kinds.end()) {
    const auto count = colon == std::string::npos ? wanted.count : std::stoull(input.substr(colon + 1));
    set = makeDataSet(name, count, wanted.seed);
  } else {
    auto table = readSites(input);
    if (!table) return tl::unexpected(table.error());
    for (auto& weight : table->sites.weight) weight *= wanted.weight_scale;
    set = {input, std::move(table->sites), {}};
    set.domain = boxAround(set.sites);
  }
  const auto& d = wanted.domain;
  if (!d.empty()) set.domain = {d[0], d[1], d[2], d[3]};
  return set;
}

CellsOptions cellsOptions(const DataSet& set, const Wanted& wanted) {
  CellsOptions options{};
  options.domain = set.domain;
  options.detail = wanted.measures ? Detail::measures : Detail::everything;
  if (wanted.search.starts_with("flann")) {
    options.search.method = Search::flann;
    if (wanted.search.size() > 6) options.search.neighbors = std::stoi(wanted.search.substr(6));
  }
  return options;
}

BackendOptions backendOptions(const std::string& name, const Wanted& wanted) {
  BackendOptions options;
  options.name = name;
  options.threads = wanted.threads;
  options.mask.disabled = wanted.disabled;
  for (const auto& limit : wanted.limits) {
    const auto equals = limit.find('=');
    options.mask.limits.emplace_back(limit.substr(0, equals), std::stoull(limit.substr(equals + 1)));
  }
  return options;
}

/// Returns whether the promises hold.
bool compare(const DataSet& set, const ExactCells& exact, Session& session, const Wanted& wanted) {
  const auto begin = std::chrono::steady_clock::now();
  const auto diagram = session.cells(set.sites, cellsOptions(set, wanted));
  const auto& backend = session.device().backend;
  if (!diagram) {
    fmt::print("  {:15} FAILED: {}\n", backend, diagram.error().message);
    return false;
  }
  const double seconds = secondsSince(begin);
  const auto comparison = compareWithExact(*diagram, set.sites, set.domain, exact);
  const auto& report = diagram->report;
  fmt::print(
      "  {:15} {} in {:.3f} s; {} ok, {} empty, {} duplicate; {} retried, {} in double, {} exact; "
      "areas off by at most {:.2g} of what is promised\n",
      backend, comparison.summary(), seconds, report.ok, report.empty, report.duplicate, report.retried,
      report.in_double, report.exact, comparison.worst_area);
  for (const auto& fault : comparison.first) fmt::print("    {}\n", fault);
  if (wanted.measures) return comparison.agree();
  const auto triangles = findTriangleFaults(*diagram, set.sites, set.domain, exact);
  if (!triangles.none())
    fmt::print("    triangles: {} turned, {} overlapping, {} not Delaunay, {} missing\n", triangles.turned,
               triangles.overlapping, triangles.not_local, triangles.missing);
  for (const auto& fault : triangles.first) fmt::print("    {}\n", fault);
  return comparison.agree() && triangles.none();
}

int run(int argc, char** argv) {
  Wanted wanted;
  CLI::App app("Compares cells with exact ones.");
  addOptions(app, wanted);
  CLI11_PARSE(app, argc, argv);
  const bool all = wanted.inputs == std::vector<std::string>{"all"};
  if (all || wanted.inputs == std::vector<std::string>{"weighted"}) {
    wanted.inputs.clear();
    for (const auto& kind : all ? allKinds() : weightedSetKinds()) wanted.inputs.emplace_back(kind.name);
  }
  if (wanted.backends.empty()) {
    for (const char* name : backend_names) {
      if (whyUnusable(name).empty()) wanted.backends.emplace_back(name);
    }
  }
  std::vector<Session> sessions;
  for (const auto& name : wanted.backends) {
    auto session = Session::open(backendOptions(name, wanted));
    if (!session) {
      fmt::print(stderr, "exact_cells: {}\n", session.error().message);
      return 3;
    }
    sessions.push_back(std::move(*session));
  }
  bool right = true;
  for (const auto& input : wanted.inputs) {
    const auto set = load(input, wanted);
    if (!set) {
      fmt::print(stderr, "exact_cells: {}\n", set.error().message);
      return 2;
    }
    const auto begin = std::chrono::steady_clock::now();
    const auto exact = exactCells(set->sites, set->domain);
    fmt::print("{}: {} sites, seed {}, exact in {:.3f} s\n", set->name, set->sites.size(), wanted.seed,
               secondsSince(begin));
    for (auto& session : sessions) {
      right = compare(*set, exact, session, wanted) && right;
      std::fflush(stdout);
    }
  }
  return right ? 0 : 1;
}

}  // namespace
}  // namespace vorpipe::test

int main(int argc, char** argv) {
  try {
    return vorpipe::test::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "exact_cells: {}\n", error.what());
    return 2;
  }
}

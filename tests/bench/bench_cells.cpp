/// How fast cells are: each backend against CGAL's Delaunay triangulation and, on uneven sites,
/// against itself on even ones. All of it in one run, repeated in random order, so that what else the
/// machine does falls on all alike.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bench/cgal_delaunay.h"
#include "bench/speed_table.h"
#include "support/data_sets.h"

namespace vorpipe::test {
namespace {

struct Wanted {
  std::uint64_t sites = 1000000;
  std::uint64_t seed = 1;
  int repetitions = 5;
  int threads = 0;
  bool polygons = false;
  std::vector<std::string> backends{"vulkan-compute", "cpu"};
  std::vector<std::string> patterns{"random"};
};

void addOptions(CLI::App& app, Wanted& wanted) {
  std::string patterns;
  for (const auto& kind : dataSetKinds()) patterns += fmt::format("\n  {}: {}", kind.name, kind.difficulty);
  app.footer("Patterns:" + patterns);
  app.add_option("--sites", wanted.sites, "how many")->capture_default_str();
  app.add_option("--seed", wanted.seed, "of the sites")->capture_default_str();
  app.add_option("--repetitions", wanted.repetitions, "of each measurement")->capture_default_str();
  app.add_option("--threads", wanted.threads, "of the CPU; 0 is all")->capture_default_str();
  app.add_flag("--polygons", wanted.polygons, "all of a diagram, not its measures alone");
  app.add_option("--backends", wanted.backends, "names")->delimiter(',')->capture_default_str();
  app.add_option("--patterns", wanted.patterns, "names, or all; random is always among them")
      ->delimiter(',')
      ->capture_default_str();
}

void measureCells(benchmark::State& state, Session& session, const DataSet& set, Detail detail) {
  CellsOptions options{};
  options.domain = set.domain;
  options.detail = detail;
  for (auto _ : state) {
    const auto begin = std::chrono::steady_clock::now();
    const auto diagram = session.cells(set.sites, options);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    state.SetIterationTime(taken.count());
    if (!diagram) state.SkipWithError(diagram.error().message.c_str());
  }
}

void measureTriangulation(benchmark::State& state, const DataSet& set) {
  for (auto _ : state) state.SetIterationTime(triangulate(set.sites).seconds);
}

/// What is measured, and what it is measured on.
struct Course {
  std::vector<std::unique_ptr<DataSet>> sets;
  std::map<std::string, Session> sessions;
  std::vector<Measured> rows;
};

Result<Course> prepare(const Wanted& wanted) {
  Course course;
  for (const auto& pattern : wanted.patterns)
    course.sets.push_back(std::make_unique<DataSet>(makeDataSet(pattern, wanted.sites, wanted.seed)));
  for (const auto& set : course.sets)
    course.rows.push_back({"cgal", set->name, set->sites.size(), "cgal random"});
  for (const auto& name : wanted.backends) {
    BackendOptions options;
    options.name = name;
    options.threads = wanted.threads;
    auto session = Session::open(options);
    if (!session) return tl::unexpected(session.error());
    course.sessions.emplace(name, std::move(*session));
    for (const auto& set : course.sets) {
      course.rows.push_back({name, set->name, set->sites.size(), name + " random"});
    }
  }
  return course;
}

void registerAll(Course& course, const Wanted& wanted) {
  const auto detail = wanted.polygons ? Detail::everything : Detail::measures;
  for (const auto& row : course.rows) {
    const DataSet& set = **std::ranges::find(course.sets, row.sites, [](const auto& s) { return s->name; });
    const auto session = course.sessions.find(row.what);
    auto* registered =
        session == course.sessions.end()
            ? benchmark::RegisterBenchmark(row.name().c_str(),
                                           [&set](auto& state) { measureTriangulation(state, set); })
            : benchmark::RegisterBenchmark(row.name().c_str(), [&set, session, detail](auto& state) {
                measureCells(state, session->second, set, detail);
              });
    registered->Iterations(1)->Repetitions(wanted.repetitions)->UseManualTime()->Unit(benchmark::kSecond);
  }
}

int run(int argc, char** argv) {
  Wanted wanted;
  CLI::App app("Measures cells against CGAL's Delaunay triangulation. Options of Google Benchmark work too.");
  addOptions(app, wanted);
  std::vector<char*> ours{argv[0]};
  std::string interleaving = "--benchmark_enable_random_interleaving=true";
  std::vector<char*> theirs{argv[0], interleaving.data()};
  for (int i = 1; i < argc; ++i)
    (std::string_view(argv[i]).starts_with("--benchmark_") ? theirs : ours).push_back(argv[i]);
  CLI11_PARSE(app, static_cast<int>(ours.size()), ours.data());
  if (wanted.patterns == std::vector<std::string>{"all"}) {
    wanted.patterns.clear();
    for (const auto& kind : dataSetKinds()) wanted.patterns.emplace_back(kind.name);
  }
  if (std::ranges::find(wanted.patterns, "random") == wanted.patterns.end())
    wanted.patterns.insert(wanted.patterns.begin(), "random");

  auto course = prepare(wanted);
  if (!course) {
    fmt::print(stderr, "bench_cells: {}\n", course.error().message);
    return 3;
  }
  registerAll(*course, wanted);
  int count = static_cast<int>(theirs.size());
  benchmark::Initialize(&count, theirs.data());
  if (benchmark::ReportUnrecognizedArguments(count, theirs.data())) return 2;
#ifndef NDEBUG
  fmt::print(stderr, "bench_cells: built with assertions (CGAL's are many): its times mean little\n");
#endif
  SpeedTable table(course->rows);
  benchmark::RunSpecifiedBenchmarks(&table);
  return table.failed() ? 1 : 0;
}

}  // namespace
}  // namespace vorpipe::test

int main(int argc, char** argv) {
  try {
    return vorpipe::test::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_cells: {}\n", error.what());
    return 2;
  }
}

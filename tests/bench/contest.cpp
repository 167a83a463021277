#include "bench/contest.h"

#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "bench/machine.h"

namespace vorpipe::test {
namespace {

constexpr double short_run = 2;  // seconds

const char* nameOf(Job job) {
  switch (job) {
    case Job::triangulation:
      return "triangulation";
    case Job::full:
      return "full";
    case Job::polyhedra:
      return "full, with polyhedra";
  }
  return "";
}

bench::Cell speedAgainst(const Contest* other, const Contest& line) {
  if (other == nullptr) return bench::Missing{};
  return bench::median(other->seconds) / bench::median(line.seconds);
}

}  // namespace

void Contests::add(Contest made, std::function<Result<void>(Contest&, Purpose)> run) {
  auto& line = lines_.emplace_back(std::move(made));
  line.course = courses_.size();
  const auto name =
      fmt::format("{} on {}, {} of {}", line.program, line.threads, nameOf(line.job), line.sites.name);
  courses_.push_back({name, [&line, run = std::move(run)](bool counts) -> Result<void> {
                        if (!counts) return run(line, Purpose::check);
                        if (line.last_seconds < short_run) {
                          if (auto warmed = run(line, Purpose::warm_up); !warmed) return warmed;
                        }
                        return run(line, Purpose::count);
                      }});
}

/// No speed is told of what was wrong even once.
bool Contests::wasRight(const Contest& line) const {
  return courses_[line.course].failed.empty() && !line.seconds.empty();
}

/// The line with the best median among those that `wanted` takes.
template <class Wanted>
const Contest* Contests::fastest(const std::string& sites, const Wanted& wanted) const {
  const Contest* best = nullptr;
  for (const auto& line : lines_) {
    if (line.sites.name != sites || !wasRight(line) || !wanted(line)) continue;
    if (best == nullptr || bench::median(line.seconds) < bench::median(best->seconds)) best = &line;
  }
  return best;
}

bench::Table Contests::table(const ContestSites& sites) const {
  bench::Table table{fmt::format("peers {}", sites.name),
                     fmt::format("{} sites: {}", sites.count, sites.name),
                     {{"program", "program"},
                      {"version", "version"},
                      {"threads", "threads"},
                      {"job", "job"},
                      {"seconds", "seconds, median (spread)"},
                      {"least", "least"},
                      {"cpu_seconds", "CPU seconds, all threads"},
                      {"speed_to_triangulation", "speed, CGAL's triangulation = 1"},
                      {"speed_to_full_job", "speed, fastest full job of the others = 1"}}};
  const auto* cgal = fastest(sites.name, [](const Contest& line) {
    return line.is_peer && line.job == Job::triangulation && line.program.starts_with("CGAL");
  });
  for (const auto& line : lines_) {
    if (line.sites.name != sites.name) continue;
    std::vector<bench::Cell> row{line.program, line.version, line.threads, nameOf(line.job)};
    if (wasRight(line)) {
      const auto* full =
          line.job == Job::triangulation ? nullptr : fastest(sites.name, [&line](const Contest& other) {
            return other.is_peer && other.job == line.job;
          });
      row.insert(row.end(), {line.seconds, bench::least(line.seconds), line.cpu_seconds,
                             speedAgainst(cgal, line), speedAgainst(full, line)});
    } else {
      row.insert(row.end(), {bench::Missing{"failed: " + courses_[line.course].failed}, bench::Missing{},
                             bench::Missing{}, bench::Missing{}, bench::Missing{}});
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

Result<bool> Contests::hold(const std::string& program, int repetitions,
                            const std::vector<std::string>& notes, const std::string& json) {
  const auto machine = bench::thisMachine();
  if (auto ran = bench::interleave(courses_, repetitions, {}); !ran) return tl::unexpected(ran.error());
  bool right = true;
  for (const auto& course : courses_) {
    if (course.failed.empty()) continue;
    right = false;
    fmt::print(stderr, "{}: {}: {}\n", program, course.name, course.failed);
  }
  if (repetitions == 0) return right;
  fmt::print("{}", bench::markdown(machine));
  nlohmann::ordered_json tables = nlohmann::ordered_json::array();
  const ContestSites* last = nullptr;
  for (const auto& line : lines_) {
    if (last != nullptr && last->name == line.sites.name) continue;
    last = &line.sites;
    auto made = table(line.sites);
    made.notes = notes;
    tables.push_back(bench::json(made));
    fmt::print("\n{}", bench::markdown(made));
  }
  if (json.empty()) return right;
  std::ofstream out(json);
  out << nlohmann::ordered_json{{"machine", bench::json(machine)}, {"tables", tables}}.dump(1) << '\n';
  if (!out.flush()) return tl::unexpected(Error{ErrorCode::input, "cannot write " + json});
  return right;
}

}  // namespace vorpipe::test

/// Programs on the same sites: whether each is right, and how fast it was.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "bench/measured.h"
#include "bench/taken.h"

namespace vorpipe::test {

/// What a program computes of the sites; `polyhedra` is of cells in space.
enum class Job : std::uint8_t { triangulation, full, polyhedra };

/// What a run is for: first the result is compared with what is right; then times count.
enum class Purpose : std::uint8_t { check, warm_up, count };

/// Sites that all take, and their number.
struct ContestSites {
  std::string name;
  std::size_t count;
};

/// One line of a table.
struct Contest {
  std::string program, version, threads;
  Job job;
  ContestSites sites;
  bool is_peer;
  std::size_t course = 0;
  bench::Samples seconds{}, cpu_seconds{};
  double last_seconds = 0;

  void add(Taken taken, Purpose purpose) {
    last_seconds = taken.seconds;
    if (purpose != Purpose::count) return;
    seconds.push_back(taken.seconds);
    cpu_seconds.push_back(taken.cpu_seconds);
  }
};

/// The lines of all tables, and what runs for each of them.
class Contests {
 public:
  /// `run` reports its times to the line, and fails where its result is not right. What is short runs twice,
  /// and the second one counts: before it another program may have run for seconds, in all caches.
  void add(Contest line, std::function<Result<void>(Contest&, Purpose)> run);

  /// Runs all of them, and prints who was wrong, and a table for each of the sites: times, and speeds
  /// relative to CGAL's fastest triangulation and to the fastest peer with the same full job. Without
  /// repetitions, only whether all are right. Returns that. `json`: a file for the same, or empty.
  Result<bool> hold(const std::string& program, int repetitions, const std::vector<std::string>& notes,
                    const std::string& json);

 private:
  [[nodiscard]] bool wasRight(const Contest& line) const;
  template <class Wanted>
  const Contest* fastest(const std::string& sites, const Wanted& wanted) const;
  [[nodiscard]] bench::Table table(const ContestSites& sites) const;

  std::deque<Contest> lines_;
  std::vector<bench::Course> courses_;
};

}  // namespace vorpipe::test

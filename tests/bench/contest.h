/// vorpipe and other programs on the same sites: who computes what, whether it is right, and how fast it was.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "bench/input.h"
#include "bench/measured.h"
#include "bench/peers/peer.h"

namespace vorpipe::test {

enum class Job : std::uint8_t { triangulation, full };

/// A backend of vorpipe, opened with as many threads.
struct Opened {
  Session session;
  int threads;  ///< 0: all
};

/// What runs against each other. None of it is copied or moved once the contest begins.
struct Contestants {
  std::deque<Opened> sessions;
  std::vector<Peer> peers;
  Detail detail = Detail::measures;  ///< of vorpipe's cells
};

/// One set of sites, and what is right there.
struct Round {
  BenchInput input;
  Diagram reference;  ///< with triangles
};

/// What a run is for: first the result is compared with what is right; then times count.
enum class Purpose : std::uint8_t { check, warm_up, count };

/// One line of a table.
struct Contest {
  std::string program, version, threads;
  Job job;
  const Round* round;
  bool is_peer;
  const bench::Course* course = nullptr;
  bench::Samples seconds{}, cpu_seconds{};
  double last_seconds = 0;

  void add(Taken taken, Purpose purpose) {
    last_seconds = taken.seconds;
    if (purpose != Purpose::count) return;
    seconds.push_back(taken.seconds);
    cpu_seconds.push_back(taken.cpu_seconds);
  }
  /// No speed is told of what was wrong even once.
  [[nodiscard]] bool wasRight() const { return course->failed.empty() && !seconds.empty(); }
};

/// One course for each contestant that takes the sites of a round, and for each of its jobs; each contest's
/// times arrive as its course runs. A course fails when its result differs from the reference: in the number
/// of triangles; in a cell's status, neighbors or area; or if, in any repetition, the areas do not add up to
/// the domain's. What is short runs twice, and the second one counts: before it another program may have run
/// for seconds, in all caches.
std::vector<bench::Course> makeCourses(Contestants& contestants, const std::deque<Round>& rounds,
                                       std::deque<Contest>& contests);

/// The times of a round, and speeds relative to CGAL's triangulation and to the fastest full job of the
/// peers.
bench::Table makeTable(const Round& round, const std::deque<Contest>& contests);

}  // namespace vorpipe::test

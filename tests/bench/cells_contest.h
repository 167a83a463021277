/// vorpipe and other programs on the same sites of the plane.
#pragma once

#include <deque>
#include <vector>

#include "bench/contest.h"
#include "bench/input.h"
#include "bench/peers/peer.h"

namespace vorpipe::test {

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

/// Adds one line for each contestant that takes the sites of a round, and for each of its jobs. It fails when
/// its result differs from the reference: in the number of triangles; in a cell's status, neighbors or area;
/// or if, in any repetition, the areas do not add up to the domain's.
void addContests(Contestants& contestants, const std::deque<Round>& rounds, Contests& contests);

}  // namespace vorpipe::test

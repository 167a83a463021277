/// That two diagrams are the same, to the byte.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <string_view>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::test {

template <class T>
bool haveSameBytes(const std::vector<T>& a, const std::vector<T>& b) {
  // An empty vector has no place in memory to compare.
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

template <class T>
void expectSameBytes(const std::vector<T>& a, const std::vector<T>& b, std::string_view what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  EXPECT_TRUE(haveSameBytes(a, b)) << what;
}

/// Calls `each` with two vectors and a name for everything in a diagram but its report.
template <class Each>
void forBoth(const Diagram& a, const Diagram& b, const Each& each) {
  each(a.status, b.status, "status");
  each(a.owner, b.owner, "owner");
  each(a.area, b.area, "area");
  each(a.solid_angle, b.solid_angle, "solid angles");
  each(a.perimeter, b.perimeter, "perimeter");
  each(a.centroid, b.centroid, "centroid");
  each(a.second_moments, b.second_moments, "second moments");
  each(a.cell_offsets, b.cell_offsets, "cell offsets");
  each(a.vertices, b.vertices, "vertices");
  each(a.neighbors, b.neighbors, "neighbors");
  each(a.edge_lengths, b.edge_lengths, "edge lengths");
  each(a.neighbor_shifts, b.neighbor_shifts, "neighbor shifts");
  each(a.ring_starts, b.ring_starts, "ring starts");
  each(a.mass, b.mass, "mass");
  each(a.mass_centroid, b.mass_centroid, "mass centroid");
  each(a.triangles, b.triangles, "triangles");
}

inline void expectSameBytes(const Diagram& a, const Diagram& b) {
  forBoth(a, b,
          [](const auto& of_a, const auto& of_b, const char* what) { expectSameBytes(of_a, of_b, what); });
}

inline bool haveSameBytes(const Diagram& a, const Diagram& b) {
  bool same = true;
  forBoth(a, b,
          [&](const auto& of_a, const auto& of_b, const char*) { same = same && haveSameBytes(of_a, of_b); });
  return same;
}

}  // namespace vorpipe::test

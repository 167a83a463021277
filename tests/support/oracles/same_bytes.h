/// That two diagrams are the same, to the byte.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <string_view>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::test {

template <class T>
void expectSameBytes(const std::vector<T>& a, const std::vector<T>& b, std::string_view what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  // An empty vector has no place in memory to compare.
  EXPECT_TRUE(a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0) << what;
}

/// Everything in a diagram but its report.
inline void expectSameBytes(const Diagram& a, const Diagram& b) {
  expectSameBytes(a.status, b.status, "status");
  expectSameBytes(a.owner, b.owner, "owner");
  expectSameBytes(a.area, b.area, "area");
  expectSameBytes(a.solid_angle, b.solid_angle, "solid angles");
  expectSameBytes(a.perimeter, b.perimeter, "perimeter");
  expectSameBytes(a.centroid, b.centroid, "centroid");
  expectSameBytes(a.second_moments, b.second_moments, "second moments");
  expectSameBytes(a.cell_offsets, b.cell_offsets, "cell offsets");
  expectSameBytes(a.vertices, b.vertices, "vertices");
  expectSameBytes(a.neighbors, b.neighbors, "neighbors");
  expectSameBytes(a.edge_lengths, b.edge_lengths, "edge lengths");
  expectSameBytes(a.neighbor_shifts, b.neighbor_shifts, "neighbor shifts");
  expectSameBytes(a.ring_starts, b.ring_starts, "ring starts");
  expectSameBytes(a.mass, b.mass, "mass");
  expectSameBytes(a.mass_centroid, b.mass_centroid, "mass centroid");
  expectSameBytes(a.triangles, b.triangles, "triangles");
}

}  // namespace vorpipe::test

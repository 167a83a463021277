#include "core/drawing/convex_pieces.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vorpipe {

using namespace core;

namespace {

/// How far a point is beyond the lines of an entry.
double beyond(const CellBatch<float>& batch, const CellBatch<float>::Entry& entry, Point p) {
  double most = -1e9;
  for (auto l = entry.first; l < entry.first + entry.count; ++l) {
    const auto& line = batch.lines[l];
    most = std::max(most, p.x * line.nx + p.y * line.ny - double{line.h});
  }
  return most;
}

std::vector<Point> manyCorners() {
  std::vector<Point> polygon;
  for (int k = 0; k < 100; ++k) polygon.push_back({std::cos(M_PI * k / 50), std::sin(M_PI * k / 50)});
  return polygon;
}

TEST(Pieces, HoldEveryPointOfThePolygon) {
  CellBatch<float> batch;
  const auto pieces = appendPieces(manyCorners(), 8, 1e-9, batch);
  EXPECT_EQ(pieces, batch.entries.size());
  EXPECT_EQ(pieces, (100 - 2 + 5) / 6);
  for (const auto& entry : batch.entries) EXPECT_LE(entry.count, 8u);
  for (double angle = 0; angle < 6.3; angle += 0.01) {
    double nearest = 1;
    for (const auto& entry : batch.entries) {
      nearest = std::min(nearest, beyond(batch, entry, {0.99 * std::cos(angle), 0.99 * std::sin(angle)}));
    }
    EXPECT_LE(nearest, 1e-6) << angle;
  }
}

TEST(Pieces, AreLargerByNoMoreThanTheTolerance) {
  // Two edges of 100 meet 0.002 beyond the one between them.
  for (const double tolerance : {1e-9, 0.0025, 0.02}) {
    CellBatch<float> batch;
    EXPECT_EQ(appendPieces(manyCorners(), 100, tolerance, batch), 1u);
    const auto& entry = batch.entries[0];
    if (tolerance == 1e-9) {
      EXPECT_EQ(entry.count, 100u);
    } else {
      EXPECT_LE(entry.count, 50u);
    }
    for (const auto& p : manyCorners()) {
      const double outside = beyond(batch, entry, p);
      EXPECT_LE(outside, 1e-6) << "nothing is cut off";
      EXPECT_GE(outside, -1.001 * tolerance - 1e-6);
    }
  }
}

TEST(Pieces, DoNotGrowBeyondTheTipOfASliver) {
  // Without the edge between its first two vertices, it would be twice as long.
  const std::vector<Point> sliver{{1e-8, 0.5}, {0, 0.51}, {-1e-8, 0}, {1e-8, 0}};
  CellBatch<float> batch;
  EXPECT_EQ(appendPieces(sliver, 100, 1e-5, batch), 1u);
  EXPECT_LE(batch.entries[0].north, 0.51f + 2e-5f);
}

}  // namespace
}  // namespace vorpipe

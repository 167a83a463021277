/// Sites of a run: scaled, in the order of bins, each position once.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/big_vector.h"
#include "space/heaviest.h"
#include "space/label.h"
#include "space/polyhedron_lanes.h"
#include "vorpipe/result.h"

namespace vorpipe::space {

/// Bins that follow one another, from `begin` to `end` - 1.
struct BinLine {
  std::uint32_t begin, end;
};

/// Sites of the caller as a run uses them.
struct SiteBins {
  double scale = 1;         ///< a power of two: coordinates of a run are those of the caller times this
  Box3 box{};               ///< of the run
  BigVector<Point3> sites;  ///< bin by bin
  std::vector<std::uint32_t> input;  ///< by site of the run: its index among those of the caller
  std::vector<std::uint32_t>
      owner;  ///< by site of the caller: the heaviest with the same position, the first

  int count[3] = {1, 1, 1};          ///< of bins along each axis
  double side = 1;                   ///< of a bin
  Point3 corner{};                   ///< of bin (0, 0, 0)
  std::vector<std::uint32_t> begin;  ///< by bin, x first, then y: its first site
  BigVector<float> x, y, z;          ///< by site: relative to the corner of its bin
  std::vector<BinStep> steps;        ///< see LaneBins

  // With weights that differ, else empty:
  BigVector<double> weights;         ///< by site: those of the caller times the square of the scale
  HeaviestOfBlocks heaviest;         ///< of the bins
  std::vector<std::uint32_t> heavy;  ///< see LaneBins, as all that follows
  BigVector<float> weight;
  std::vector<float> heaviest_of_bin, heaviest_around;
  float most_weight = 0;
  double least_weight = 0;

  [[nodiscard]] bool hasWeights() const { return !weights.empty(); }
  [[nodiscard]] Places places() const { return {sites.data(), box, hasWeights() ? weights.data() : nullptr}; }
  [[nodiscard]] LaneBins lanes() const;
  /// The bin of a site, along each axis.
  [[nodiscard]] std::array<int, 3> binOf(const Point3& site) const;
  /// The same as one number: as `begin` has them.
  [[nodiscard]] std::uint32_t indexOfBin(const Point3& site) const {
    const auto bin = binOf(site);
    return static_cast<std::uint32_t>((bin[2] * count[1] + bin[1]) * count[0] + bin[0]);
  }
  /// All bins, in cubes of 8 x 8 x 8: what is done in this order finds what it knows of sites around in
  /// memory that was used shortly before.
  [[nodiscard]] std::vector<BinLine> linesOfCubes() const;
  [[nodiscard]] std::uint32_t bins() const { return static_cast<std::uint32_t>(begin.size() - 1); }
};

/// Bins at least one site. They are finite, and `domain` is a valid box; weights are as many, or none.
/// Weights of less than 2^-600 squared domains count as 0.
SiteBins binSites(std::span<const Point3> callers, const Box3& domain, int threads,
                  std::span<const double> weights = {});

}  // namespace vorpipe::space

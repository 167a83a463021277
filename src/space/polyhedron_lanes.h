/// Proposes cells in space: one after another, with their vertices side by side
/// (shaders/glsl/polyhedron.glsl).
#pragma once

#include <cstddef>
#include <cstdint>

namespace vorpipe::space {

/// Places of bins relative to one another, by ascending distance from a part of a bin.
struct BinStep {
  std::int8_t x, y, z;
  std::int8_t far;         ///< the largest of their magnitudes
  std::int32_t ahead = 0;  ///< among bins as LaneBins has them
  float squared_distance;  ///< least, between the part and the bin, in sides of bins
};

/// Parts of a bin along an axis, each of which has an order of the bins around.
constexpr int parts_of_bin = 4;

/// Sites in bins, for the lanes: plain arrays, because lanes are compiled for other instructions.
struct LaneBins {
  int count[3];                ///< of bins along each axis
  float side;                  ///< of a bin
  const std::uint32_t* begin;  ///< by bin, x first, then y: its first site
  const float *x, *y, *z;      ///< by site: relative to the corner of its bin
  const double* places;        ///< by site: x, y, z, as double takes them
  double low[3], high[3];      ///< the domain, likewise
  float corner[3];             ///< of bin (0, 0, 0), relative to that of the domain
  float extent[3];             ///< of the domain
  const BinStep* steps;        ///< for each part, x first: step_count of them
  std::size_t step_count;

  // With weights, else null:
  double least_weight;    ///< of all
  const float* weight;    ///< by site: less the least; of heavy ones -infinity, so that bins do not name them
  const double* weights;  ///< by site
  const float* heaviest;  ///< by bin: the largest of those that are not heavy
  const float* heaviest_around;  ///< by bin: the largest of the bins that steps lead to
  float most_weight;             ///< of those that are not heavy
  const std::uint32_t* heavy;    ///< sites that every cell is cut with, after those in bins
  std::size_t heavy_count;
};

enum class Proposed : std::uint8_t { whole, empty, uncertain };

/// A cell as its faces and vertices.
struct ProposedCell {
  Proposed state;
  int faces, vertices;
  std::int32_t neighbor[64];   ///< by face
  std::uint8_t corner[64][4];  ///< by vertex: its faces, counter-clockwise seen from outside
  std::int32_t emptied_by[4];  ///< of an empty cell: why, as NoCell has it
};

/// Calls take(context, site, cell) for the sites from `first` to `last` - 1, the first of which is in `bin`.
using ProposeCells = void (*)(const LaneBins& bins, std::uint32_t bin, std::uint32_t first,
                              std::uint32_t last,
                              void (*take)(void* context, std::uint32_t site, const ProposedCell& cell),
                              void* context);

/// Float takes half of the time of double, which tells vertices apart that are 1e-6 as near to each other.
/// The widest that the processor has; VORPIPE_LANES limits it.
enum class Precision : std::uint8_t { in_float, in_double };
ProposeCells proposeCells(Precision precision);

}  // namespace vorpipe::space

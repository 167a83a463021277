/// Areas, centroids and numbers of neighbors, tile by tile, for more cells than fit into memory at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <span>

#include "vorpipe/result.h"
#include "vorpipe/run.h"
#include "vorpipe/sites.h"

namespace vorpipe {

class Session;

/// Numbers read in place, from the caller's memory or a mapped file, `stride` bytes apart, without any
/// alignment.
struct NumbersInPlace {
  const std::byte* first = nullptr;
  std::size_t stride = sizeof(double);
  bool are_floats = false;  ///< float instead of double

  double operator[](std::size_t i) const {
    const std::byte* at = first + i * stride;
    if (are_floats) return read<float>(at);
    return read<double>(at);
  }

 private:
  template <class Real>
  static double read(const std::byte* at) {
    Real value;
    std::memcpy(&value, at, sizeof value);
    return value;
  }
};

/// Sites without weights, read in place instead of copied.
struct SitesInPlace {
  NumbersInPlace x, y;
  std::uint64_t count = 0;
};

/// The sites of arrays, which outlive the result.
SitesInPlace sitesInPlace(const Sites& sites);

struct TiledOptions {
  Box domain;
  SearchOptions search{};
  /// Number of sites of a tile, with those around it: the usual number, and the maximum. If more than `most`
  /// are crowded together, that is an error.
  std::uint64_t usual = std::uint64_t{1} << 20, most = ~std::uint64_t{0};
  Progress progress{};
};

/// The measures of a cell without its edges; as in CellRecord and Diagram.
struct CellMeasures {
  double area;
  Point centroid;
  std::uint32_t neighbors;  ///< their number, walls included
  Status status;
};

/// Receives the cells of some sites; over all calls, each site once. An error ends the run.
using CellsSink =
    std::function<Result<void>(std::span<const std::uint32_t> sites, std::span<const CellMeasures> measures)>;

struct TiledReport {
  Report report;
  std::uint64_t tiles = 0;    ///< number of tiles
  std::uint64_t largest = 0;  ///< number of sites of the largest tile, with those around it
  std::uint64_t open =
      0;  ///< cells that reached beyond the surroundings of their tile, and were computed separately
  double area_sum = 0;  ///< of all cells, without the rounding error of summation
};

/// Measures the cells of sites read in place. Beside the sites it takes 4 bytes for each, and the memory of
/// Session::cells for the sites of a tile. Every cell is certified, and equal to that of Session::cells to
/// the last bit, whatever the tiles.
class CellsInTiles {
 public:
  /// The session outlives this.
  CellsInTiles(Session& session, TiledOptions options);

  /// Errors: those of Session::cells; those of the sink; more sites in one place than a tile may have
  /// (input).
  Result<TiledReport> measure(const SitesInPlace& sites, const CellsSink& sink);

 private:
  Session& session_;
  TiledOptions options_;
};

}  // namespace vorpipe

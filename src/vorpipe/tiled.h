/// Areas, centroids and numbers of neighbors of more cells than there is memory for at once, tile by tile.
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

/// Numbers that stay where they are, in the caller's memory or in a mapped file, `stride` bytes apart and
/// aligned in no way.
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

/// Sites without weights that are read and not copied.
struct SitesInPlace {
  NumbersInPlace x, y;
  std::uint64_t count = 0;
};

/// Those of arrays, which outlive it.
SitesInPlace sitesInPlace(const Sites& sites);

struct TiledOptions {
  Box domain;
  SearchOptions search{};
  /// Sites of a tile, with those around it: how many there should be, and at most. Where more than `most` are
  /// crowded together, that is an error.
  std::uint64_t usual = std::uint64_t{1} << 20, most = ~std::uint64_t{0};
  Progress progress{};
};

/// What is known of a cell without its edges; as CellRecord and Diagram have it.
struct CellMeasures {
  double area;
  Point centroid;
  std::uint32_t neighbors;  ///< how many, walls among them
  Status status;
};

/// Gets the cells of some sites, each site once in all. An error ends the run.
using CellsSink =
    std::function<Result<void>(std::span<const std::uint32_t> sites, std::span<const CellMeasures> measures)>;

struct TiledReport {
  Report report;
  std::uint64_t tiles = 0;    ///< that the sites were cut into
  std::uint64_t largest = 0;  ///< sites of the largest, with those around it
  std::uint64_t open = 0;     ///< cells that reached beyond what is around their tile, and were found apart
  double area_sum = 0;        ///< of all cells, without what adding up would round off
};

/// Measures the cells of sites that stay where they are. Beside them it takes 4 bytes for each site, and what
/// Session::cells takes for those of a tile. Every cell is certified, and the same to the last bit as those
/// of Session::cells, whatever the tiles.
class CellsInTiles {
 public:
  /// The session outlives this.
  CellsInTiles(Session& session, TiledOptions options);

  /// Errors: as Session::cells'; those of the sink; more sites in one place than a tile may have (input).
  Result<TiledReport> measure(const SitesInPlace& sites, const CellsSink& sink);

 private:
  Session& session_;
  TiledOptions options_;
};

}  // namespace vorpipe

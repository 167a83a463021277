/// A spatial index of a run's sites. It does not store coordinates, which stay in the caller's memory.
#pragma once

#include <functional>
#include <vector>

#include "base/big_vector.h"
#include "sites/bin_sort.h"
#include "sites/grid.h"
#include "vorpipe/tiled.h"

namespace vorpipe::core {

/// The numbers of sites, grouped by the cells of a lattice and ascending in each. Lattice cells are squares
/// of 8 x 8 bins of the grid that a run over all sites would have.
class SiteCells {
 public:
  static constexpr std::uint32_t bins_along = 8;

  /// Errors (input): no sites, or too many; a site that is not finite or too far away; an invalid domain.
  /// Error (cancelled): progress said stop.
  static Result<SiteCells> over(const SitesInPlace& sites, const Box& domain, int threads,
                                const Progress& progress);

  [[nodiscard]] const SitesInPlace& sites() const { return sites_; }
  [[nodiscard]] int exponent() const { return exponent_; }
  [[nodiscard]] const Box& domain() const { return domain_; }  ///< in scaled units
  [[nodiscard]] const Grid& grid() const { return grid_; }     ///< of all sites, without offsets
  [[nodiscard]] const Grid& lattice() const { return lattice_; }
  [[nodiscard]] BinBlock all() const { return {0, 0, lattice_.columns - 1, lattice_.rows - 1}; }

  /// Number of sites in a block of the lattice's cells.
  [[nodiscard]] std::uint64_t count(const BinBlock& block) const;

  /// The bins of a block of cells.
  [[nodiscard]] BinBlock binsOf(const BinBlock& block) const;

  /// In scaled units.
  [[nodiscard]] Point place(std::size_t site) const {
    return {scale_(sites_.x[site]), scale_(sites_.y[site])};
  }
  [[nodiscard]] std::uint32_t bin(Point place) const { return binOf(grid_, place.x, place.y); }

  /// Calls take(sites) with the sites of each row of cells in a block.
  template <class Take>
  void eachRow(const BinBlock& block, const Take& take) const {
    for (auto row = block.south; row <= block.north; ++row) {
      const auto first = std::size_t{row} * lattice_.columns;
      const auto begin = offsets_[first + block.west], end = offsets_[first + block.east + 1];
      take(std::span<const std::uint32_t>(order_.data() + begin, end - begin));
    }
  }

  /// Adds up to `most` sites that are nearer than `within` to a place in the domain and that `wanted`
  /// accepts. Sites of near cells come first. Adds at least one if any exists. In scaled units.
  void addNear(Point from, double within, std::size_t most, const std::function<bool(std::uint32_t)>& wanted,
               std::vector<std::uint32_t>& found) const;

 private:
  SiteCells(const SitesInPlace& sites, const Box& domain);
  Result<void> findGrid(int threads);
  void sort(int threads);
  void addUp();
  [[nodiscard]] std::uint32_t cellOf(std::size_t site) const;
  void addNearest(const BinBlock& cell, Point from, double within, std::size_t all_found,
                  const std::function<bool(std::uint32_t)>& wanted, std::vector<std::uint32_t>& found) const;
  [[nodiscard]] double distanceTo(const BinBlock& block, Point from) const;

  SitesInPlace sites_;
  int exponent_;
  PowerOfTwo scale_;
  Box domain_;
  Grid grid_, lattice_;
  std::vector<std::uint32_t> offsets_;  ///< by cell of the lattice, and one more
  BigVector<std::uint32_t> order_;
  std::vector<std::uint64_t> sums_;  ///< sites below and to the left of each corner of the lattice
};

}  // namespace vorpipe::core

/// Exact cells that were computed before, for sites whose surroundings are the same.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "space/site_bins.h"

namespace vorpipe::space {

/// A cell as Rows::set takes it: the labels of its faces, and its vertices' faces.
struct ExactRow {
  std::vector<Label> neighbors;
  std::vector<std::array<std::uint32_t, 3>> vertices;
  void set(std::span<const std::array<Label, 3>> corners);
};

/// The exact cell of a site depends on the exact differences between the sites and walls around and it, and
/// between their weights, ties included: they are broken by the order of coordinates. In lattices these
/// differences repeat, even where coordinates are rounded. Cells are kept by them, in a table of fixed size;
/// one for each thread. Where few repeat it is asked less and less.
class CellMemo {
 public:
  explicit CellMemo(const SiteBins& bins);
  /// Whether there is a cell with the same sites around; it is written to `row`.
  bool find(Label site, ExactRow& row);
  /// Keeps the exact cell of the last site that was not found: within the root of `squared_radius` from it.
  void keep(const ExactRow& row, double squared_radius);
  [[nodiscard]] std::size_t found() const { return found_; }

  /// All sites that are at most that far from the last site, and walls; none if it was not looked around.
  [[nodiscard]] std::span<const Label> around() const { return usable_ ? around_ : std::span<const Label>(); }
  [[nodiscard]] double squaredReach() const { return squared_reach_; }

 private:
  struct Difference {
    double x, y, z;                 ///< rounded
    double rest_x, rest_y, rest_z;  ///< what rounding took
    double lighter, rest_lighter;   ///< weights, likewise
    bool operator==(const Difference&) const = default;
  };
  struct Known {
    std::uint64_t key = 0;
    double squared_radius = 0;
    Label site = 0;
    std::vector<Label> around;        ///< in the order of order()
    std::vector<std::uint8_t> faces;  ///< which of these
    std::vector<std::array<std::uint8_t, 3>> vertices;
  };
  static constexpr std::size_t most_around = 160;

  bool isWorthAsking();
  bool lookAround(Label site);
  bool order();
  [[nodiscard]] Difference difference(Label from_site, Label to) const;
  /// All sites that can cut a cell of the last site are within the root of this.
  [[nodiscard]] double reachOf(double squared_radius) const;
  [[nodiscard]] Known& placeOf(std::uint64_t key) { return table_[(key >> 32U) % table_.size()]; }
  [[nodiscard]] bool isSame(const Known& known) const;
  void write(const Known& known, ExactRow& row) const;

  const SiteBins& bins_;
  std::vector<Known> table_;
  std::size_t found_ = 0;
  std::uint32_t asked_ = 0, found_of_asked_ = 0;  ///< lately
  std::uint32_t pass_over_ = 0, next_pass_ = 0;   ///< how many sites are not asked about, now and next
  double squared_reach_ = 0;                      ///< sites are looked for within the root of this
  // Of the last site.
  Label site_ = 0;
  bool usable_ = false;
  std::uint64_t key_ = 0;
  std::vector<Label> near_;  ///< as they were found
  std::vector<std::int32_t> near_key_, rank_;
  std::vector<Label> around_;  ///< the same in the order of their keys
};

}  // namespace vorpipe::space

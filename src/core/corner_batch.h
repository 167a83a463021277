/// The corners of many inner cells at once, one array for each coordinate, so that the compiler works on
/// several corners with one instruction.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/place.h"

namespace vorpipe {

/// Cells without walls around sites inside the domain. A cell of m edges has m + 1 slots: slot k is its
/// corner where edge k begins, and the last is the first again, so that edge k runs from slot k to the
/// next. What is said of an edge in a cell's last slot means nothing.
class CornerBatch {
 public:
  static constexpr std::size_t most_slots = 256;
  static constexpr std::size_t most_edges = 62;
  static constexpr std::size_t most_cells = 64;

  enum class Added : std::uint8_t {
    yes,
    full,   ///< no room is left for this cell
    other,  ///< not an inner cell, or one of more than most_edges edges
  };

  explicit CornerBatch(const SiteSet& sites) : sites_(sites) {}

  void clear() { cells_ = slots_ = 0; }
  /// `row` is the neighbors of `cell`, counter-clockwise; it outlives the batch's use.
  Added add(std::uint32_t cell, std::span<const std::int32_t> row);

  /// Computes all places; then, the excess length of each edge, as edgeSpan has it.
  void place();

  /// Computes what edges add to the measures of their cells.
  void measure();

  [[nodiscard]] std::size_t size() const { return cells_; }
  [[nodiscard]] std::uint32_t cell(std::size_t k) const { return cell_[k]; }
  [[nodiscard]] std::span<const std::int32_t> row(std::size_t k) const { return row_[k]; }
  [[nodiscard]] std::size_t slot(std::size_t k) const { return slot_[k]; }

  [[nodiscard]] double excess(std::size_t slot) const { return excess_[slot]; }
  [[nodiscard]] Place placeOf(std::size_t slot) const {
    return {{base_x_[slot], base_y_[slot]}, {rest_x_[slot], rest_y_[slot]}};
  }
  /// After measure(): twice the signed area of the triangle from the site to the edge, and six times its
  /// first moments about the site; with weights, from and about the cell's first corner.
  [[nodiscard]] double cross(std::size_t slot) const { return cross_[slot]; }
  [[nodiscard]] Point moment(std::size_t slot) const { return {moment_x_[slot], moment_y_[slot]}; }

 private:
  using Lane = std::array<double, most_slots>;
  void addWeights(std::size_t cell);
  template <bool weighted>
  void placeAll();
  void takeOrigins();
  void measureAbout(const Lane& x, const Lane& y);
  void placeWhereUnsure();

  const SiteSet& sites_;
  std::size_t cells_ = 0, slots_ = 0;
  std::array<std::uint32_t, most_cells> cell_;
  std::array<std::size_t, most_cells> slot_;
  std::array<std::span<const std::int32_t>, most_cells> row_;
  Lane site_x_, site_y_, before_x_, before_y_, after_x_, after_y_;
  Lane site_w_, before_w_, after_w_, origin_x_, origin_y_;  ///< where sites have weights
  Lane base_x_, base_y_, rest_x_, rest_y_, sure_;
  Lane excess_, cross_, moment_x_, moment_y_;
};

}  // namespace vorpipe

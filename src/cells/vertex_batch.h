/// The corners of many inner cells at once, in structure-of-arrays layout, so that loops over cells are
/// vectorized.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "geometry/center_batch.h"
#include "geometry/vertex_position.h"

namespace vorpipe::core {

/// Cells without walls around sites inside the domain, all of the same number of edges. Corner e of a cell
/// is where its edge e begins.
class CornerBatch {
 public:
  static constexpr std::size_t most_corners = 256;
  static constexpr std::size_t most_edges = 62;
  static constexpr std::size_t most_cells = 64;

  enum class Added : std::uint8_t {
    yes,
    full,   ///< no room is left, or the batch's cells have another number of edges
    other,  ///< not an inner cell, or one of more than most_edges edges
  };

  explicit CornerBatch(const SiteSet& sites) : sites_(sites) {}

  void clear() { cells_ = 0; }
  /// `row` is the neighbors of `cell`, counter-clockwise; it outlives the batch's use.
  Added add(std::uint32_t cell, std::span<const std::int32_t> row);
  /// The same, but never returns `full`: then calls finish(), which uses and clears the batch, and adds the
  /// cell.
  template <class Finish>
  Added add(std::uint32_t cell, std::span<const std::int32_t> row, const Finish& finish) {
    const auto added = add(cell, row);
    if (added != Added::full) return added;
    finish();
    return add(cell, row);
  }

  /// Computes the positions of all corners, then the excess length of each edge, as EdgeSpan::excess.
  void place();

  /// Measures the cells about their sites; with weights, about their first corners.
  void measure();
  /// The same, and second moments.
  void measureSpread();

  [[nodiscard]] std::size_t size() const { return cells_; }
  [[nodiscard]] std::uint32_t cell(std::size_t k) const { return cell_[k]; }
  [[nodiscard]] std::span<const std::int32_t> row(std::size_t k) const { return row_[k]; }

  [[nodiscard]] double excess(std::size_t k, std::size_t e) const { return excess_[at(k, e)]; }
  [[nodiscard]] AnchoredPoint placeOf(std::size_t k, std::size_t e) const {
    const auto c = at(k, e);
    return {{base_x_[c], base_y_[c]}, {rest_x_[c], rest_y_[c]}};
  }
  /// After measure(): twice the area, and six times the first moments about where it was measured.
  [[nodiscard]] double twiceArea(std::size_t k) const { return twice_area_[k]; }
  [[nodiscard]] Point moment(std::size_t k) const { return {moment_x_[k], moment_y_[k]}; }
  /// After measureSpread(): twelve times the integral of the squared distance to where it was measured.
  [[nodiscard]] double spread(std::size_t k) const { return spread_[k]; }

 private:
  using ByCorner = std::array<double, most_corners>;
  using ByCell = std::array<double, most_cells>;

  [[nodiscard]] std::size_t at(std::size_t k, std::size_t e) const { return e * width_ + k; }
  [[nodiscard]] std::size_t before(std::size_t e) const { return e > 0 ? e - 1 : edges_ - 1; }
  [[nodiscard]] std::size_t after(std::size_t e) const { return e + 1 < edges_ ? e + 1 : 0; }
  void takeShape(std::size_t edges);
  void addWeights(std::size_t k);
  template <bool weighted>
  void placeAll();
  void placeWhereUnsure();
  void placeUnsure();
  void measureFarEdges(double shorter_side);
  void takeOrigins();
  template <bool spread>
  void measureAll(const ByCell& x, const ByCell& y);

  const SiteSet& sites_;
  std::size_t cells_ = 0, edges_ = 0;  ///< of each cell
  std::size_t width_ = 0;              ///< number of cells that fit
  std::array<std::uint32_t, most_cells> cell_;
  std::array<std::span<const std::int32_t>, most_cells> row_;
  ByCell site_x_, site_y_, site_w_, origin_x_, origin_y_;  ///< weights and origins: where sites have weights
  ByCorner other_x_, other_y_, other_w_;                   ///< of the neighbor across each edge
  ByCorner base_x_, base_y_, rest_x_, rest_y_, sure_, excess_;
  ByCell all_sure_, twice_area_, moment_x_, moment_y_, spread_;
  CenterBatch unsure_;
};

}  // namespace vorpipe::core

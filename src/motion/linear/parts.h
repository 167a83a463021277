/// Connected parts of a graph, and means over them.
#pragma once

#include <cstdint>
#include <vector>

#include "motion/linear/laplacian.h"

namespace vorpipe::moving {

/// The parts whose extras are all 0, so that adding a constant there leaves the matrix product unchanged.
class SingularParts {
 public:
  static SingularParts of(const Laplacian& matrix, int threads);

  /// Subtracts from `values` their mean over each of these parts.
  void removeMeans(std::vector<double>& values, int threads) const;

  [[nodiscard]] std::size_t count() const { return rows_.size(); }
  /// The part number of each row; count() or more if it belongs to no such part.
  [[nodiscard]] const std::vector<std::uint32_t>& partOf() const { return part_of_; }

 private:
  std::vector<std::uint32_t> part_of_;
  std::vector<std::uint32_t> rows_;  ///< by part: their number
};

}  // namespace vorpipe::moving

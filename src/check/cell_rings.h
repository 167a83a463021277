/// The rings of one cell of a diagram whose domain has an outline.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "check/run.h"

namespace vorpipe::core::checks {

class CellRings {
 public:
  CellRings(const CheckedCells& run, std::size_t i) : run_(run), end_(run.end(i)) {
    const auto& starts = run.diagram.ring_starts;
    for (auto s = std::ranges::lower_bound(starts, run.begin(i)); s != starts.end() && *s < end_; ++s) {
      starts_.push_back(*s);
    }
  }
  [[nodiscard]] std::size_t size() const { return starts_.size(); }
  [[nodiscard]] std::size_t begin(std::size_t r) const { return starts_[r]; }
  [[nodiscard]] std::size_t end(std::size_t r) const { return r + 1 < size() ? starts_[r + 1] : end_; }
  [[nodiscard]] std::size_t next(std::size_t r, std::size_t e) const {
    return e + 1 < end(r) ? e + 1 : begin(r);
  }

  /// Calls take(edge, from, to) for each edge.
  template <class Take>
  void eachEdge(const Take& take) const {
    for (std::size_t r = 0; r < size(); ++r) {
      for (std::size_t e = begin(r); e < end(r); ++e) take(e, run_.vertex(e), run_.vertex(next(r, e)));
    }
  }

 private:
  const CheckedCells& run_;
  std::size_t end_;
  std::vector<std::size_t> starts_;
};

}  // namespace vorpipe::core::checks

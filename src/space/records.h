/// Measures of cells, where a diagram has them: in the caller's order and units.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "space/empty_balls.h"
#include "space/label.h"
#include "space/measures.h"
#include "space/rows.h"

namespace vorpipe::space {

/// Writes volume, surface, centroid, second moments, face_offsets and face_areas of a diagram. Threads may
/// write different cells at the same time.
class Records {
 public:
  /// `input` is the caller's index by site of the run, whose coordinates times `unit` are the caller's. The
  /// diagram is as if no site had a cell.
  Records(const Places& places, double unit, std::span<const std::uint32_t> input,
          std::span<const Point3> callers_sites, Detail3 detail, int threads, Diagram3& diagram);

  [[nodiscard]] bool wantMoments() const { return moments_; }
  /// Whether a cell is wanted: it need not be measured else.
  [[nodiscard]] bool wants(std::size_t site) const { return input_[site] < wanted_; }
  void want(std::size_t first) { wanted_ = first; }
  /// Has `beyond`, by the caller's index, written of each cell: see EmptyBalls, in units of the caller.
  void watchBalls(const EmptyBalls& balls, std::span<double> beyond) {
    balls_ = balls;
    beyond_ = beyond;
  }
  template <class Vertex>
  void writeBalls(std::size_t site, std::size_t count, const Vertex& vertex) {
    if (beyond_.empty()) return;
    const double weight = places_.weights == nullptr ? 0 : places_.weights[site];
    beyond_[input_[site]] = unit_ * balls_.beyond(places_.sites[site], weight, count, vertex);
  }
  /// Makes room for the areas of all faces of the rows.
  void layOut(const Rows& rows, int threads);
  /// Whether there is room for so many faces of a site, no more and no less.
  [[nodiscard]] bool hasRoom(std::size_t site, std::size_t faces) const {
    const std::uint64_t* const from = out_.face_offsets.data() + input_[site];
    return from[1] - from[0] == faces;
  }
  /// Has the processor read where a site's areas are, and a while later what is written of it.
  void prefetchOffsets(std::size_t site) const { __builtin_prefetch(&out_.face_offsets[input_[site]]); }
  void prefetch(std::size_t site) const {
    const std::uint32_t to = input_[site];
    __builtin_prefetch(&out_.volume[to], 1);
    __builtin_prefetch(&out_.surface[to], 1);
    __builtin_prefetch(&out_.centroid[to], 1);
    constexpr std::size_t in_line = 8, lines = 3;
    const double* const area = out_.face_areas.data() + out_.face_offsets[to];
    for (std::size_t k = 0; k < lines; ++k) __builtin_prefetch(area + k * in_line, 1);
  }
  /// Without the areas.
  void write(std::size_t site, const CellMeasures& measures, const std::array<double, 6>& moments);
  void writeArea(std::size_t site, std::size_t face, double area) {
    out_.face_areas[out_.face_offsets[input_[site]] + face] = area * unit_ * unit_;
  }

 private:
  Places places_;
  double unit_;
  std::span<const std::uint32_t> input_;
  bool moments_;
  Diagram3& out_;
  EmptyBalls balls_{};
  std::span<double> beyond_;
  std::size_t wanted_;  ///< cells of the first of the caller's sites
};

}  // namespace vorpipe::space

/// Draws cells from their nearest neighbors, as in the thesis.
#pragma once

#include "core/drawing/batch_drawing.h"
#include "core/search/flann_search.h"

namespace vorpipe::core {

/// Rounds: k neighbors for all; more room for those that overflow; twice the neighbors for those that
/// other sites might still cut, as long as that certifies at least half of them
/// or the lists are short. The lists of the first
/// view are kept for the others.
class ListDrawing {
 public:
  /// `several_views`: draw is called more than once.
  ListDrawing(const Canvas& canvas, std::size_t neighbors, bool several_views, const Progress& progress);

  /// Draws the cells of `which`, in later views the same or fewer. Returns those that were not drawn.
  Result<std::vector<std::uint32_t>> draw(const View& view, std::span<const std::uint32_t> which);

  [[nodiscard]] std::uint64_t retried() const { return retried_; }
  [[nodiscard]] double searchSeconds() const { return search_seconds_; }
  [[nodiscard]] double drawSeconds() const { return drawing_.seconds(); }

 private:
  using Indices = std::vector<std::uint32_t>;
  struct Step {
    Candidates candidates;
    Effort effort;
  };
  /// What became of cells that are not drawn yet.
  struct Undrawn {
    Indices roomier, unsecured, other;
  };

  Result<Indices> drawAgain(const View& view, std::span<const std::uint32_t> which);
  Result<Undrawn> round(const View& view, const Indices& which, std::size_t k);
  Result<Undrawn> drawNeighbors(const View& view, const Indices& which, std::size_t k, Effort effort,
                                const char* stage);

  Canvas canvas_;
  std::size_t neighbors_;
  bool several_views_;
  const Progress& progress_;
  FlannSearch search_;
  BatchDrawing drawing_;
  std::vector<Step> steps_;
  bool drawn_ = false;
  std::uint64_t retried_ = 0;
  double search_seconds_ = 0;
};

}  // namespace vorpipe::core

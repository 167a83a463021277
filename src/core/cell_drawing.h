/// Draws every cell of a diagram on a backend, and redoes cells until each is certified.
#pragma once

#include "backend/backend.h"
#include "core/candidates.h"
#include "core/flann_search.h"
#include "core/host_search.h"

namespace vorpipe {

/// What a drawing works with; all of it outlives the drawing.
struct DrawingInput {
  Backend& backend;
  Backend& judge;  ///< clips in double what the backend does not certify
  const SiteSet& sites;
  const FlannSearch& search;
  std::span<const std::uint8_t> shade;  ///< by index in the set
  std::size_t neighbors;                ///< of the first round
  int threads;
  const Progress& progress;
  bool several_views;  ///< remember the candidates for the views after the first
};

/// Rounds: k neighbors for all; more room for those that overflow; twice the neighbors for those
/// that other sites might still cut, as long as that certifies at least half of them; the rest by
/// the host's search in double. Cells are drawn in an order that depends on nothing but the sites.
class CellDrawing {
 public:
  explicit CellDrawing(const DrawingInput& input);

  /// Draws all cells into the picture that the backend has begun.
  Result<void> draw(const View& view);

  /// certified or empty, by index in the set.
  [[nodiscard]] const std::vector<CellStatus>& status() const { return status_; }
  [[nodiscard]] std::uint64_t retried() const { return retried_; }
  [[nodiscard]] std::uint64_t inDouble() const { return in_double_; }
  [[nodiscard]] double searchSeconds() const { return search_seconds_; }
  [[nodiscard]] double drawSeconds() const { return draw_seconds_; }

 private:
  using Indices = std::vector<std::uint32_t>;
  struct Pieces {
    Indices site;  ///< by entry
    CellBatch<float> batch;
  };
  struct Step {
    Candidates candidates;
    Room room;
  };

  Result<void> searchAndDraw();
  Result<void> drawAgain();
  Result<Indices> round(const Indices& which, std::size_t k);
  Indices afterRound(const Indices& which);
  Result<void> drawNeighbors(const Indices& which, std::size_t k, Room room, const char* stage);
  Result<void> drawStep(const Candidates& candidates, Room room);
  Result<void> drawBatch(const CellBatch<float>& batch, std::span<const std::uint32_t> site, Room room);
  Result<void> drawFromHost();
  Result<void> drawHostCells(const HostCells& cells);
  Result<void> drawPieces(const HostCells& cells, const Indices& entries);
  Result<void> checkOutsiders();
  Result<void> report(const char* stage, std::size_t done, std::size_t of) const;
  [[nodiscard]] std::size_t entriesPerBatch(std::size_t lines_per_entry) const;
  [[nodiscard]] Indices withStatus(const Indices& which, CellStatus status) const;

  DrawingInput input_;
  const View* view_ = nullptr;
  std::vector<CellStatus> status_;
  Indices for_host_;
  std::vector<Step> steps_;
  std::vector<Pieces> pieces_;
  std::vector<DrawMark> marks_;
  CellBatch<float> batch_;
  std::vector<CellStatus> answers_;
  std::uint64_t retried_ = 0;
  std::uint64_t in_double_ = 0;
  double search_seconds_ = 0;
  double draw_seconds_ = 0;
};

}  // namespace vorpipe

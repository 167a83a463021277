/// A backend that measures how long each call of another one takes.
#pragma once

#include <array>
#include <cstdint>

#include "backend/exact_tier.h"
#include "backend/forwarding_backend.h"

namespace vorpipe::bench {

/// The parts of a run. `order` and `search` are core's own, and so is `rest`; the others are calls of a
/// backend, and `resolve` is all calls of the exact tier.
enum class Stage : std::uint8_t { order, search, upload, clip, draw, download, resolve, rest };
inline constexpr std::size_t stage_count = 8;
inline constexpr std::array<const char*, stage_count> stage_names = {"order", "search",   "upload",  "clip",
                                                                     "draw",  "download", "resolve", "rest"};

struct StageWork {
  double seconds = 0;         ///< on the host's clock
  double device_seconds = 0;  ///< on the device's own, if it has one
  std::uint64_t calls = 0;
  std::uint64_t sent = 0, received = 0;  ///< bytes handed over in calls of the interface
};

using Work = std::array<StageWork, stage_count>;

/// Forwards every call.
class TimedBackend final : public ForwardingBackend {
 public:
  using ForwardingBackend::ForwardingBackend;

  Result<void> upload(const SiteSet& sites, std::span<const std::uint8_t> palette_index) override;
  Result<void> cells(std::span<const std::uint32_t> which, Effort effort, CellNeighbors& out) override;
  Result<void> cells(const CellBatch<double>& batch, CellNeighbors& out) override;
  Result<void> begin(const View& view) override;
  Result<void> draw(std::span<const std::uint32_t> which, Effort effort,
                    std::span<CellStatus> status) override;
  Result<void> draw(const CellBatch<float>& batch, std::span<const DrawMark> marks, Effort effort,
                    std::span<CellStatus> status) override;
  Result<void> drawTriangles(std::span<const DrawMark> corners,
                             std::span<const std::uint32_t> corner_of) override;
  Result<void> read(std::span<std::uint32_t> rgba, std::span<std::uint32_t> ids) override;

  /// Returns the work so far, by stage.
  [[nodiscard]] const Work& work() const { return work_; }

 private:
  template <class Call>
  Result<void> timed(Stage stage, std::uint64_t sent, const Call& call);
  StageWork& at(Stage stage) { return work_[static_cast<std::size_t>(stage)]; }

  Work work_{};
};

/// Forwards every call to the exact tier, and measures how long all of them take.
class TimedExactTier final : public ExactTier {
 public:
  explicit TimedExactTier(ExactTier& timed) : timed_(timed) {}

  void take(const SiteSet& sites) override;
  void cells(std::span<const std::uint32_t> which, Precision precision, CellNeighbors& out) override;
  void nearest(const View& view, std::span<const std::uint32_t> pixels,
               std::span<std::uint32_t> sites) override;

  [[nodiscard]] const StageWork& work() const { return work_; }

 private:
  template <class Call>
  void timed(const Call& call);

  ExactTier& timed_;
  StageWork work_;
};

}  // namespace vorpipe::bench

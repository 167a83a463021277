/// A backend that is given less at a time than it says it takes.
#pragma once

#include <limits>
#include <optional>

#include "backend/forwarding_backend.h"

namespace vorpipe::core {

/// The most that a device is given at a time.
struct Bounds {
  std::uint64_t sites = std::numeric_limits<std::uint64_t>::max();  ///< and bins of their grid
  std::uint64_t lines = std::numeric_limits<std::uint64_t>::max();
  std::uint32_t entries = std::numeric_limits<std::uint32_t>::max();
  int view = std::numeric_limits<int>::max();
};

/// What bounds are never lowered below: a device without memory for that is of no use.
inline constexpr Bounds least_bounds{4096, 4096, 1024, 64};

/// Passes every call on, keeps to bounds, and remembers the call that failed.
class BoundedBackend final : public ForwardingBackend {
 public:
  /// `uploads` counts calls of upload(), if it is not null.
  BoundedBackend(Backend& backend, const Bounds& bounds, std::uint64_t* uploads = nullptr);

  const BackendInfo& info() const override { return info_; }
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

  /// The error of the first call that failed, if one did.
  [[nodiscard]] const std::optional<Error>& failure() const { return failure_; }

  /// After a failure, bounds that have half of what was too much; none where that is the least already.
  [[nodiscard]] std::optional<Bounds> smaller() const;

 private:
  enum class Call : std::uint8_t { upload, clip, picture };

  /// How much the device was given.
  struct Given {
    std::uint64_t sites = 0, bins = 0, lines = 0, entries = 0;
    int view = 0;
  };

  template <class Make>
  Result<void> call(Call kind, const Make& make);

  Bounds bounds_;
  std::uint64_t* uploads_;
  BackendInfo info_;
  Given given_;
  std::optional<Error> failure_;
  Call failed_ = Call::upload;
};

}  // namespace vorpipe::core

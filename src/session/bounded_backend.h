/// A backend that gets less work at a time than it claims to take.
#pragma once

#include <limits>
#include <optional>

#include "backend/forwarding_backend.h"

namespace vorpipe::core {

/// Upper bounds on the work that a device gets at a time.
struct Bounds {
  std::uint64_t sites = std::numeric_limits<std::uint64_t>::max();  ///< and of bins of their grid
  std::uint64_t lines = std::numeric_limits<std::uint64_t>::max();
  std::uint32_t entries = std::numeric_limits<std::uint32_t>::max();
  int view = std::numeric_limits<int>::max();
};

/// Minimum of all bounds: a device without memory for this much is useless.
inline constexpr Bounds least_bounds{4096, 4096, 1024, 64};

/// Forwards every call, keeps it within the bounds, and remembers the call that failed.
class BoundedBackend final : public ForwardingBackend {
 public:
  /// `uploads`, if not null, counts calls of upload().
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

  /// The error of the first failed call, if any.
  [[nodiscard]] const std::optional<Error>& failure() const { return failure_; }

  /// After a failure, returns bounds with half of the amount that was too much; none if that is already
  /// minimal.
  [[nodiscard]] std::optional<Bounds> smaller() const;

 private:
  enum class Call : std::uint8_t { upload, clip, picture };

  /// The amounts last passed to the device.
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

/// The device of a session. If it refuses memory, it continues with less at a time. If the caller left the
/// choice, the next backend takes over after a failure.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "backend/forwarding_backend.h"
#include "backend/registry/registry.h"
#include "base/try.h"

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
  Result<void> cells(std::span<const std::uint32_t> which, Capacity capacity, CellNeighbors& out) override;
  Result<void> cells(const CellBatch<double>& batch, CellNeighbors& out) override;
  Result<void> begin(const View& view) override;
  Result<void> draw(std::span<const std::uint32_t> which, Capacity capacity,
                    std::span<CellStatus> status) override;
  Result<void> draw(const CellBatch<float>& batch, std::span<const DrawMark> marks, Capacity capacity,
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

class DeviceInUse {
 public:
  /// Errors: those of openBackend.
  static Result<DeviceInUse> open(const BackendOptions& options);

  /// Calls work with the backend until it succeeds or nothing is left to try. While the device refuses memory
  /// and a bound can be halved, retries with less at a time. Then, if the backend's name leaves a choice,
  /// retries with the next backend that opens. Each try starts work anew. Made has a `report`, which also
  /// receives the outcome of earlier tries. Errors: those of work; that of the last backend if all of them
  /// failed. An error that work derives from an answer is a device error.
  template <class Made, class Work>
  Result<Made> run(const Work& work) {
    std::vector<std::string> notes, messages;
    for (;;) {
      VORPIPE_TRY(reopen());
      BoundedBackend bounded(*opened_.backend, bounds_, &uploads_);
      Result<Made> made = work(bounded);
      if (made) {
        auto& report = made->report;
        report.notes.insert(report.notes.begin(), notes.begin(), notes.end());
        auto& said = report.validation_messages;
        said.insert(said.begin(), messages.begin(), messages.end());
      }
      if (made || made.error().code != ErrorCode::device) return made;
      for (auto& message : bounded.validationMessages()) messages.push_back(std::move(message));
      if (!fallBack(made.error(), bounded, notes)) return tl::unexpected(withEarlier(made.error(), notes));
    }
  }

  /// Number of uploads and of device openings; a newly opened device holds no data.
  [[nodiscard]] const std::uint64_t& uploads() const { return uploads_; }

  [[nodiscard]] const DeviceInfo& info() const { return info_; }
  [[nodiscard]] const std::string& choice() const { return choice_; }

 private:
  DeviceInUse(BackendOptions options, OpenedBackend opened);

  Result<void> reopen();
  bool fallBack(const Error& failure, const BoundedBackend& failed, std::vector<std::string>& notes);
  void take(OpenedBackend opened);
  static Error withEarlier(Error error, const std::vector<std::string>& notes);

  BackendOptions options_;  ///< with the name of the backend in use
  OpenedBackend opened_;    ///< without a backend after a failure, until it is opened again
  std::vector<std::string> others_;
  Bounds bounds_;
  std::uint64_t uploads_ = 0;
  bool is_less_ = false;  ///< the last note says that bounds_ were lowered
  DeviceInfo info_;
  std::string choice_;
};

}  // namespace vorpipe::core

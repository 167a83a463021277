/// The device of a session. If it refuses memory, it continues with less at a time. If the caller left the
/// choice, the next backend takes over after a failure.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "backend/registry/registry.h"
#include "base/try.h"
#include "session/bounded_backend.h"

namespace vorpipe::core {

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

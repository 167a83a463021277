/// Allows a session only one run at a time.
#pragma once

#include "c/failure.h"
#include "c/handles.h"
#include "c/vorpipe_c.h"
#include "vorpipe.h"

namespace vorpipe::c {

/// Reserves a session for a run. Refuses the run while the session has another, since it would see
/// half-written state. Such a run may come from the caller's progress function or another thread.
class SessionUse {
 public:
  explicit SessionUse(vorpipe_session& session)
      : session_(session), is_refused_(session.is_busy.exchange(true)) {}
  ~SessionUse() {
    if (!is_refused_) session_.is_busy = false;
  }
  SessionUse(const SessionUse&) = delete;
  SessionUse& operator=(const SessionUse&) = delete;

  /// Error (device): the session is busy.
  [[nodiscard]] Result<void> begun() const {
    if (!is_refused_) return {};
    return tl::unexpected(Error{
        ErrorCode::device,
        "session: is busy with another run; what its progress or another thread runs takes one of its own"});
  }

 private:
  vorpipe_session& session_;
  bool is_refused_;
};

/// Runs a function that uses the session and may throw.
template <class Body>
vorpipe_code guardedRun(vorpipe_session& session, const Body& body) noexcept {
  return guarded([&]() -> vorpipe_code {
    const SessionUse use(session);
    if (const auto begun = use.begun(); !begun) return fail(begun.error());
    return body();
  });
}

}  // namespace vorpipe::c

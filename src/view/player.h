/// Plays a script: hands its events to the viewer, one at a time, and waits where it says so.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "view/recorder.h"
#include "view/screen.h"
#include "view/script.h"
#include "view/stage.h"
#include "view/viewer.h"

namespace vorpipe::view {

/// The longest that a script waits for a picture, or for the desktop, in seconds.
inline constexpr double longest_wait = 60;

class Player {
 public:
  /// `recorder` may be null; else it gets a frame after each event, and as many for a time as it lasts.
  Player(Script script, Screen& screen, Viewer& viewer, Stage& stage, Recorder* recorder);

  /// Goes on after a frame was drawn; what it changed is to be drawn before the next call. Errors: it waited
  /// too long (device); those of writing what it asks for.
  Result<void> goOn();

  [[nodiscard]] bool waits() const { return static_cast<bool>(waits_); }
  /// Whether all of it was played.
  [[nodiscard]] bool isOver() const { return !waits_ && next_ == script_.lines.size(); }
  /// Seconds until it continues, where it waits for a time.
  [[nodiscard]] double secondsLeft() const;

 private:
  using Clock = std::chrono::steady_clock;
  /// What is waited for: whether it is there.
  using Condition = std::function<bool()>;

  Result<void> play(const Event& event);
  Result<void> screenshot(const Screenshot& event);
  Result<void> record();
  void waitFor(Condition condition, std::string what);
  void waitForPicture();
  [[nodiscard]] std::string place() const;

  Script script_;
  Screen& screen_;
  Viewer& viewer_;
  Stage& stage_;
  Recorder* recorder_;
  std::size_t next_ = 0;
  Condition waits_{};
  std::string waits_what_{};  ///< as errors call it
  Clock::time_point limit_{}, until_{};
  bool has_time_ = false;          ///< it waits for `until_`
  std::uint64_t frames_left_ = 0;  ///< to record, of a time
  bool records_ = false;           ///< a frame, when the wait is over
};

}  // namespace vorpipe::view

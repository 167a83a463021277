/// Plays a script: passes its events to the viewer, one at a time, and waits where the script says so.
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

/// The longest wait of a script for a picture or for the desktop, in seconds.
inline constexpr double longest_wait = 60;

class Player {
 public:
  /// `recorder` may be null; else it gets a frame after each event, and for a timed wait as many frames as
  /// its duration.
  Player(Script script, Screen& screen, Viewer& viewer, Stage& stage, Recorder* recorder);

  /// Continues after a frame was drawn; draw its changes before the next call. Errors: it waited too long
  /// (device); those of writing the requested files.
  Result<void> goOn();

  [[nodiscard]] bool waits() const { return static_cast<bool>(waits_); }
  /// Whether the whole script was played.
  [[nodiscard]] bool isOver() const { return !waits_ && next_ == script_.lines.size(); }
  /// Seconds until a timed wait ends.
  [[nodiscard]] double secondsLeft() const;

 private:
  using Clock = std::chrono::steady_clock;
  /// Whether a wait is over.
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
  std::string waits_what_{};  ///< its name in errors
  Clock::time_point limit_{}, until_{};
  bool has_time_ = false;          ///< it waits for `until_`
  std::uint64_t frames_left_ = 0;  ///< to record of a timed wait
  bool records_ = false;           ///< whether to record a frame when the wait is over
};

}  // namespace vorpipe::view

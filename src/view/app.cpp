#include "view/app.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "base/stopwatch.h"
#include "base/try.h"
#include "io/base/error.h"
#include "io/base/output_file.h"
#include "io/pictures/png_file.h"
#include "view/compositor.h"
#include "view/recorder.h"

namespace vorpipe::view {
namespace {

/// Seconds between two checks whether a waiting window must stop.
constexpr double look_every = 0.1;

/// Frames drawn after an event: the panel shows some effects only in the second.
constexpr int frames_after_change = 2;

/// The longest wait of a script for a picture or for the desktop, in seconds.
constexpr double longest_wait = 60;

/// Plays a script: passes its events to the viewer, one at a time, and waits where the script says so.
class Player {
 public:
  /// `recorder` may be null; else it gets a frame after each event, and for a timed wait as many frames as
  /// its duration.
  Player(Script script, Screen& screen, Viewer& viewer, Compositor& compositor, Recorder* recorder)
      : script_(std::move(script)),
        screen_(screen),
        viewer_(viewer),
        compositor_(compositor),
        recorder_(recorder) {
    // Playing begins with a picture.
    waitForPicture();
    records_ = recorder_ != nullptr;
  }

  /// Continues after a frame was drawn; draw its changes before the next call. Errors: it waited too long
  /// (device); those of writing the requested files.
  Result<void> advance() {
    if (waits_) {
      if (!waits_()) {
        if (Clock::now() < limit_) return {};
        return deviceError(fmt::format("{}: {} after {} s", position(), waits_what_, longest_wait));
      }
      waits_ = {};
      has_time_ = false;
      if (records_) {
        VORPIPE_TRY(record());
      }
      if (waits_) return {};
    }
    if (next_ == script_.lines.size()) return {};
    return play(script_.lines[next_++].event);
  }

  [[nodiscard]] bool waits() const { return static_cast<bool>(waits_); }
  /// Whether the whole script was played.
  [[nodiscard]] bool isOver() const { return !waits_ && next_ == script_.lines.size(); }

  /// Seconds until a timed wait ends.
  [[nodiscard]] double secondsLeft() const {
    const auto end = has_time_ ? until_ : limit_;
    return std::max(0.0, std::chrono::duration<double>(end - Clock::now()).count());
  }

 private:
  using Clock = std::chrono::steady_clock;
  using Condition = std::function<bool()>;

  Result<void> play(const Event& event) {
    if (const auto* const shot = std::get_if<Screenshot>(&event)) return screenshot(*shot);
    if (const auto* const wait = std::get_if<Wait>(&event)) {
      if (recorder_ != nullptr && wait->seconds > 0) {
        frames_left_ = static_cast<std::uint64_t>(std::max(1.0, std::round(wait->seconds * frame_rate)));
        records_ = true;
        waitForPicture();
      } else if (wait->seconds > 0) {
        const std::chrono::duration<double> seconds(wait->seconds);
        until_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(seconds);
        has_time_ = true;
        waitFor([this] { return Clock::now() >= until_; }, "time stands still");
        limit_ = std::max(limit_, until_ + std::chrono::seconds(1));
      } else {
        waitForPicture();
      }
      return {};
    }
    if (const auto* const size = std::get_if<Resize>(&event)) {
      screen_.apply(event);
      const auto fits = [this, size = *size] {
        return screen_.width() == size.width && screen_.height() == size.height;
      };
      waitFor(fits, fmt::format("the window is not {}x{}", size->width, size->height));
      return {};
    }
    if (std::holds_alternative<Minimize>(event) || std::holds_alternative<Restore>(event)) {
      const bool minimizes = std::holds_alternative<Minimize>(event);
      screen_.apply(event);
      waitFor([this, minimizes] { return (screen_.width() == 0) == minimizes; },
              minimizes ? "the window is not minimized" : "the window is not restored");
      return {};
    }
    if (!compositor_.keeps(event)) viewer_.take(event);
    if (recorder_ != nullptr) {
      waitForPicture();
      records_ = true;
    }
    return {};
  }

  Result<void> screenshot(const Screenshot& event) {
    VORPIPE_VAR(image, compositor_.read(event.panel));
    auto file = OutputFile::create(event.path);
    if (!file) {
      file.error().message = fmt::format("{}: {}", position(), file.error().message);
      return tl::unexpected(std::move(file.error()));
    }
    VORPIPE_TRY(writePng(*file, image.width, image.height, image.rgba));
    return file->commit();
  }

  /// Records a frame of what is shown; for a timed wait, as many frames as it lasts.
  Result<void> record() {
    records_ = false;
    VORPIPE_VAR(image, compositor_.read(/*with_panel=*/true));
    VORPIPE_TRY(recorder_->add(image));
    if (frames_left_ > 0 && --frames_left_ > 0) {
      // Relaxing sites take a step for each frame.
      waitForPicture();
      records_ = true;
    }
    return {};
  }

  void waitFor(Condition condition, std::string what) {
    waits_ = std::move(condition);
    waits_what_ = std::move(what);
    limit_ = Clock::now() +
             std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(longest_wait));
  }

  void waitForPicture() {
    viewer_.request();
    waitFor([this, request = viewer_.requested()] { return viewer_.isSettled(request); },
            "there is no picture yet");
  }

  [[nodiscard]] std::string position() const {
    const std::size_t line = next_ > 0 ? script_.lines[next_ - 1].number : 1;
    return fmt::format("{}:{}", script_.name, line);
  }

  Script script_;
  Screen& screen_;
  Viewer& viewer_;
  Compositor& compositor_;
  Recorder* recorder_;
  std::size_t next_ = 0;
  Condition waits_{};
  std::string waits_what_{};  ///< its name in errors
  Clock::time_point limit_{}, until_{};
  bool has_time_ = false;          ///< it waits for `until_`
  std::uint64_t frames_left_ = 0;  ///< to record of a timed wait
  bool records_ = false;           ///< whether to record a frame when the wait is over
};

class App {
 public:
  App(Screen& screen, AppOptions& options)
      : screen_(screen),
        options_(options),
        viewer_(std::move(options.viewer), screen.width(), screen.height(), [&screen] { screen.wake(); }) {}

  Result<void> begin() {
    if (!options_.record.empty()) {
      VORPIPE_VAR(recorder, openRecorder(options_.record));
      recorder_ = std::move(recorder);
    }
    if (options_.script) {
      player_ = std::make_unique<Player>(std::move(*options_.script), screen_, viewer_, compositor_,
                                         recorder_.get());
    }
    // Lets the first picture be placed beside the panel.
    return compositor_.draw();
  }

  Result<void> loop() {
    while (!is_over_ && !viewer_.closes()) {
      if (options_.is_stopped && options_.is_stopped()) return {};
      takeEvents();
      viewer_.request();
      if (viewer_.takeResults()) to_draw_ = frames_after_change;
      if (const double shows = viewer_.hintShows(); shows != hint_shown_) {
        hint_shown_ = shows;
        to_draw_ = std::max(to_draw_, 1);
      }
      if (viewer_.fault()) return tl::unexpected(*viewer_.fault());
      viewer_.request();
      VORPIPE_TRY(drawFrame());
      if (player_ && !player_->isOver() && isShown()) {
        const bool waited = player_->waits();
        VORPIPE_TRY(player_->advance());
        if (!player_->waits() || !waited) to_draw_ = frames_after_change;
      }
      VORPIPE_TRY(countPictures());
    }
    return {};
  }

  Result<void> finish() {
    if (!recorder_) return {};
    if (!player_) VORPIPE_TRY(recordUpToNow());
    return recorder_->finish();
  }

  AppEnd end() {
    AppEnd end{viewer_.pictures(), viewer_.panelInput({}, 0).computed_by, viewer_.validation()};
    std::ranges::move(screen_.presenter().validationMessages(), std::back_inserter(end.validation));
    return end;
  }

 private:
  void takeEvents() {
    const bool scripted = player_ != nullptr && !player_->isOver();
    double seconds = isIdle() ? look_every : 0;
    if (scripted) seconds = std::min(seconds, player_->secondsLeft());
    const std::vector<Event> events = screen_.events(seconds);
    for (std::size_t i = 0; i < events.size(); ++i) {
      const Event& event = events[i];
      to_draw_ = frames_after_change;
      // Of consecutive moves only the last one counts.
      const bool passed = i + 1 < events.size() && std::holds_alternative<Move>(events[i + 1]);
      if (passed && std::holds_alternative<Move>(event)) continue;
      const bool of_window = std::holds_alternative<Resize>(event) ||
                             std::holds_alternative<Minimize>(event) ||
                             std::holds_alternative<Restore>(event);
      if (of_window) {
        compositor_.forget();
        continue;
      }
      if (std::holds_alternative<Close>(event)) {
        viewer_.take(event);
      } else if (!scripted && !compositor_.keeps(event)) {
        // While a script plays, user input is ignored, so that the script is reproducible.
        viewer_.take(event);
      }
    }
    viewer_.resize(screen_.width(), screen_.height());
  }

  Result<void> drawFrame() {
    if (isIdle()) return {};
    --to_draw_;
    VORPIPE_TRY(compositor_.draw());
    // The panel may have changed something.
    viewer_.request();
    if (recorder_ && !player_) return recordShown();
    return {};
  }

  /// Records the frames due so far, with the picture shown up to now.
  Result<void> recordUpToNow() {
    const auto due = static_cast<std::uint64_t>(watch_.seconds() * frame_rate);
    for (; last_shown_.width > 0 && recorded_ < due; ++recorded_) {
      VORPIPE_TRY(recorder_->add(last_shown_));
    }
    return {};
  }

  /// Records a user's session in real time: each picture fills as many frames as it was shown.
  Result<void> recordShown() {
    if (viewer_.frame() == nullptr || screen_.width() == 0) return {};
    if (last_shown_.width == 0) watch_ = {};
    VORPIPE_TRY(recordUpToNow());
    VORPIPE_VAR(image, compositor_.read(/*with_panel=*/true));
    last_shown_ = std::move(image);
    return {};
  }

  /// Draws again until there were --frames pictures.
  Result<void> countPictures() {
    if (options_.screenshot.empty() || player_ || !isShown() || viewer_.pictures() == counted_) return {};
    counted_ = viewer_.pictures();
    if (counted_ < options_.frames) {
      // Moving sites yield the next picture by themselves.
      if (viewer_.settings().motion != Motion::runs) viewer_.drawAgain();
      viewer_.request();
      return {};
    }
    VORPIPE_VAR(image, compositor_.read(/*with_panel=*/false));
    is_over_ = true;
    return savePng(options_.screenshot, image);
  }

  [[nodiscard]] bool isIdle() const { return to_draw_ == 0; }
  /// Whether everything so far is shown; always true while sites move, which never settles.
  [[nodiscard]] bool isShown() const { return isIdle() || viewer_.settings().motion == Motion::runs; }

  Screen& screen_;
  AppOptions& options_;
  Viewer viewer_;
  Compositor compositor_{screen_, viewer_};
  std::unique_ptr<Recorder> recorder_{};
  std::unique_ptr<Player> player_{};
  int to_draw_ = frames_after_change;
  double hint_shown_ = 1;
  bool is_over_ = false;
  std::uint64_t counted_ = 0;
  Stopwatch watch_{};
  std::uint64_t recorded_ = 0;
  Image last_shown_{};  ///< for recording a user's session
};

}  // namespace

Result<AppEnd> run(Screen& screen, AppOptions options) {
  App app(screen, options);
  VORPIPE_TRY(app.begin());
  VORPIPE_TRY(app.loop());
  VORPIPE_TRY(app.finish());
  return app.end();
}

}  // namespace vorpipe::view

#include "view/app.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>

#include "base/stopwatch.h"
#include "base/try.h"
#include "io/base/output_file.h"
#include "io/pictures/png_file.h"
#include "view/player.h"
#include "view/recorder.h"
#include "view/stage.h"

namespace vorpipe::view {
namespace {

/// Seconds between two checks whether a waiting window must stop.
constexpr double look_every = 0.1;

/// Frames drawn after an event: the panel shows some effects only in the second.
constexpr int frames_after_change = 2;

class App {
 public:
  App(Screen& screen, AppOptions& options)
      : screen_(screen),
        options_(options),
        viewer_(std::move(options.viewer), screen.width(), screen.height(), [&screen] { screen.wake(); }) {}

  Result<void> begin();
  Result<void> runOn();
  Result<void> finish();
  AppEnd end();

 private:
  void takeEvents();
  Result<void> drawFrame();
  Result<void> recordUpToNow();
  Result<void> recordShown();
  Result<void> countPictures();
  [[nodiscard]] bool isIdle() const { return to_draw_ == 0; }
  /// Whether everything so far is shown; always true while sites move, which never settles.
  [[nodiscard]] bool isShown() const { return isIdle() || viewer_.settings().motion == Motion::runs; }

  Screen& screen_;
  AppOptions& options_;
  Viewer viewer_;
  Stage stage_{screen_, viewer_};
  std::unique_ptr<Recorder> recorder_{};
  std::unique_ptr<Player> player_{};
  int to_draw_ = frames_after_change;
  bool is_over_ = false;
  std::uint64_t counted_ = 0;
  Stopwatch watch_{};
  std::uint64_t recorded_ = 0;
  Image last_shown_{};  ///< for recording a user's session
};

Result<void> App::begin() {
  if (!options_.record.empty()) {
    auto recorder = openRecorder(options_.record);
    if (!recorder) return tl::unexpected(std::move(recorder.error()));
    recorder_ = std::move(*recorder);
  }
  if (options_.script) {
    player_ =
        std::make_unique<Player>(std::move(*options_.script), screen_, viewer_, stage_, recorder_.get());
  }
  // Lets the first picture be placed beside the panel.
  return stage_.draw();
}

void App::takeEvents() {
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
    const bool of_window = std::holds_alternative<Resize>(event) || std::holds_alternative<Minimize>(event) ||
                           std::holds_alternative<Restore>(event);
    if (of_window) {
      stage_.forget();
      continue;
    }
    if (std::holds_alternative<Close>(event)) {
      viewer_.take(event);
    } else if (!scripted && !stage_.keeps(event)) {
      // While a script plays, user input is ignored, so that the script is reproducible.
      viewer_.take(event);
    }
  }
  viewer_.resize(screen_.width(), screen_.height());
}

Result<void> App::drawFrame() {
  if (isIdle()) return {};
  --to_draw_;
  VORPIPE_TRY(stage_.draw());
  // The panel may have changed something.
  viewer_.wish();
  if (recorder_ && !player_) return recordShown();
  return {};
}

/// Records the frames due so far, with the picture shown up to now.
Result<void> App::recordUpToNow() {
  const auto due = static_cast<std::uint64_t>(watch_.seconds() * frame_rate);
  for (; last_shown_.width > 0 && recorded_ < due; ++recorded_) {
    VORPIPE_TRY(recorder_->add(last_shown_));
  }
  return {};
}

/// Records a user's session in real time: each picture fills as many frames as it was shown.
Result<void> App::recordShown() {
  if (viewer_.frame() == nullptr || screen_.width() == 0) return {};
  if (last_shown_.width == 0) watch_ = {};
  VORPIPE_TRY(recordUpToNow());
  auto image = stage_.read(/*with_panel=*/true);
  if (!image) return tl::unexpected(std::move(image.error()));
  last_shown_ = std::move(*image);
  return {};
}

/// Draws again until there were --frames pictures.
Result<void> App::countPictures() {
  if (options_.screenshot.empty() || player_ || !isShown() || viewer_.pictures() == counted_) return {};
  counted_ = viewer_.pictures();
  if (counted_ < options_.frames) {
    // Moving sites yield the next picture by themselves.
    if (viewer_.settings().motion != Motion::runs) viewer_.drawAgain();
    viewer_.wish();
    return {};
  }
  auto image = stage_.read(/*with_panel=*/false);
  if (!image) return tl::unexpected(std::move(image.error()));
  auto file = OutputFile::create(options_.screenshot);
  if (!file) return tl::unexpected(std::move(file.error()));
  VORPIPE_TRY(writePng(*file, image->width, image->height, image->rgba));
  is_over_ = true;
  return file->commit();
}

Result<void> App::runOn() {
  while (!is_over_ && !viewer_.closes()) {
    if (options_.is_stopped && options_.is_stopped()) return {};
    takeEvents();
    viewer_.wish();
    if (viewer_.takeAnswers()) to_draw_ = frames_after_change;
    if (viewer_.fault()) return tl::unexpected(*viewer_.fault());
    viewer_.wish();
    VORPIPE_TRY(drawFrame());
    if (player_ && !player_->isOver() && isShown()) {
      const bool waited = player_->waits();
      VORPIPE_TRY(player_->goOn());
      if (!player_->waits() || !waited) to_draw_ = frames_after_change;
    }
    VORPIPE_TRY(countPictures());
  }
  return {};
}

Result<void> App::finish() {
  if (!recorder_) return {};
  if (!player_) {
    VORPIPE_TRY(recordUpToNow());
  }
  return recorder_->finish();
}

AppEnd App::end() {
  AppEnd end{viewer_.pictures(), viewer_.panelInput({}, 0).computed_by, viewer_.validation()};
  std::ranges::move(screen_.presenter().validationMessages(), std::back_inserter(end.validation));
  return end;
}

}  // namespace

Result<AppEnd> run(Screen& screen, AppOptions options) {
  App app(screen, options);
  VORPIPE_TRY(app.begin());
  VORPIPE_TRY(app.runOn());
  VORPIPE_TRY(app.finish());
  return app.end();
}

}  // namespace vorpipe::view

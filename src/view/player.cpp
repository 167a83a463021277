#include "view/player.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/output_file.h"
#include "io/pictures/png_file.h"

namespace vorpipe::view {

Player::Player(Script script, Screen& screen, Viewer& viewer, Stage& stage, Recorder* recorder)
    : script_(std::move(script)), screen_(screen), viewer_(viewer), stage_(stage), recorder_(recorder) {
  // Playing begins with a picture.
  waitForPicture();
  records_ = recorder_ != nullptr;
}

std::string Player::place() const {
  const std::size_t line = next_ > 0 ? script_.lines[next_ - 1].number : 1;
  return fmt::format("{}:{}", script_.name, line);
}

void Player::waitFor(Condition condition, std::string what) {
  waits_ = std::move(condition);
  waits_what_ = std::move(what);
  limit_ =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(longest_wait));
}

void Player::waitForPicture() {
  viewer_.wish();
  waitFor([this, wish = viewer_.wished()] { return viewer_.isSettled(wish); }, "there is no picture yet");
}

double Player::secondsLeft() const {
  const auto end = has_time_ ? until_ : limit_;
  return std::max(0.0, std::chrono::duration<double>(end - Clock::now()).count());
}

Result<void> Player::goOn() {
  if (waits_) {
    if (!waits_()) {
      if (Clock::now() < limit_) return {};
      return deviceError(fmt::format("{}: {} after {} s", place(), waits_what_, longest_wait));
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

/// Records a frame of what is shown; for a timed wait, as many frames as it lasts.
Result<void> Player::record() {
  records_ = false;
  auto image = stage_.read(/*with_panel=*/true);
  if (!image) return tl::unexpected(std::move(image.error()));
  VORPIPE_TRY(recorder_->add(*image));
  if (frames_left_ > 0 && --frames_left_ > 0) {
    // Relaxing sites take a step for each frame.
    waitForPicture();
    records_ = true;
  }
  return {};
}

Result<void> Player::screenshot(const Screenshot& event) {
  auto image = stage_.read(event.panel);
  if (!image) return tl::unexpected(std::move(image.error()));
  auto file = OutputFile::create(event.path);
  if (!file) {
    file.error().message = fmt::format("{}: {}", place(), file.error().message);
    return tl::unexpected(std::move(file.error()));
  }
  VORPIPE_TRY(writePng(*file, image->width, image->height, image->rgba));
  return file->commit();
}

Result<void> Player::play(const Event& event) {
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
  if (!stage_.keeps(event)) viewer_.take(event);
  if (recorder_ != nullptr) {
    waitForPicture();
    records_ = true;
  }
  return {};
}

}  // namespace vorpipe::view

#include "cli/progress.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>

namespace vorpipe::cli {
namespace {

std::atomic<int> caught{0};
static_assert(std::atomic<int>::is_always_lock_free, "the signal handler stores into it");

constexpr int bar_width = 30;
constexpr auto redraw_after = std::chrono::milliseconds(50);

/// What shells add to a signal's number for the exit code of what it ended.
constexpr int killed_by_signal = 128;

void install(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace

void endOnSignals() {
  install([](int signal) {
    constexpr std::string_view line = "vorpipe: interrupted\n";
    const auto written = write(STDERR_FILENO, line.data(), line.size());
    _exit(written < 0 ? killed_by_signal : killed_by_signal + signal);
  });
}

void stopOnSignals() {
  install([](int signal) { caught = signal; });
}

int signalExitCode() { return killed_by_signal + caught; }

Result<void> stopIfAsked() {
  if (caught != 0) return tl::unexpected(Error{ErrorCode::cancelled, "interrupted"});
  return {};
}

ProgressBar::ProgressBar(bool quiet) : shown_(!quiet && isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() { clear(); }

Progress ProgressBar::callback() {
  return [this](std::string_view stage, double fraction) {
    draw(stage, fraction);
    return caught == 0;
  };
}

void ProgressBar::clear() {
  if (!drawn_) return;
  std::fputs("\r\033[K", stderr);
  drawn_ = false;
}

void ProgressBar::draw(std::string_view stage, double fraction) {
  if (!shown_) return;
  auto known = done_.find(stage);
  if (known == done_.end()) known = done_.emplace(stage, 0).first;
  double& done = known->second;
  done = std::max(done, std::clamp(fraction, 0.0, 1.0));
  const auto now = std::chrono::steady_clock::now();
  if (drawn_ && stage == stage_ && now - last_ < redraw_after) return;
  const int full = static_cast<int>(done * bar_width);
  fmt::print(stderr, "\r\033[K{:<16} [{:#<{}}{:.<{}}] {:3.0f} %", stage, "", full, "", bar_width - full,
             done * 100);
  std::fflush(stderr);
  drawn_ = true;
  stage_ = stage;
  last_ = now;
}

}  // namespace vorpipe::cli

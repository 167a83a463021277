/// How a run shows how far it is, and how it is told to stop.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "vorpipe.h"

namespace vorpipe::cli {

/// Added to a signal's number, it is the exit code that shells report for a process that the signal ended.
inline constexpr int killed_by_signal = 128;

/// From now on SIGINT, SIGTERM, SIGHUP and SIGXCPU end the program at once, with a line that says so.
void endOnSignals();

/// From now on, since there is something to clean up, they only ask the run to stop. If it has not soon, or
/// at a second one, the program ends where it is, and leaves no file that is unfinished. Writing into a
/// closed pipe, or beyond what a file may have (ulimit -f), is an error then, and does not end the program.
void stopOnSignals();

/// After stopOnSignals: a run that ends with what it has reached is given the time to write it, until a
/// second signal.
void awaitResultOnSignals();

/// Whether a signal has asked the run to end with what it has reached. From here on the next one counts as
/// the first. signalExitCode() tells of the one that asked.
bool takeSignal();

/// False once a signal has asked to stop.
Progress untilSignal();

/// From now on signals do nothing: the run is over, or its files are being put in place.
void ignoreSignals();

/// The exit code of a run that was asked to stop.
int signalExitCode();

/// ErrorCode::cancelled once a signal has asked to stop.
Result<void> stopIfAsked();

/// Whether there is a bar on standard error. Signal handlers may ask.
bool isBarShown();

/// A bar on standard error. A stage that is left and taken up again continues where it was; within a stage
/// the bar does not go back.
class ProgressBar {
 public:
  /// Shows nothing when quiet or when standard error is no terminal.
  explicit ProgressBar(bool quiet);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// A callback that draws the bar and is false once a signal has asked to stop. It refers to this bar.
  Progress callback();
  /// Draws the bar of a run that is one stage, with a text of its own.
  void show(std::string_view text, double fraction);
  /// Takes the bar off the screen.
  void clear();

 private:
  void draw(std::string_view stage, double fraction);
  void put(std::string_view text, double fraction);

  bool shown_;
  bool drawn_ = false;
  std::string stage_;
  std::map<std::string, double, std::less<>> done_;  ///< by stage
  std::chrono::steady_clock::time_point last_;
};

}  // namespace vorpipe::cli

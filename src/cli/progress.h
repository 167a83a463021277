/// Shows a run's progress, and ends it early: on signals, or when it cannot continue. Then it prints one
/// line, and leaves no unfinished file.
#pragma once

#include <chrono>
#include <exception>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "vorpipe.h"

namespace vorpipe::cli {

/// This plus a signal's number is the exit code that shells report for a process ended by the signal.
inline constexpr int killed_by_signal = 128;

/// From now on, SIGINT, SIGTERM, SIGHUP and SIGXCPU end the program at once, with a message.
void endOnSignals();

/// From now on, these signals only ask the run to stop, because there are files to clean up. If it does not
/// stop soon, or at a second signal, the program ends at once and leaves no unfinished file. Writing into a
/// closed pipe, or beyond the limit of a file (ulimit -f), is now an error and does not end the program.
void stopOnSignals();

/// A run that ends with a partial result gets the time to write it, until a second signal.
void awaitResultOnSignals();

/// Whether a signal has asked the run to end with its partial result. The next signal then counts as the
/// first again. signalExitCode() is that of the signal that asked.
bool takeSignal();

/// Returns a progress callback that is false once a signal has asked to stop.
Progress untilSignal();

/// From now on, signals do nothing: the run is over, or its files are being put in place.
void ignoreSignals();

/// Returns the exit code of a run that was asked to stop.
int signalExitCode();

/// Returns ErrorCode::cancelled once a signal has asked to stop.
Result<void> stopIfAsked();

/// Opens whichever of standard input, output and error is closed, so that no file of a run gets its
/// descriptor. Output to it is then lost or an error, but never lands in a result file.
void openStandardStreams();

/// Prints an uncaught exception, in one line.
void printUncaught(const std::exception& error);

/// From now on, the program ends with this code on an exception that nothing can catch. Causes: a destructor
/// of some libraries gets no memory, or a concurrent thread cannot start another.
void endOnUncaught(int code);

/// From now on, the program ends with this code if a mapped file is truncated while in use, or its disk
/// fails.
void endOnLostPages(int code);

/// From now on, the program ends with this code if a window loses its X server. Xlib by itself would print
/// its own message and exit with 1.
void endOnLostDisplay(int code);

/// A progress bar on standard error. A stage that is left and resumed continues where it was; within a stage
/// the bar never moves back.
class ProgressBar {
 public:
  /// Shows nothing when quiet or when standard error is no terminal.
  explicit ProgressBar(bool quiet);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Returns a callback that draws the bar, and returns false once a signal has asked to stop. It refers to
  /// this bar.
  Progress callback();
  /// Draws the bar of a run with a single stage, with a text of its own.
  void show(std::string_view text, double fraction);
  /// Removes the bar from the screen.
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

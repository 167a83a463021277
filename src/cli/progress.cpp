#include "cli/progress.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/core.h>
#include <signal.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <new>
#include <string>

#include "cli/options/error_line.h"
#include "io/base/output_file.h"

namespace vorpipe::cli {
namespace {

std::atomic<int> caught{0};
std::atomic<int> answered{0};       ///< the signal after which a run ended with a partial result
std::atomic<bool> has_time{false};  ///< a run that was asked to stop may take its time
std::atomic<bool> over{
    false};  ///< a handler is ending the program, or ignoreSignals prevents handlers from doing so
std::atomic<bool> bar_is_shown{false};
bool ignoring = false;  ///< ignoreSignals was called; only one thread calls it
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free,
              "signal handlers use them");

constexpr int bar_width = 30;
constexpr auto redraw_after = std::chrono::milliseconds(50);

/// How long a run may continue after a stop request before the process ends: a call of a driver or file
/// system may take seconds.
constexpr int grace_microseconds = 200'000;

/// Ctrl-C, the signals of a batch system before it ends a job (out of wall time or CPU time), and the loss of
/// the terminal.
constexpr std::array asking_to_end{SIGINT, SIGTERM, SIGXCPU, SIGHUP};

void install(int signal, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = static_cast<int>(SA_RESTART);
  sigaction(signal, &action, nullptr);
}

void installForAll(void (*handler)(int)) {
  for (const int signal : asking_to_end) {
    struct sigaction before {};
    // Under nohup it stays ignored.
    const bool stays =
        signal == SIGHUP && sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_IGN;
    if (!stays) install(signal, handler);
  }
}

/// Removes unfinished files and ends the process. Runs in a signal handler: only async-signal-safe calls.
void endProgram(int signal) {
  if (over.exchange(true)) return;
  removeUnfinished();
  constexpr std::string_view clear = "\r\033[K", line = "vorpipe: interrupted\n";
  bool written = !bar_is_shown || write(STDERR_FILENO, clear.data(), clear.size()) >= 0;
  written = write(STDERR_FILENO, line.data(), line.size()) >= 0 && written;
  _exit(written ? killed_by_signal + signal : killed_by_signal);
}

void askToStop(int signal) {
  int none = 0;
  if (!caught.compare_exchange_strong(none, signal)) return endProgram(signal);
  // The system sends it again each second, until the second limit of `ulimit -t`.
  if (signal == SIGXCPU) install(SIGXCPU, SIG_IGN);
  if (has_time) return;
  const itimerval grace{{0, 0}, {0, grace_microseconds}};
  setitimer(ITIMER_REAL, &grace, nullptr);
}

/// Writes a line, on a new line if there is a bar. For signal handlers. Returns whether it was written.
bool writeLine(std::string_view line) {
  constexpr std::string_view line_end = "\n";
  const bool ended = !bar_is_shown || write(STDERR_FILENO, line_end.data(), line_end.size()) >= 0;
  return write(STDERR_FILENO, line.data(), line.size()) >= 0 && ended;
}

}  // namespace

void endOnSignals() { installForAll(endProgram); }

void stopOnSignals() {
  install(SIGALRM, [](int) { endProgram(caught); });
  installForAll(askToStop);
  // With these ignored, writing fails with an error that says where, and unfinished files are removed.
  install(SIGPIPE, SIG_IGN);
  install(SIGXFSZ, SIG_IGN);
}

void awaitResultOnSignals() { has_time = true; }

bool takeSignal() {
  has_time = false;
  const int signal = caught.exchange(0);
  if (signal != 0) answered = signal;
  return signal != 0;
}

Progress untilSignal() {
  return [](std::string_view, double) { return caught == 0; };
}

void ignoreSignals() {
  if (over.exchange(true) && !ignoring) {
    // A handler on another thread is ending the process.
    for (;;) pause();
  }
  ignoring = true;
}

int signalExitCode() { return killed_by_signal + (caught != 0 ? caught : answered); }

Result<void> stopIfAsked() {
  if (caught != 0) return tl::unexpected(Error{ErrorCode::cancelled, "interrupted"});
  return {};
}

void openStandardStreams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) != -1) continue;
    // open() takes the lowest free descriptor, which is this one. Writing to standard output stays an error.
    if (open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY) != stream) return;
  }
}

void printUncaught(const std::exception& error) {
  const std::string_view what = error.what();
  // oneTBB's wording.
  if (what.find("pthread_create") == std::string_view::npos) return printError(what);
  printError(fmt::format("a thread could not be started ({}); fewer --threads would do", what));
}

void endOnUncaught(int code) {
  static int exit_code;
  static std::terminate_handler before;
  exit_code = code;
  before = std::set_terminate([] {
    const std::exception_ptr thrown = std::current_exception();
    if (!thrown) before();
    removeUnfinished();
    try {
      std::rethrow_exception(thrown);
    } catch (const std::bad_alloc&) {
      printOutOfMemory();
    } catch (const std::exception& error) {
      printUncaught(error);
    } catch (...) {
      before();
    }
    _exit(exit_code);
  });
}

void endOnLostPages(int code) {
  static int exit_code;
  exit_code = code;
  struct sigaction action {};
  action.sa_sigaction = [](int signal, siginfo_t* info, void*) {
    static std::atomic_flag ending;
    // Anything else is a bug of the program, which ends as soon as this returns.
    if (info->si_code != BUS_ADRERR) {
      struct sigaction usual {};
      usual.sa_handler = SIG_DFL;
      sigaction(signal, &usual, nullptr);
      return;
    }
    // Several threads may read missing pages at once. The first one writes the line and ends the process; the
    // others sleep until then.
    while (ending.test_and_set()) pause();
    removeUnfinished();
    const bool written = writeLine(
        "vorpipe: --sites: a part of the file is gone: it was cut off meanwhile, or its disk fails\n");
    _exit(written ? exit_code : killed_by_signal + SIGBUS);
  };
  action.sa_flags = SA_SIGINFO;
  sigaction(SIGBUS, &action, nullptr);
}

void endOnLostDisplay(int code) {
  static int exit_code;
  exit_code = code;
  using Handler = int (*)(void* display);
  // Opened like GLFW does, and never closed; without this library there is no X window.
  void* const library = dlopen("libX11.so.6", RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) return;
  const auto set = reinterpret_cast<Handler (*)(Handler)>(dlsym(library, "XSetIOErrorHandler"));
  if (set == nullptr) return;
  set([](void*) -> int {
    removeUnfinished();
    printError("the display is gone: its server has closed the connection");
    _exit(exit_code);
  });
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
  drawn_ = bar_is_shown = false;
}

void ProgressBar::draw(std::string_view stage, double fraction) {
  if (!shown_) return;
  auto known = done_.find(stage);
  if (known == done_.end()) known = done_.emplace(stage, 0).first;
  double& done = known->second;
  done = std::max(done, std::clamp(fraction, 0.0, 1.0));
  const auto now = std::chrono::steady_clock::now();
  if (drawn_ && stage == stage_ && now - last_ < redraw_after) return;
  put(stage, done);
  stage_ = stage;
}

void ProgressBar::show(std::string_view text, double fraction) {
  if (shown_) put(text, std::clamp(fraction, 0.0, 1.0));
}

void ProgressBar::put(std::string_view text, double fraction) {
  const int full = static_cast<int>(fraction * bar_width);
  // The terminal may be gone, which must not end the run: fmt::print would throw.
  std::fputs(fmt::format("\r\033[K{:<16} [{:#<{}}{:.<{}}] {:3.0f} %", text, "", full, "", bar_width - full,
                         fraction * 100)
                 .c_str(),
             stderr);
  std::fflush(stderr);
  drawn_ = bar_is_shown = true;
  last_ = std::chrono::steady_clock::now();
}

}  // namespace vorpipe::cli

#include "cli/abrupt_end.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/core.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <new>
#include <string_view>

#include "cli/options/error_line.h"
#include "cli/progress.h"
#include "io/base/output_file.h"

namespace vorpipe::cli {
namespace {

/// Writes a line, on a new line if there is a bar. For signal handlers. Returns whether it was written.
bool writeLine(std::string_view line) {
  constexpr std::string_view line_end = "\n";
  const bool ended = !isBarShown() || write(STDERR_FILENO, line_end.data(), line_end.size()) >= 0;
  return write(STDERR_FILENO, line.data(), line.size()) >= 0 && ended;
}

}  // namespace

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

}  // namespace vorpipe::cli

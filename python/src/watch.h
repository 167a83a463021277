/// Runs of C++ that Python waits for.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "errors.h"
#include "runs.h"
#include "vorpipe.h"

namespace vorpipe::python {

namespace py = pybind11;

/// What a run on a thread of its own, and the thread of Python that waits for it, tell each other.
class Watch {
 public:
  /// For the run: notes how far it is. Returns false once nobody waits any more, or Python ends.
  bool note(std::string_view stage, double fraction);
  [[nodiscard]] bool isStopped() const { return stopped_ || isEndingWithout(waiter_); }
  /// For the run: it is over.
  void finish();

  /// For the thread that waits, with the GIL, which others have meanwhile. Hears Ctrl-C within 20 ms, and
  /// calls `function` with what was noted, unless it is None. Throws what a signal's handler or the function
  /// raises. Then, and where the function returns False, the run is stopped, which ends it as soon as it
  /// looks up.
  void wait(const py::object& function);

 private:
  struct Noted {
    std::string stage;
    double fraction;
  };
  bool isOver(std::vector<Noted>& noted);
  static bool tell(const py::object& function, const std::vector<Noted>& noted);

  const std::thread::id waiter_ = std::this_thread::get_id();
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Noted> noted_;  ///< one for each stage since they were told
  bool over_ = false;
  std::atomic<bool> stopped_{false};
};

/// Whether what a function of the caller's returned says stop: False, Python's or NumPy's.
bool saysStop(const py::object& answer);

/// The result of `run`, which is called on a thread of its own and owns all that it uses: where Ctrl-C or the
/// caller's function end the waiting, it goes on until it looks up. What `run` throws is a
/// DeviceError. The GIL is held.
template <class T>
Result<T> watched(const py::object& function, std::function<Result<T>(Watch&)> run) {
  struct Shared {
    Watch watch;
    std::optional<Result<T>> result;
    std::exception_ptr raised;
  };
  auto shared = std::make_shared<Shared>();
  startRun([shared, run = std::move(run)] {
    try {
      shared->result = run(shared->watch);
    } catch (...) {
      shared->raised = std::current_exception();
    }
    shared->watch.finish();
  });
  shared->watch.wait(function);
  if (shared->raised) raise(shared->raised);
  if (shared->watch.isStopped()) {
    return tl::unexpected(Error{ErrorCode::cancelled, "the progress function said stop"});
  }
  return std::move(*shared->result);
}

/// The Progress of such a run.
inline Progress progressOf(Watch& watch) {
  return [&watch](std::string_view stage, double fraction) { return watch.note(stage, fraction); };
}

}  // namespace vorpipe::python

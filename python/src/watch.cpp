#include "watch.h"

#include <chrono>
#include <thread>

namespace vorpipe::python {
namespace {

struct Runs {
  std::mutex mutex;
  std::condition_variable ended;
  int count = 0;
};

/// Never destroyed: a thread may outlive everything else.
Runs& runs() {
  static auto* const all = new Runs;
  return *all;
}

}  // namespace

bool Watch::note(std::string_view stage, double fraction) {
  const std::lock_guard lock(mutex_);
  if (noted_.empty() || noted_.back().stage != stage) noted_.push_back({std::string(stage), fraction});
  noted_.back().fraction = fraction;
  return !stopped_;
}

void Watch::finish() {
  const std::lock_guard lock(mutex_);
  over_ = true;
  changed_.notify_all();
}

bool Watch::isOver(std::vector<Noted>& noted) {
  constexpr auto pause = std::chrono::milliseconds(20);
  const py::gil_scoped_release no_gil;
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, pause, [this] { return over_; });
  noted = std::exchange(noted_, {});
  return over_;
}

bool Watch::tell(const py::object& function, const std::vector<Noted>& noted) {
  if (function.is_none()) return true;
  for (const auto& [stage, fraction] : noted) {
    if (function(stage, fraction).is(py::bool_(false))) return false;
  }
  return true;
}

void Watch::wait(const py::object& function) {
  try {
    std::vector<Noted> noted;
    for (bool is_over = false; !is_over;) {
      is_over = isOver(noted);
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (!stopped_ && !tell(function, noted)) stopped_ = true;
    }
  } catch (...) {
    stopped_ = true;
    throw;
  }
}

void startRun(std::function<void()> run) {
  const auto count = [](int change) {
    const std::lock_guard lock(runs().mutex);
    runs().count += change;
    runs().ended.notify_all();
  };
  count(1);
  try {
    std::thread([run = std::move(run), count]() mutable {
      run();
      run = nullptr;  // what it owns goes before it counts as ended
      count(-1);
    }).detach();
  } catch (...) {
    count(-1);
    throw;
  }
}

void waitForRuns() {
  const py::gil_scoped_release no_gil;
  std::unique_lock lock(runs().mutex);
  runs().ended.wait(lock, [] { return runs().count == 0; });
}

}  // namespace vorpipe::python

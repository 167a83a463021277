#include "runs.h"

#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "errors.h"

namespace vorpipe::python {
namespace {

struct Runs {
  std::mutex mutex;
  std::condition_variable changed;
  int count = 0;
  int returning = 0;                        ///< threads that wait for the GIL
  std::optional<std::thread::id> ended_by;  ///< the thread that ends Python
};

/// Never destroyed: a thread may outlive everything else.
Runs* all_runs = new Runs;

/// Runs are waited for, so that theirs may come back to Python.
thread_local bool is_run = false;

void add(int Runs::*number, int change) {
  Runs& runs = *all_runs;
  const std::lock_guard lock(runs.mutex);
  runs.*number += change;
  runs.changed.notify_all();
}

}  // namespace

WithoutGil::~WithoutGil() {
  {
    Runs& runs = *all_runs;
    std::unique_lock lock(runs.mutex);
    const bool may_return = !runs.ended_by || *runs.ended_by == std::this_thread::get_id() || is_run;
    runs.changed.wait(lock, [&] { return may_return; });
    ++runs.returning;
  }
  PyEval_RestoreThread(state_);
  add(&Runs::returning, -1);
}

void startRun(std::function<void()> run) {
  add(&Runs::count, 1);
  try {
    std::thread([run = std::move(run)]() mutable {
      is_run = true;
      run();
      run = nullptr;  // what it owns goes before it counts as ended
      add(&Runs::count, -1);
    }).detach();
  } catch (const std::system_error& error) {
    add(&Runs::count, -1);
    raise({ErrorCode::device, std::string("there is no thread for this: ") + error.what()});
  } catch (...) {
    add(&Runs::count, -1);
    throw;
  }
}

bool isEndingWithout(std::thread::id thread) {
  Runs& runs = *all_runs;
  const std::lock_guard lock(runs.mutex);
  return runs.ended_by && *runs.ended_by != thread;
}

void endRuns() {
  const WithoutGil no_gil;
  Runs& runs = *all_runs;
  std::unique_lock lock(runs.mutex);
  runs.ended_by = std::this_thread::get_id();
  runs.changed.wait(lock, [&] { return runs.count == 0 && runs.returning == 0; });
}

void forgetRuns() { all_runs = new Runs; }

}  // namespace vorpipe::python

#include "watch.h"

#include <chrono>

namespace vorpipe::python {

bool Watch::note(std::string_view stage, double fraction) {
  const std::lock_guard lock(mutex_);
  if (noted_.empty() || noted_.back().stage != stage) noted_.push_back({std::string(stage), fraction});
  noted_.back().fraction = fraction;
  return !isStopped();
}

void Watch::finish() {
  const std::lock_guard lock(mutex_);
  over_ = true;
  changed_.notify_all();
}

bool Watch::isOver(std::vector<Noted>& noted) {
  constexpr auto pause = std::chrono::milliseconds(20);
  const WithoutGil no_gil;
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, pause, [this] { return over_; });
  noted = std::exchange(noted_, {});
  return over_;
}

bool Watch::tell(const py::object& function, const std::vector<Noted>& noted) {
  if (function.is_none()) return true;
  for (const auto& [stage, fraction] : noted) {
    if (saysStop(function(stage, fraction))) return false;
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

bool saysStop(const py::object& answer) {
  if (answer.is(py::bool_(false))) return true;
  return py::isinstance(answer, py::module_::import("numpy").attr("bool_")) && !answer.cast<bool>();
}

}  // namespace vorpipe::python

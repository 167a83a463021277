#include "progress.h"

#include <utility>

namespace vorpipe::python {

Progress HeardProgress::callback() {
  return [this](std::string_view stage, double fraction) {
    constexpr auto pause = std::chrono::milliseconds(20);
    const auto now = std::chrono::steady_clock::now();
    // A caller who counts stages sees each of them.
    const bool is_new = stage != stage_ && !function_.is_none();
    if (now - asked_ < pause && !is_new) return true;
    asked_ = now;
    stage_ = stage;
    return ask(stage, fraction);
  };
}

bool HeardProgress::ask(std::string_view stage, double fraction) {
  const py::gil_scoped_acquire gil;
  try {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (function_.is_none()) return true;
    const py::object answer = function_(stage, fraction);
    return !answer.is(py::bool_(false));
  } catch (py::error_already_set& error) {
    raised_.emplace(std::move(error));
    return false;
  }
}

void HeardProgress::rethrow() {
  if (!raised_) return;
  py::error_already_set raised = std::move(*raised_);
  raised_.reset();
  throw raised;
}

}  // namespace vorpipe::python

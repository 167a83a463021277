/// What Python is told, and asked, while a run goes on without the GIL.
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

#include "vorpipe.h"

namespace vorpipe::python {

namespace py = pybind11;

/// Hears Ctrl-C and calls the caller's own function, each at most every 20 ms: taking the GIL from a thread
/// that is busy takes 5 ms. Constructed and destroyed with the GIL.
class HeardProgress {
 public:
  /// `function` is None, or takes a stage's name and the part done, and returns False to stop.
  explicit HeardProgress(py::object function) : function_(std::move(function)) {}

  /// For a run on this thread, which does not hold the GIL; *this must outlive it.
  Progress callback();

  /// Throws what a signal's handler, or the caller's function, has raised. The GIL is held.
  void rethrow();

 private:
  bool ask(std::string_view stage, double fraction);

  py::object function_;
  std::optional<py::error_already_set> raised_;
  std::string stage_;
  std::chrono::steady_clock::time_point asked_{};
};

}  // namespace vorpipe::python

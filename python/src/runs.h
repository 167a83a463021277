/// Threads of C++ beside those of Python, until Python ends.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <thread>

namespace vorpipe::python {

/// Gives the GIL away, and takes it back at the end. Once Python ends, a thread that is not the one that ends
/// it never comes back: Python would end it amid of C++, which ends the program.
class WithoutGil {
 public:
  WithoutGil() : state_(PyEval_SaveThread()) {}
  ~WithoutGil();
  WithoutGil(const WithoutGil&) = delete;
  WithoutGil& operator=(const WithoutGil&) = delete;

 private:
  PyThreadState* state_;
};

/// Starts `run`, which must not throw, on a thread of its own. Throws DeviceError if there is none to have.
/// The GIL is held.
void startRun(std::function<void()> run);

/// Whether Python ends, by another thread than this one: its runs are to stop.
bool isEndingWithout(std::thread::id thread);

/// Python ends, by the thread that calls this with the GIL: stops what others run and waits for it, so that
/// the program does not end below them. What it runs itself from now on is not stopped.
void endRuns();

/// In a process that was forked there are no threads of the parent's.
void forgetRuns();

}  // namespace vorpipe::python

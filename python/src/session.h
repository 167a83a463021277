/// A session that any thread may use.
#pragma once

#include <pybind11/pybind11.h>
#include <unistd.h>

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "progress.h"
#include "results.h"
#include "vorpipe.h"

namespace vorpipe::python {

/// One run at a time: other threads wait for theirs, and hear Ctrl-C while they do.
class SharedSession {
 public:
  explicit SharedSession(const BackendOptions& options);
  ~SharedSession();
  SharedSession(const SharedSession&) = delete;
  SharedSession& operator=(const SharedSession&) = delete;

  std::shared_ptr<CellsResult> cells(const std::shared_ptr<const Input>& input, const std::string& detail,
                                     const std::string& search, int neighbors, py::object progress);
  std::shared_ptr<PictureResult> render(const std::shared_ptr<const Input>& input, RenderOptions options,
                                        py::object progress);
  Arithmetic arithmetic();
  DeviceInfo device();
  std::string choice();

  /// Gives the device back once the run in progress is over; does nothing the second time.
  void close();
  [[nodiscard]] bool isClosed() const { return closed_; }

 private:
  /// Calls `work` with the session, alone and without the GIL.
  template <class Work>
  auto use(Work work) -> decltype(work(std::declval<Session&>()));
  void lock();

  std::timed_mutex mutex_;
  std::atomic<std::thread::id> user_{};
  std::unique_ptr<Session> session_;
  std::atomic<bool> closed_{false};
  pid_t process_ = getpid();
};

void defineSession(py::module_& module);

}  // namespace vorpipe::python

/// A session that any thread may use.
#pragma once

#include <pybind11/pybind11.h>
#include <unistd.h>

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "look.h"
#include "results.h"
#include "vorpipe.h"
#include "watch.h"

namespace vorpipe::python {

/// One run at a time: other threads wait for theirs, and hear Ctrl-C while they do.
class SharedSession : public std::enable_shared_from_this<SharedSession> {
 public:
  explicit SharedSession(const BackendOptions& options);
  ~SharedSession();
  SharedSession(const SharedSession&) = delete;
  SharedSession& operator=(const SharedSession&) = delete;

  std::shared_ptr<CellsResult> cells(const std::shared_ptr<const Input>& input, const std::string& detail,
                                     const std::string& search, int neighbors, const py::object& progress);
  std::shared_ptr<PictureResult> render(const std::shared_ptr<const Input>& input, const Look& look,
                                        const py::object& progress);
  /// The cells that a file of shapes is drawn from, as saveShapes does. Throws InputError if `path` names no
  /// such file.
  std::shared_ptr<CellsResult> shapes(const std::shared_ptr<const Input>& input, const Look& look,
                                      const std::string& path, const py::object& progress);
  std::shared_ptr<RelaxResult> relax(const std::shared_ptr<const Input>& input, const RelaxArguments& given,
                                     const py::object& progress);
  /// `callback` is called with each step, before the next one; returning False ends the transport with what
  /// was reached. What it raises is thrown.
  std::shared_ptr<TransportResult> transport(const std::shared_ptr<const Input>& input,
                                             const TransportArguments& given, const py::object& callback,
                                             const py::object& progress);
  /// Work of others with the session, alone, on a thread of its own. Throws what it returns for an error.
  void run(const py::object& progress, std::function<Result<void>(Session&, const Progress&)> work);
  Arithmetic arithmetic();
  DeviceInfo device();
  std::string choice();

  /// Gives the device back once the run in progress is over; does nothing the second time.
  void close();
  [[nodiscard]] bool isClosed() const { return closed_; }

 private:
  struct StepFunction;
  std::shared_ptr<CellsResult> find(const std::shared_ptr<const Input>& input, CellsOptions options,
                                    const py::object& progress);
  /// The result of `work` with the session, alone, on a thread of its own.
  template <class T>
  T use(const py::object& progress, std::function<Result<T>(Session&, const Progress&)> work);
  void refuseOtherUse() const;

  std::mutex mutex_;
  std::unique_ptr<Session> session_;
  int threads_;  ///< 0 for all
  std::atomic<bool> closed_{false};
  pid_t process_ = getpid();
};

void defineSession(py::module_& module);

}  // namespace vorpipe::python

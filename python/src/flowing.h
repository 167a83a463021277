/// A fluid of a session.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "session.h"
#include "vorpipe/fluid.h"

namespace vorpipe::python {

/// What is known of a fluid after a step. It stays as it is: arrays show it.
struct FluidNow {
  FluidState state;
  FluidOptions options;
  FluidStep last;
  FluidEnd end;
  Report report;
};

/// A fluid that any thread may use. A step whose progress was stopped has not been, and the next one begins
/// where it did.
class FluidRun : public std::enable_shared_from_this<FluidRun> {
 public:
  static std::shared_ptr<FluidRun> begin(const std::shared_ptr<SharedSession>& session, FluidSetup setup,
                                         const py::object& progress);

  /// Whether a step was made.
  bool step(const py::object& progress);
  /// Sets the time to end at, and lets a fluid that has ended go on.
  void goOn(double until, const py::object& progress);
  /// Adds to velocities, as many as there are sites.
  void push(std::vector<Point> velocities);

  [[nodiscard]] std::shared_ptr<const FluidNow> now() const;

 private:
  FluidRun(std::shared_ptr<SharedSession> session, double begin)
      : session_(std::move(session)), begin_(begin) {}
  /// For the thread of a run: shows what the fluid has come to.
  void publish();
  bool isTold(double part) const { return heard_ == nullptr || (*heard_)("fluid", part); }

  std::shared_ptr<SharedSession> session_;
  double begin_;  ///< time
  std::optional<Fluid> fluid_;
  const Progress* heard_ = nullptr;  ///< of the run in progress
  double done_ = 0;
  mutable std::mutex mutex_;  ///< of what follows
  std::shared_ptr<const FluidNow> now_;
};

/// Fluids.
void defineFlowing(py::module_& module);

}  // namespace vorpipe::python

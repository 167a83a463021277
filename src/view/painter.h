/// What the render thread does: it opens backends, moves sites and fluids, draws and saves.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "view/frames.h"
#include "vorpipe.h"

namespace vorpipe::view {

/// A backend with the sites that it draws repeatedly.
class Renderer {
 public:
  /// Opens a backend in place of the present one; calls `end` before, to release what uses the present one.
  /// Returns false if this backend is open already. If the new one does not work here, returns its error and
  /// the present one stays. `not_cpu` names a backend to prefer, if it works, where `backend` resolves to
  /// `cpu`; empty: none.
  Result<bool> open(const BackendOptions& backend, const std::string& not_cpu = {},
                    const std::function<void()>& end = {});

  void close();

  /// Call after open(). A domain without sites is white.
  Result<Rendering> render(const FixedSites& sites, const RenderOptions& options);

  [[nodiscard]] Session& session() { return *session_; }
  [[nodiscard]] int threads() const { return backend_.threads; }
  [[nodiscard]] bool isOpen() const { return session_ != nullptr; }
  /// The sites drawn last; null before any were drawn.
  [[nodiscard]] KeptSites* kept() { return kept_ ? &*kept_ : nullptr; }
  [[nodiscard]] const FixedSites& keptOf() const { return kept_of_; }

 private:
  BackendOptions backend_{};
  std::string not_cpu_{};             ///< as tried last
  std::unique_ptr<Session> session_;  ///< outlives the members below
  std::optional<KeptSites> kept_;
  FixedSites kept_of_{};
};

/// A running fluid.
class FluidRun {
 public:
  /// Begins, stirs and steps the fluid as the request asks, and stores its state in the frame.
  /// Errors: those of Fluid::begin and Fluid::step; cancelled if `progress` stops it.
  /// Makes further steps for `seconds`.
  Result<void> go(Session& session, const FrameRequest& request, const Progress& progress, double seconds,
                  Frame& frame);

  /// Call before the session ends.
  void reset() { fluid_.reset(); }
  /// The report of the last diagram, or null.
  [[nodiscard]] const Report* report() const { return fluid_ ? &fluid_->report() : nullptr; }

 private:
  [[nodiscard]] bool isAt(const FrameRequest& request) const;
  Result<void> begin(Session& session, const FixedFluid& from, const Progress& progress);
  Result<void> stir(const FrameRequest& request);
  Result<void> step(Frame& frame);
  void take(FixedSites sites, std::uint64_t stirred);

  std::optional<Fluid> fluid_{};
  FluidSetup setup_{};   ///< of the fluid; its state is not used
  FixedFluid now_{};     ///< its present state
  FixedFluid before_{};  ///< its state one request earlier
  std::uint64_t gesture_ = 0;
};

/// Whether the work in progress is no longer wanted.
using Outdated = std::function<bool()>;

/// Executes frame requests, one at a time; owns the session.
class Painter {
 public:
  /// Returns a picture or an error; the error is cancelled if the request became outdated. If the request
  /// names another backend, opens that first; if it does not work here, the present one stays.
  RenderResult paint(const FrameRequest& request, const Outdated& outdated);

  /// Returns the measures of the cells of the sites painted last. Null if there are no sites, if they were
  /// measured already, or if outdated. Ignores errors: paint() reports them.
  std::shared_ptr<const Measures> measure(const Outdated& outdated);

  /// Writes a picture in the format of the path's extension.
  Result<void> save(const Save& save);

 private:
  Result<void> open(const FrameRequest& request, RenderResult& result);
  [[nodiscard]] bool isAt(const FrameRequest& request) const;
  Result<void> begin(const FrameRequest& request);
  Result<void> step(const FrameRequest& request, Frame& frame);
  Result<void> draw(const FrameRequest& request, Frame& frame, RenderResult& result);
  [[nodiscard]] Progress progress() const;

  /// How long further steps of a request may take, in seconds.
  [[nodiscard]] double stepSeconds(const FrameRequest& request) const;

  Outdated outdated_{};
  double drawn_in_ = 0;      ///< seconds that the last picture took, without its steps
  Renderer main_;            ///< outlives the members below
  Renderer compared_;        ///< the other backend, while two are compared
  RenderOptions painted_{};  ///< the last picture
  FixedSites measured_{};
  FixedFluid drawn_fluid_{};
  FluidRun fluid_{};
  std::optional<Relaxation> relaxation_;
  FixedSites relaxed_{};         ///< sites after its last step
  FixedSites relaxed_before_{};  ///< sites one step earlier
  std::uint64_t relaxed_gesture_ = 0;
  RelaxMethod method_ = RelaxMethod::lloyd;
  std::shared_ptr<const Density> density_{};
};

}  // namespace vorpipe::view

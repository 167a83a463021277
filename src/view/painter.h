/// The render thread: executes frame requests, one at a time; owns the session.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "view/fluid_run.h"
#include "view/renderer.h"
#include "view/wish.h"
#include "vorpipe.h"

namespace vorpipe::view {

/// Whether the work in progress is no longer wanted.
using Outdated = std::function<bool()>;

class Painter {
 public:
  /// Returns a picture or an error; the error is cancelled if the wish became outdated. If the wish names
  /// another backend, opens that first; if it does not work here, the present one stays.
  Answer paint(const Wish& wish, const Outdated& outdated);

  /// Returns the measures of the cells of the sites painted last. Null if there are no sites, if they were
  /// measured already, or if outdated. Ignores errors: paint() reports them.
  std::shared_ptr<const Measures> measure(const Outdated& outdated);

  /// Writes a picture in the format of the path's extension.
  Result<void> save(const Save& save);

 private:
  Result<void> open(const Wish& wish, Answer& answer);
  [[nodiscard]] bool isAt(const Wish& wish) const;
  Result<void> begin(const Wish& wish);
  Result<void> step(const Wish& wish, Frame& frame);
  Result<void> draw(const Wish& wish, Frame& frame, Answer& answer);
  [[nodiscard]] Progress progress() const;

  Outdated outdated_{};
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

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

/// Whether what is being done is not wanted any more.
using Outdated = std::function<bool()>;

class Painter {
 public:
  /// A picture, or an error; of what is outdated, an error that is cancelled. Where the wish names another
  /// backend, that is opened first; if it does not work here, the one before stays.
  Answer paint(const Wish& wish, const Outdated& outdated);

  /// What is told of cells, of the sites that were painted last; none where there are no sites, it is known
  /// already, or it was outdated. An error is not told: painting tells it.
  std::shared_ptr<const Measures> measure(const Outdated& outdated);

  /// Writes a picture by the extension of its path.
  Result<void> save(const Save& save);

 private:
  Result<void> open(const Wish& wish, Answer& answer);
  [[nodiscard]] bool isAt(const Wish& wish) const;
  Result<void> begin(const Wish& wish);
  Result<void> step(const Wish& wish, Frame& frame);
  Result<void> draw(const Wish& wish, Frame& frame, Answer& answer);
  [[nodiscard]] Progress progress() const;

  Outdated outdated_{};
  Renderer main_;            ///< outlives what follows
  Renderer compared_;        ///< the other one, while two are compared
  RenderOptions painted_{};  ///< the last picture
  FixedSites measured_{};
  FixedFluid drawn_fluid_{};
  FluidRun fluid_{};
  std::optional<Relaxation> relaxation_;
  FixedSites relaxed_{};         ///< where it has moved the sites
  FixedSites relaxed_before_{};  ///< a step earlier
  std::uint64_t relaxed_gesture_ = 0;
  RelaxMethod method_ = RelaxMethod::lloyd;
  std::shared_ptr<const Density> density_{};
};

}  // namespace vorpipe::view

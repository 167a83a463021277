/// A running fluid, on the thread that draws its pictures.
#pragma once

#include <cstdint>
#include <optional>

#include "view/wish.h"
#include "vorpipe.h"

namespace vorpipe::view {

class FluidRun {
 public:
  /// Begins, stirs and steps the fluid as the wish asks, and stores its state in the frame.
  /// Errors: those of Fluid::begin and Fluid::step; cancelled if `progress` stops it.
  Result<void> go(Session& session, const Wish& wish, const Progress& progress, Frame& frame);

  /// Call before the session ends.
  void reset() { fluid_.reset(); }
  /// The report of the last diagram, or null.
  [[nodiscard]] const Report* report() const { return fluid_ ? &fluid_->report() : nullptr; }

 private:
  [[nodiscard]] bool isAt(const Wish& wish) const;
  Result<void> begin(Session& session, const FixedFluid& from, const Progress& progress);
  Result<void> stir(const Wish& wish);
  Result<void> step(Frame& frame);
  void take(FixedSites sites, std::uint64_t stirred);

  std::optional<Fluid> fluid_{};
  FluidSetup setup_{};   ///< of the fluid; its state is not used
  FixedFluid now_{};     ///< its present state
  FixedFluid before_{};  ///< its state one wish earlier
  std::uint64_t gesture_ = 0;
};

}  // namespace vorpipe::view

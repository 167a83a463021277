/// A fluid on its way, on the thread that draws its pictures.
#pragma once

#include <cstdint>
#include <optional>

#include "view/wish.h"
#include "vorpipe.h"

namespace vorpipe::view {

class FluidRun {
 public:
  /// Begins, stirs and moves the fluid of a wish as that asks for; the frame gets its state.
  /// Errors: those of Fluid::begin and Fluid::step; of what `progress` gives up, an error that is cancelled.
  Result<void> go(Session& session, const Wish& wish, const Progress& progress, Frame& frame);

  /// Before the session ends.
  void reset() { fluid_.reset(); }
  /// Of the last diagram, if there was one.
  [[nodiscard]] const Report* report() const { return fluid_ ? &fluid_->report() : nullptr; }

 private:
  [[nodiscard]] bool isAt(const Wish& wish) const;
  Result<void> begin(Session& session, const FixedFluid& from, const Progress& progress);
  Result<void> stir(const Wish& wish);
  Result<void> step(Frame& frame);
  void take(FixedSites sites, std::uint64_t stirred);

  std::optional<Fluid> fluid_{};
  FluidSetup setup_{};   ///< of the fluid; its state is not read
  FixedFluid now_{};     ///< its present state
  FixedFluid before_{};  ///< a wish earlier
  std::uint64_t gesture_ = 0;
};

}  // namespace vorpipe::view

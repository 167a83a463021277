/// Which cell on the globe has a place.
#pragma once

#include <cstdint>
#include <memory>

#include "vorpipe/outline.h"
#include "vorpipe/result.h"
#include "vorpipe/sites.h"

namespace vorpipe::core {

/// Finds the site whose cell has a place. Thread safe.
class GlobePlaces {
 public:
  /// Sites and an outline as Session::cells takes them with CellsOptions::globe. Errors (input): those of the
  /// outline.
  static Result<GlobePlaces> make(const Sites& sites, const Outline& outline);
  GlobePlaces(GlobePlaces&&) noexcept;
  ~GlobePlaces();

  /// The first, in the input, of the sites that are nearest up to rounding; no_site if it is no place, or
  /// outside of the outline.
  [[nodiscard]] std::uint32_t at(Point degrees) const;

 private:
  GlobePlaces();
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vorpipe::core

/// Which cell on the globe has a place.
#pragma once

#include <cstdint>
#include <memory>

#include "vorpipe/sites.h"

namespace vorpipe::core {

/// Finds the site whose cell has a place. Thread safe.
class GlobePlaces {
 public:
  /// Sites as Session::cells takes them with CellsOptions::globe.
  explicit GlobePlaces(const Sites& sites);
  ~GlobePlaces();

  /// The first, in the input, of the sites that are nearest up to rounding; no_site if it is no place.
  [[nodiscard]] std::uint32_t at(Point degrees) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vorpipe::core

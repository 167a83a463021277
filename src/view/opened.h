/// Sites as they were opened, with the domain that they have cells in.
#pragma once

#include <string>
#include <vector>

#include "view/flowing.h"
#include "vorpipe/sites.h"

namespace vorpipe::view {

struct Opened {
  Sites sites{};
  Box domain{0, 0, 1, 1};
  Outline outline{};
  Periodic periodic = Periodic::none;
  /// The options of a command line that name these sites and their domain; none where they came out of
  /// nothing.
  std::vector<std::string> arguments{};
  FixedFluid fluid{};        ///< as it begins, of which these are the sites; null: they are no fluid's
  std::string fluid_name{};  ///< a case, or a file
};

/// A fluid in its domain.
Opened openedFluid(FixedFluid fluid, std::string name);

}  // namespace vorpipe::view

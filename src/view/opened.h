/// Sites as they were opened, with their domain.
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
  /// The command-line options that name these sites and their domain; empty if nothing names them.
  std::vector<std::string> arguments{};
  FixedFluid fluid{};        ///< the initial state of the fluid that has these sites; null: no fluid
  std::string fluid_name{};  ///< name of a case or file
};

/// A fluid in its domain.
Opened openedFluid(FixedFluid fluid, std::string name);

}  // namespace vorpipe::view

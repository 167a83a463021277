/// The options of a density.
#pragma once

#include <optional>
#include <string>

#include "cli/options/command_line.h"
#include "vorpipe.h"

namespace vorpipe::cli {

struct DensityOptions {
  std::string file;        ///< empty: none
  std::optional<Box> box;  ///< the box of its pixels

  [[nodiscard]] bool empty() const { return file.empty(); }
};

/// --density, --density-box; `purpose` says what the density is for.
void addDensityOptions(Options& options, DensityOptions& density, const std::string& purpose);

}  // namespace vorpipe::cli

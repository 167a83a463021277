/// What `transport` prescribes: masses, and what lies around the cells.
#pragma once

#include <optional>
#include <string>

#include "cli/options/command_line.h"
#include "vorpipe.h"

namespace vorpipe::cli {

struct MassOptions {
  std::string file, attribute;  ///< both empty: masses are equal
  bool normalize = false;
  Surface surface = Surface::none;
  std::optional<double> fill;  ///< part of the domain's mass that the cells have together

  [[nodiscard]] bool areEqual() const { return file.empty() && attribute.empty(); }
  [[nodiscard]] Surface around() const { return fill ? Surface::free : surface; }
};

/// --masses, --normalize, --surface, --fill
void addMassOptions(Options& options, MassOptions& masses);

/// Refuses options that contradict each other (input).
Result<void> checkMasses(const MassOptions& masses);

}  // namespace vorpipe::cli

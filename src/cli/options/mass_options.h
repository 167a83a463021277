/// The options of `transport`: masses, and the surface of the cells.
#pragma once

#include <optional>
#include <string>

#include "cli/options/command_line.h"
#include "vorpipe.h"

namespace vorpipe::cli {

struct MassOptions {
  std::string file, attribute;  ///< both empty: masses are equal
  bool normalize = false;
  bool skip_zero = false;  ///< sites without mass are left out
  Surface surface = Surface::none;
  std::optional<double> fill;  ///< fraction of the domain's mass in all cells together

  [[nodiscard]] bool areEqual() const { return file.empty() && attribute.empty(); }
  [[nodiscard]] Surface around() const { return fill ? Surface::free : surface; }
};

/// Description of --surface, for sites that already have weights.
inline constexpr const char* surface_text =
    "the cells end in air: each is cut by a disc around its site, whose squared radius is the weight, as "
    "transport --fill finds it [cells fill the domain]";

/// --surface free, described by `text`
void addSurface(Options& options, Surface& surface, const std::string& text);

/// --masses, --skip-zero, --normalize, --surface, --fill
void addMassOptions(Options& options, MassOptions& masses);

/// Error (input): the options contradict each other.
Result<void> checkMasses(const MassOptions& masses);

}  // namespace vorpipe::cli

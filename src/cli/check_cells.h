/// What `cells --check` verifies on a run.
#pragma once

#include <string>

#include "cli/input.h"
#include "vorpipe.h"

namespace vorpipe::cli {

/// Verifies the promises about cells: they tile the domain (areas, vertices, edges and faces counted),
/// each is a convex polygon whose edges lie where its neighbors say, neighbors name each other with the
/// same edge, duplicates own nothing, and pseudo-random places in cells have no nearer site.
/// Returns the first broken promise in one line, or an empty text.
std::string checkCells(const Input& input, const Diagram& diagram);

}  // namespace vorpipe::cli

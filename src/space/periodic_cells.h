/// The cells of sites that repeat.
#pragma once

#include <span>

#include "vorpipe/result.h"
#include "vorpipe/space.h"

namespace vorpipe::space {

/// The diagram of sites that repeat along axes of the domain, or by a lattice. Input is valid. It is that of
/// a box with all images in a band around the period, taken again with a wider band until no image beyond can
/// cut a cell. Errors: as boxCells() and withImages().
Result<Diagram3> periodicCells(std::span<const Point3> sites, const Cells3Options& options, int threads);

}  // namespace vorpipe::space

/// The surroundings of the cells of an input: nothing, or air.
#pragma once

#include "c/handles.h"
#include "c/vorpipe_c.h"
#include "vorpipe.h"

namespace vorpipe::c {

/// Returns the cells of sites with that surface. With a free surface they have the detail `polygons`, and
/// `options` is changed to it. Errors: those of Session::cells and freeCells.
Result<Diagram> cellsWith(Surface surface, Session& session, const Sites& sites, CellsOptions& options);

/// Returns the array of a field from VORPIPE_BORDER_OFFSETS on; it is found once, and the diagram keeps it.
/// Empty if cells fill the domain. Error (input): there is no such field.
Result<vorpipe_array> borderArrayOf(const vorpipe_diagram& diagram, vorpipe_diagram_field field);

/// Removes found sites whose discs do not reach the places that they were found for.
void leaveOutAir(const Sites& sites, const Point* places, std::uint64_t count, std::uint32_t* found);

}  // namespace vorpipe::c

/// What lies around the cells of an input: nothing, or air.
#pragma once

#include "c/handles.h"
#include "c/vorpipe_c.h"
#include "vorpipe.h"

namespace vorpipe::c {

/// The cells of sites with that surface. Of a free one they have the detail `polygons`, which the options
/// then say. Errors: those of Session::cells and freeCells.
Result<Diagram> cellsWith(Surface surface, Session& session, const Sites& sites, CellsOptions& options);

/// The array of a field from VORPIPE_BORDER_OFFSETS on; found once, the diagram keeps it. Empty where cells
/// fill the domain. Error (input): there is no such field.
Result<vorpipe_array> borderArrayOf(const vorpipe_diagram& diagram, vorpipe_diagram_field field);

/// Takes away sites whose discs do not reach the places that they were found for.
void leaveOutAir(const Sites& sites, const Point* places, std::uint64_t count, std::uint32_t* found);

}  // namespace vorpipe::c

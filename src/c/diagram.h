/// Cells of sites with or without a free surface, and what they share.
#pragma once

#include "c/handles.h"
#include "c/vorpipe_c.h"
#include "vorpipe.h"

namespace vorpipe::c {

/// Returns the cells of sites with that surface. With a free surface they have the detail `polygons`, and
/// `options` is changed to it. Errors: those of Session::cells and freeCells.
Result<Diagram> cellsWith(Surface surface, Session& session, const Sites& sites, CellsOptions& options);

/// Returns the topology, found once by the first thread that requests it; the diagram keeps it. Errors: those
/// of topologyOf.
const Result<Topology>& sharedPartsOf(const vorpipe_diagram& diagram);

}  // namespace vorpipe::c

/// Shared vertices and edges of the cells of a diagram.
#pragma once

#include "c/handles.h"

namespace vorpipe::c {

/// Returns the topology, found once by the first thread that requests it; the diagram keeps it. Errors: those
/// of topologyOf.
const Result<Topology>& sharedPartsOf(const vorpipe_diagram& diagram);

}  // namespace vorpipe::c

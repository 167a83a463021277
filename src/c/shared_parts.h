/// What cells of a diagram share.
#pragma once

#include "c/handles.h"

namespace vorpipe::c {

/// Found once, by whichever thread asks first; the diagram keeps it. Errors: those of topologyOf.
const Result<Topology>& sharedPartsOf(const vorpipe_diagram& diagram);

}  // namespace vorpipe::c

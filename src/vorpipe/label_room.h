/// Names that a picture has no room for.
#pragma once

#include <string>

#include "vorpipe/shapes.h"

namespace vorpipe {

/// Returns a note on how many cells that show have a name without a label; empty if none has. `labels` are
/// those of siteLabels().
std::string noteOnRoom(const Diagram& cells, const RenderOptions& options, const SiteLabels& labels);

}  // namespace vorpipe

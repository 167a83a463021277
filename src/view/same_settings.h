/// Tests whether settings give the same picture.
#pragma once

#include "view/settings.h"

namespace vorpipe::view {

/// Whether both draw the same picture of the same sites and view, by the same backend. Ignores the panel,
/// motion and the settings of relaxation.
bool drawTheSame(const Settings& a, const Settings& b);

}  // namespace vorpipe::view

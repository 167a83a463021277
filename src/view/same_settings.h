/// Whether settings make the same picture.
#pragma once

#include "view/settings.h"

namespace vorpipe::view {

/// Of the same sites and view, by the same backend. The panel, motion and what relaxing takes are not
/// compared.
bool drawTheSame(const Settings& a, const Settings& b);

}  // namespace vorpipe::view

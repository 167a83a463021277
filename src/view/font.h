/// The texture of the panel's letters.
#pragma once

#include "view/window/presenter.h"

namespace vorpipe::view {

/// Draws the letters at a scale into the texture of Dear ImGui's context, and returns it.
PanelTexture drawFont(double scale);

}  // namespace vorpipe::view

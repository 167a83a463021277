/// The texture of the panel's font.
#pragma once

#include "view/window/presenter.h"

namespace vorpipe::view {

/// Draws the font at a scale into the texture of Dear ImGui's context, and returns it.
PanelTexture drawFont(double scale);

}  // namespace vorpipe::view

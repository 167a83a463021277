/// What Dear ImGui has drawn, as the window's triangles.
#pragma once

#include "view/window/presenter.h"

namespace vorpipe::view {

/// Those of the last frame of Dear ImGui's context, in a window of width x height pixels.
void takeTriangles(int width, int height, PanelTriangles& triangles);

}  // namespace vorpipe::view

/// Converts Dear ImGui's output to the window's triangles.
#pragma once

#include "view/window/presenter.h"

namespace vorpipe::view {

/// Takes the triangles of the last frame of Dear ImGui's context, for a window of width x height pixels.
void takeTriangles(int width, int height, PanelTriangles& triangles);

}  // namespace vorpipe::view

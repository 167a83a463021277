/// The signs of predicates.h without a filter, and places by integers.
#pragma once

#include <array>

#include "space/label.h"

namespace vorpipe::space {

int exactOrientation(const Places& places, Label i, const std::array<Label, 3>& other);

/// 1 if the last of `other` does not cut the vertex of i and the first three, -1 if it does; ties are broken.
int exactSide(const Places& places, Label i, const std::array<Label, 4>& other);

/// The vertex of i and three, relative to i, each coordinate to 2^-52 of itself. There must be one.
Point3 exactPlace(const Places& places, Label i, const std::array<Label, 3>& other);

}  // namespace vorpipe::space

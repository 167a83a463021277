/// The signs of predicates.h without a filter.
#pragma once

#include <array>

#include "space/label.h"

namespace vorpipe::space {

int exactOrientation(const Places& places, Label i, const std::array<Label, 3>& other);

/// 1 if the last of `other` does not cut the vertex of i and the first three, -1 if it does; ties are broken.
int exactSide(const Places& places, Label i, const std::array<Label, 4>& other);

}  // namespace vorpipe::space

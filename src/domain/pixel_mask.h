/// Pictures of a domain with an outline.
#pragma once

#include "domain/rings.h"

namespace vorpipe::core {

/// Gives pixels whose centers lie outside no_site and color 0. Exact; a center on an edge is decided as
/// sideOf says. The rings are scaled by 2^exponent, the domain is not.
void maskOutside(const Rings& rings, const Box& domain, int exponent, int threads, Image& image);

}  // namespace vorpipe::core

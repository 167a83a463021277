/// Pictures of a domain with an outline.
#pragma once

#include "domain/rings.h"

namespace vorpipe::core {

/// Sets pixels whose centers lie outside to no_site and color 0. Exact; a center on an edge is decided as in
/// sideOf. The rings are scaled by 2^exponent, the domain is not.
void maskOutside(const Rings& rings, const Box& domain, int exponent, int threads, Image& image);

}  // namespace vorpipe::core

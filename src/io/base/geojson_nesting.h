/// How deep GeoJSON may nest.
#pragma once

namespace vorpipe {

/// Nesting depth of GeometryCollections, which the standard advises against (RFC 7946, 3.1.8).
inline constexpr int most_nested_collections = 32;

}  // namespace vorpipe

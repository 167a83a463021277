/// How deep GeoJSON may stand in itself.
#pragma once

namespace vorpipe {

/// GeometryCollections in each other, of which the standard says that they should not (RFC 7946, 3.1.8).
inline constexpr int most_nested_collections = 32;

}  // namespace vorpipe

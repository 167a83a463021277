/// Sites that are too near to each other.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "backend/backend.h"

namespace vorpipe::core {

/// In scaled units. For sites farther apart, products of distances are in the range of double, and the
/// judge's numbers have enough digits for the points where their bisectors meet.
inline constexpr double least_distance = 0x1p-80;

/// Returns two sites, as indices in the set, that differ by less than `least_distance` in x and in y. May
/// miss such pairs, but none that differ by less than half of it in y.
std::optional<std::pair<std::uint32_t, std::uint32_t>> tooNear(const SiteSet& set, int threads);

}  // namespace vorpipe::core

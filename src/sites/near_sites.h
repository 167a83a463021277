/// Sites that are too near to each other.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "backend/backend.h"

namespace vorpipe::core {

/// In scaled units. Products of the distances of farther sites are in the range of double, and the judge's
/// numbers have digits enough for where their bisectors meet.
inline constexpr double least_distance = 0x1p-80;

/// Two sites, as indices in the set, that differ by less than `least_distance` in x and in y. There may be
/// such that it does not find, but none that differ by less than half of it in y.
std::optional<std::pair<std::uint32_t, std::uint32_t>> tooNear(const SiteSet& set, int threads);

}  // namespace vorpipe::core

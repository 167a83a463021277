/// Differences in words and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "vorpipe.h"

namespace vorpipe::cli {

/// Describes a place: "row 3, column 4: sites 7 and 9, 1.25 px from their bisector".
std::string placeText(const IdDifference& place);

/// Describes a disagreement in one line: the count and the first place.
std::string disagreementText(const IdDiff& diff);

nlohmann::ordered_json diffJson(const IdDiff& diff);

}  // namespace vorpipe::cli

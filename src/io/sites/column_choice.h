/// Columns as --columns names them.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vorpipe.h"

namespace vorpipe {

/// Returns the number, from 1, that a text is; none if it is a name.
std::optional<std::size_t> columnNumber(std::string_view text);

/// Returns the unnamed columns of x, y and possibly weights, from 0. Errors (input), beginning with `name`:
/// they are not two or three different numbers from 1 to `count`.
Result<std::vector<std::size_t>> numberedColumns(std::span<const std::string> columns, std::size_t count,
                                                 std::string_view name);

/// The note about three unnamed columns.
inline constexpr std::string_view third_is_weight =
    "the third column is taken as weights; --columns 1,2 leaves it out";

}  // namespace vorpipe

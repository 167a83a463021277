/// Suggestions for unknown words.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace vorpipe::cli {

/// Returns the word of `known` most likely meant by `typed`, ignoring case. It differs in at most two letters
/// (added, omitted, changed, or two swapped), or is the shortest word that begins with `typed`. Empty if
/// there is none.
std::string closestTo(std::string_view typed, std::span<const std::string> known);

/// "; did you mean WORD?", or nothing.
std::string didYouMean(std::string_view typed, std::span<const std::string> known);

}  // namespace vorpipe::cli

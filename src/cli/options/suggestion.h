/// What somebody may have meant who typed a word that is not known.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace vorpipe::cli {

/// The word of `known` that is likeliest meant by `typed`: in any case of letters, at most two letters from
/// it (added, left out, changed, or two exchanged), or the shortest that it begins. Empty where none is.
std::string closestTo(std::string_view typed, std::span<const std::string> known);

/// "; did you mean WORD?", or nothing.
std::string didYouMean(std::string_view typed, std::span<const std::string> known);

}  // namespace vorpipe::cli

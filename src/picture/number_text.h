/// Numbers as texts in pictures.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace vorpipe::core {

/// Formats a finite number with `digits` significant digits, fewer if the last are 0, more if it is an
/// integer of up to six digits: 0.012, 1.2e-5, 350.
std::string numberText(double number, int digits);

/// Formats ascending numbers with three significant digits each, or as many more as distinguish different
/// numbers, unless one would then exceed `longest` characters.
std::vector<std::string> numberTexts(std::span<const double> numbers, std::size_t longest);

}  // namespace vorpipe::core

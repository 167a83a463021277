/// Numbers as people write them in pictures.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace vorpipe::core {

/// A finite number with `digits` significant digits, fewer where the last are 0, more where it is an integer
/// of up to six: 0.012, 1.2e-5, 350.
std::string numberText(double number, int digits);

/// Numbers that ascend, each with three significant digits, or as many more as it takes to tell different
/// ones apart, unless one then has more than `longest` characters.
std::vector<std::string> numberTexts(std::span<const double> numbers, std::size_t longest);

}  // namespace vorpipe::core

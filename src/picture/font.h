/// The font for texts in pictures, which drawText() draws too.
#pragma once

#include <string_view>

#include "vorpipe.h"

namespace vorpipe::core {

/// Height of a capital letter and of a digit in units; the pen is one unit wide.
inline constexpr int letter_units = 7;

/// Returns the width of a text in units. It supports ASCII and the letters of languages of Latin script up to
/// U+017F, with what pixelsHaveLetters() says; others are as wide as a space.
int unitsOf(std::string_view text);

/// Draws a text of any height, smoothed. `at` is the start of its baseline. `halo`: by how many units the
/// strokes are wider on every side.
void drawTextAt(std::string_view text, Point at, double height, std::uint32_t color, Image& image,
                double halo = 0);

}  // namespace vorpipe::core

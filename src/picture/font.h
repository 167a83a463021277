/// The letters that are drawn into pictures.
#pragma once

#include <string_view>

#include "vorpipe.h"

namespace vorpipe::core {

/// How many units high a capital letter and a digit are; the pen is one unit wide.
inline constexpr int letter_units = 7;

/// How many units wide a text is. Characters are those of ASCII that legends need, digits, letters and
/// .,:-+=/_%() among them; others are as wide as a space.
int unitsOf(std::string_view text);

/// Draws a text in opaque black, smoothed. Its height is rounded to whole pixels a unit, at least one: then
/// upright and level strokes have sharp edges.
void drawText(const LegendText& text, Image& image);

/// Draws a text of any height, from the place where its baseline begins, smoothed.
void drawTextAt(std::string_view text, Point at, double height, std::uint32_t color, Image& image);

}  // namespace vorpipe::core

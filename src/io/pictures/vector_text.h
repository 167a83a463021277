/// Shapes as text, in the ways that SVG and PDF have in common.
#pragma once

#include <string>

#include "io/base/print.h"
#include "vorpipe.h"

namespace vorpipe {

/// Appends a length in pixels to the nearest 1e-4, in as few characters as that takes.
void printPixels(Bytes& bytes, double pixels);

/// Appends x and y, with a space between them.
void printPoint(Bytes& bytes, Point point);

/// The size of a font like Helvetica, for capital letters of a height.
double fontSize(double capital_height);

/// How wide a text of printable ASCII is in Helvetica, in the unit of the font's size.
double textWidth(const std::string& text, double font_size);

}  // namespace vorpipe

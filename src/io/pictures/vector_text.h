/// Prints shapes as text, in the forms common to SVG and PDF.
#pragma once

#include <string>

#include "io/base/print.h"
#include "vorpipe.h"

namespace vorpipe {

/// Appends a length in pixels to the nearest 1e-4, in as few characters as possible.
void printPixels(Bytes& bytes, double pixels);

/// Appends x and y, with a space between them.
void printPoint(Bytes& bytes, Point point);

/// Returns the size of a font like Helvetica whose capital letters have the given height.
double fontSize(double capital_height);

/// Returns the width of printable ASCII text in Helvetica, in the unit of the font size.
double textWidth(const std::string& text, double font_size);

}  // namespace vorpipe

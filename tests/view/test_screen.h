/// What an X server shows, by a file that it keeps it in: code that is not ours put it there.
#pragma once

#include "vorpipe/picture.h"

namespace vorpipe::view::test {

/// The part of the screen from its top left; opaque, as Image::rgba. A size of 0 where the file cannot be
/// read.
Image screenPart(int width, int height);

}  // namespace vorpipe::view::test

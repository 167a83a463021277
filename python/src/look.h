/// How a picture is to look.
#pragma once

#include <optional>

#include "input.h"
#include "vorpipe.h"

namespace vorpipe::python {

struct Look {
  std::optional<PictureSize> size;  ///< none: by the longer side
  int longer_side;                  ///< 0: the usual one
  std::optional<Fit> fit;           ///< none: the usual one of sites that were read; arrays fill pictures
  RenderOptions options{};          ///< but what follows from the input
};

/// The options of a picture of the input.
RenderOptions renderOptionsOf(const Look& look, const Input& input);

}  // namespace vorpipe::python

/// How a picture is to look.
#pragma once

#include <optional>
#include <string>

#include "input.h"
#include "io/sites/photograph_file.h"
#include "vorpipe.h"

namespace vorpipe::python {

struct Look {
  std::optional<PictureSize> size;  ///< none: by the longer side
  int longer_side;                  ///< 0: the usual one
  std::optional<GlobeMap> map{};    ///< none: the usual one, or none
  std::optional<Fit> fit;           ///< none: the usual one of sites that were read; arrays fill pictures
  RenderOptions options{};          ///< but what follows from the input
  std::string color_file{};         ///< of the photograph; empty: none
  PhotographFile photograph{};
  std::string color, labels;  ///< the input's attributes that colors and labels show; empty: none
  SharedAttributes own{};     ///< in place of these, called "color" and "labels"; may be null
};

/// The options of a picture of the input.
RenderOptions renderOptionsOf(const Look& look, const Input& input);

/// Gives the picture the colors of a photograph, if there is one. Errors: its place is wrong for the input;
/// those of photographColors.
Result<void> takeColors(const Look& look, const Input& input, int threads, RenderOptions& options);

}  // namespace vorpipe::python

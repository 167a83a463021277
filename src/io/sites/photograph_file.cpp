#include "io/sites/photograph_file.h"

#include <utility>

#include "base/try.h"
#include "io/base/extension.h"
#include "io/pictures/jpeg_file.h"
#include "io/pictures/png_file.h"
#include "io/sites/density_file.h"
#include "io/sites/density_place.h"

namespace vorpipe {

bool isPhotograph(std::string_view path) {
  const std::string extension = lowerExtension(std::string(path));
  return extension == ".png" || extension == ".jpg" || extension == ".jpeg";
}

Result<PhotographFile> readPhotograph(const std::string& path, const std::optional<Box>& box) {
  VORPIPE_VAR(image, lowerExtension(path) == ".png" ? readPng(path) : readJpeg(path));
  DensityFile place{{image.width, image.height, {}, box}, {}};
  if (!box) {
    VORPIPE_TRY(findPlace(path, place));
  }
  return PhotographFile{{image.width, image.height, std::move(image.rgba), place.density.box},
                        std::move(place.system)};
}

Result<void> placePhotograph(const PhotographFile& file, const std::string& path, PlacedSites& placed,
                             DomainWords words, std::string_view option, std::string_view box_option) {
  words.density = option;
  words.density_box = box_option;
  words.beyond = "cells beyond are white";
  const Photograph& photograph = file.photograph;
  return placeDensity({{photograph.width, photograph.height, {}, photograph.box}, file.system}, path, placed,
                      words);
}

}  // namespace vorpipe

/// Writes pictures, and the sites of their pixels, as a file of any known kind.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/byte_sink.h"
#include "io/base/coordinate_system.h"
#include "vorpipe.h"

namespace vorpipe {

/// Input for writing a picture.
struct PictureOutput {
  const Sites& sites;
  const RenderOptions& options;
  const Image* image = nullptr;      ///< for formats of pixels
  const Diagram* diagram = nullptr;  ///< the cells with Detail::polygons, for formats of shapes
  CoordinateSystem system{};         ///< of the sites
  int threads = 0;                   ///< 0 for all
  std::optional<ColorKey> key{};     ///< what the colors of pixels mean
};

/// A kind of file for pictures.
struct PictureFormat {
  std::string_view extension;
  bool of_shapes;  ///< consists of cells; otherwise of pixels
  /// The same picture gives the same bytes. Errors: those of siteColors and wrapped() (input), for shapes;
  /// writing failed or memory ran out (device).
  Result<void> (*write)(ByteSink& sink, const PictureOutput& output);
};

/// The extensions of all kinds, in the order in which messages name them.
std::vector<std::string_view> pictureExtensions();

/// The format that the path's extension names; never null. Error (input): it names none.
Result<const PictureFormat*> pictureFormatOf(const std::string& path);

/// A kind of file for the sites of pixels, Image::ids.
struct IdsFormat {
  std::string_view extension;
  bool compressed;  ///< in memory, before it is written
  /// Writes the ids of an image. Errors (device): writing failed or memory ran out.
  Result<void> (*write)(ByteSink& sink, const PictureOutput& output);
};

std::vector<std::string_view> idsExtensions();
Result<const IdsFormat*> idsFormatOf(const std::string& path);

}  // namespace vorpipe

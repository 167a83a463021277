#include "io/pictures/picture_file.h"

#include <array>
#include <cassert>
#include <span>

#include "io/base/extension.h"
#include "io/pictures/georeference.h"
#include "io/pictures/npy_ids.h"
#include "io/pictures/png_file.h"
#include "io/pictures/vector_picture.h"
#include "vorpipe.h"
#include "vorpipe/legend.h"

namespace vorpipe {
namespace {

PixelGrid gridOf(const RenderOptions& options) { return pixelGridOf(shownBox(options), shownFrame(options)); }

Result<void> asPng(ByteSink& sink, const PictureOutput& output) {
  assert(output.image != nullptr);
  const Sheet sheet = sheetOf(output.options, output.key);
  if (!sheet.legend.boxes.empty()) {
    const Image whole = onSheet(*output.image, sheet);
    return writePng(sink, whole.width, whole.height, whole.rgba, paperOf(output.options, sheet));
  }
  return writePng(sink, output.image->width, output.image->height, output.image->rgba, output.options.paper);
}

Result<void> asWorldFile(ByteSink& sink, const PictureOutput& output) {
  // The pixels of the .png, which begin with what stands around the picture.
  PixelGrid grid = gridOf(output.options);
  const Sheet sheet = sheetOf(output.options, output.key);
  grid.left -= sheet.left * grid.width;
  grid.top += sheet.top * grid.height;
  return writeWorldFile(sink, grid);
}

Result<void> asSvg(ByteSink& sink, const PictureOutput& output) {
  assert(output.diagram != nullptr);
  return writeSvgPicture(sink, output.sites, *output.diagram, output.options, output.threads);
}

Result<void> asPdf(ByteSink& sink, const PictureOutput& output) {
  assert(output.diagram != nullptr);
  return writePdfPicture(sink, output.sites, *output.diagram, output.options, output.threads);
}

Result<void> asNpy(ByteSink& sink, const PictureOutput& output) {
  assert(output.image != nullptr);
  return writeNpyIds(sink, output.image->width, output.image->height, output.image->ids);
}

Result<void> asTiff(ByteSink& sink, const PictureOutput& output) {
  assert(output.image != nullptr);
  constexpr std::int64_t equal_earth = 8857;  // of EPSG
  const bool of_map = output.options.globe && output.options.map == GlobeMap::equal_earth;
  return writeTiffIds(
      sink, output.image->width, output.image->height, output.image->ids,
      {gridOf(output.options), of_map ? systemOfCode(equal_earth) : output.system, output.threads});
}

constexpr PictureFormat png{".png", /*of_shapes=*/false, asPng}, svg{".svg", /*of_shapes=*/true, asSvg},
    pdf{".pdf", /*of_shapes=*/true, asPdf}, world{".pgw", /*of_shapes=*/false, asWorldFile};
constexpr std::array picture_formats{&png, &svg, &pdf, &world};
constexpr std::span<const PictureFormat* const> all_pictures(picture_formats);

constexpr IdsFormat npy{".npy", /*compressed=*/false, asNpy}, tif{".tif", /*compressed=*/true, asTiff},
    tiff{".tiff", /*compressed=*/true, asTiff};
constexpr std::array ids_formats{&npy, &tif, &tiff};
constexpr std::span<const IdsFormat* const> all_ids(ids_formats);

}  // namespace

std::vector<std::string_view> pictureExtensions() { return extensionsOf(all_pictures); }

Result<const PictureFormat*> pictureFormatOf(const std::string& path) {
  return formatFor(path, "pictures", all_pictures);
}

std::vector<std::string_view> idsExtensions() { return extensionsOf(all_ids); }

Result<const IdsFormat*> idsFormatOf(const std::string& path) { return formatFor(path, "ids", all_ids); }

}  // namespace vorpipe

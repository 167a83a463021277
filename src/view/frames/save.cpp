#include "io/files/extension.h"
#include "io/files/output_file.h"
#include "io/pictures/picture_file.h"
#include "view/document/command.h"
#include "view/frames/painter.h"

namespace vorpipe::view {

Result<void> Painter::save(const Save& save) {
  if (lowerExtension(save.path) == ".csv") return writeSites(save.path, *save.sites);
  const auto format = pictureFormatOf(save.path);
  if (!format) return tl::unexpected(format.error());
  PictureOutput output{*save.sites, save.picture};
  output.threads = main_.threads();
  std::optional<Diagram> cells;
  if ((*format)->of_shapes) {
    if (!main_.isOpen())
      return tl::unexpected(Error{ErrorCode::device, save.path + ": nothing computes yet"});
    CellsOptions options = cellsOptions(save.picture);
    options.detail = Detail::polygons;
    auto found = main_.session().cells(*save.sites, options);
    if (!found) return tl::unexpected(std::move(found.error()));
    cells = std::move(*found);
    output.diagram = &*cells;
  } else {
    output.image = &save.rendering->image;
  }
  auto file = OutputFile::create(save.path);
  if (!file) return tl::unexpected(std::move(file.error()));
  if (auto written = (*format)->write(*file, output); !written) return written;
  return file->commit();
}

}  // namespace vorpipe::view

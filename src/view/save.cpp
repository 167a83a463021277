#include "base/try.h"
#include "io/base/extension.h"
#include "io/base/output_file.h"
#include "io/cells/fluid_state.h"
#include "io/pictures/picture_file.h"
#include "view/command.h"
#include "view/flow_colors.h"
#include "view/painter.h"
#include "vorpipe/free_surface.h"

namespace vorpipe::view {
namespace {

Result<void> saveFluid(const std::string& path, const Flowing& fluid) {
  auto file = OutputFile::create(path);
  if (!file) return tl::unexpected(std::move(file.error()));
  VORPIPE_TRY(writeFluid(*file, fluid.setup.state, fluid.setup.options));
  return file->commit();
}

}  // namespace

Result<void> Painter::save(const Save& save) {
  if (lowerExtension(save.path) == ".csv") return writeSites(save.path, *save.sites);
  if (lowerExtension(save.path) == ".npz") return saveFluid(save.path, *save.fluid);
  const auto format = pictureFormatOf(save.path);
  if (!format) return tl::unexpected(format.error());
  // In shapes, coloring by weight works for any values.
  const bool by_flow = save.fluid && save.flow_color != FlowColor::none && save.picture.fill;
  const Sites values = by_flow ? valuesOf(save.fluid->setup.state, save.flow_color) : Sites{};
  RenderOptions picture = save.picture;
  if (by_flow) {
    picture.color = ColorBy::weight;
    picture.legend = false;
    if (picture.color_scale == ColorScale::automatic) picture.color_scale = ColorScale::linear;
  }
  PictureOutput output{by_flow ? values : *save.sites, picture};
  output.threads = main_.threads();
  std::optional<Diagram> cells;
  if ((*format)->of_shapes) {
    if (!main_.isOpen())
      return tl::unexpected(Error{ErrorCode::device, save.path + ": nothing computes yet"});
    CellsOptions options = cellsOptions(save.picture);
    options.detail = Detail::polygons;
    const bool is_free = save.fluid && save.fluid->setup.options.surface == vorpipe::Surface::free;
    auto found = is_free ? freeCells(main_.session(), *save.sites, options)
                         : main_.session().cells(*save.sites, options);
    if (!found) return tl::unexpected(std::move(found.error()));
    cells = std::move(*found);
    output.diagram = &*cells;
  } else {
    output.image = &save.rendering->image;
  }
  auto file = OutputFile::create(save.path);
  if (!file) return tl::unexpected(std::move(file.error()));
  VORPIPE_TRY((*format)->write(*file, output));
  return file->commit();
}

}  // namespace vorpipe::view

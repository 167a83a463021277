// The files that a window writes.
#include <fmt/format.h>

#include <iterator>
#include <optional>
#include <utility>

#include "base/try.h"
#include "io/base/extension.h"
#include "io/base/output_file.h"
#include "io/cells/fluid_state.h"
#include "io/pictures/picture_file.h"
#include "view/command.h"
#include "view/painter.h"
#include "vorpipe/free_surface.h"

namespace vorpipe::view {
Result<void> writeSites(const std::string& path, const Sites& sites) {
  const bool weighted = !sites.weight.empty();
  std::string text = weighted ? "x,y,weight\n" : "x,y\n";
  for (std::size_t i = 0; i < sites.size(); ++i) {
    fmt::format_to(std::back_inserter(text), "{},{}", sites.x[i], sites.y[i]);
    if (weighted) fmt::format_to(std::back_inserter(text), ",{}", sites.weight[i]);
    text += '\n';
  }
  return writeFile(path, [&](OutputFile& file) { return file.write(text); });
}

Result<void> writeOutline(const std::string& path, const Outline& outline) {
  std::string text = "MULTIPOLYGON (";
  for (std::size_t polygon = 0; polygon + 1 < outline.polygon_offsets.size(); ++polygon) {
    text += polygon > 0 ? ", (" : "(";
    const auto first_ring = outline.polygon_offsets[polygon];
    for (auto ring = first_ring; ring < outline.polygon_offsets[polygon + 1]; ++ring) {
      text += ring > first_ring ? ", (" : "(";
      const auto first = outline.ring_offsets[ring], end = outline.ring_offsets[ring + 1];
      for (auto i = first; i < end; ++i) {
        fmt::format_to(std::back_inserter(text), "{} {}, ", outline.points[i].x, outline.points[i].y);
      }
      fmt::format_to(std::back_inserter(text), "{} {})", outline.points[first].x, outline.points[first].y);
    }
    text += ')';
  }
  text += ")\n";
  return writeFile(path, [&](OutputFile& file) { return file.write(text); });
}

Result<void> Painter::save(const Save& save) {
  if (lowerExtension(save.path) == ".csv") return writeSites(save.path, *save.sites);
  if (lowerExtension(save.path) == ".npz") {
    const FluidSetup& fluid = save.fluid->setup;
    return writeFile(save.path,
                     [&](OutputFile& file) { return writeFluid(file, fluid.state, fluid.options); });
  }
  VORPIPE_LET(format, pictureFormatOf(save.path));
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
  if (format->of_shapes) {
    if (!main_.isOpen())
      return tl::unexpected(Error{ErrorCode::device, save.path + ": nothing computes yet"});
    CellsOptions options = cellsOptions(save.picture);
    options.detail = Detail::polygons;
    const bool is_free = save.fluid && save.fluid->setup.options.surface == vorpipe::Surface::free;
    VORPIPE_VAR(found, is_free ? freeCells(main_.session(), *save.sites, options)
                               : main_.session().cells(*save.sites, options));
    cells = std::move(found);
    output.diagram = &*cells;
  } else {
    output.image = &save.rendering->image;
  }
  return writeFile(save.path, [&](OutputFile& file) { return format->write(file, output); });
}

}  // namespace vorpipe::view

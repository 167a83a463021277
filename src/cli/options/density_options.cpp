#include "cli/options/density_options.h"

#include <fmt/format.h>

#include "cli/options/options.h"

namespace vorpipe::cli {

void addDensityOptions(Options& options, DensityOptions& density, const std::string& purpose) {
  Option file = addAnyFile(
      options, "--density", density.file, {".png", ".jpg", ".jpeg", ".npy"},
      fmt::format(
          "a density over the domain, or where a world file (.pgw, .jgw, .tfw, .wld) or GDAL's .aux.xml "
          "beside it says: .png or .jpg (dark is dense) or .npy, pixels with row 0 at the top: {}",
          purpose));
  addParsed(options, "--density-box", density.box, "XMIN,YMIN,XMAX,YMAX",
            "where the pixels of --density lie, in the unit of the domain, with --project in kilometers of "
            "its plane; beyond it there is nothing [the domain's box]",
            parseBox)
      .needs(file);
}

}  // namespace vorpipe::cli

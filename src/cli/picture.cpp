#include "cli/picture.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/try.h"
#include "io/base/error.h"
#include "vorpipe.h"

namespace vorpipe::cli {
namespace {

/// Returns the first given option that maps values to colors.
std::string_view scaleOption(const RenderOptions& picture) {
  if (picture.color_scale != ColorScale::automatic) return "--color-scale";
  if (picture.color_range) return "--color-range";
  return picture.legend ? "--legend" : "";
}

/// Checks what can be wrong with a picture before its cells are known.
Result<void> checkPicture(const RenderOptions& picture, const InputOptions& sites, const Input& input) {
  if (picture.color == ColorBy::weight && input.sites.weight.empty()) {
    return inputError(
        fmt::format("--color: weight needs weights; {} has none, and there is no --weights", sites.sites));
  }
  const std::string_view scaled = scaleOption(picture);
  if (picture.legend && !picture.fill) {
    return inputError("--legend: cells have no colors with --no-fill");
  }
  if (picture.color == ColorBy::site && !scaled.empty()) {
    return inputError(
        fmt::format("{}: colors by site stand for no values; name --color area, neighbors or "
                    "weight",
                    scaled));
  }
  if (picture.color_scale == ColorScale::log && picture.color_range && picture.color_range->low <= 0) {
    return inputError(fmt::format("--color-range: LO {} is not above 0, as --color-scale log needs it",
                                  picture.color_range->low));
  }
  const auto [width, height] = least_with_legend;
  if (picture.legend && (picture.width < width || picture.height < height)) {
    return inputError(fmt::format("--legend: has no room in {}x{} pixels, it takes {}x{}", picture.width,
                                  picture.height, width, height));
  }
  return {};
}

}  // namespace

PictureSize sizeOf(const PictureOptions& picture, const std::optional<Box>& domain) {
  if (!domain) return sizeBefore(picture.size);
  RenderOptions options = picture.render;
  options.domain = *domain;
  const int longer_side = picture.size.longer_side;
  const Box& shown = shownBox(options);
  return picture.size.sides.value_or(longer_side > 0 ? sizeFor(shown, longer_side) : defaultSize(shown));
}

Result<RenderOptions> pictureOf(const PictureOptions& picture, const InputOptions& sites,
                                const Input& input) {
  RenderOptions options = picture.render;
  options.domain = input.domain;
  options.outline = input.outline;
  options.periodic = input.periodic;
  const PictureSize size = sizeOf(picture, input.domain);
  options.width = size.width;
  options.height = size.height;
  options.fit = picture.fit.value_or(usualFit(input));
  options.fill = !picture.no_fill;
  if (picture.edge_width) {
    if (!options.edges && !options.dual) return inputError("--edge-width: needs --edges or --dual");
    options.edge_width = *picture.edge_width;
  }
  if (auto checked = checkView(options); !checked) return inputError("--view: " + checked.error().message);
  VORPIPE_TRY(checkPicture(options, sites, input));
  return options;
}

std::string stretchNote(const PictureOptions& picture, const RenderOptions& options) {
  if (picture.fit || options.fit != Fit::stretch || !picture.size.sides) return {};
  const auto [width, height] = *picture.size.sides;
  const Box& shown = shownBox(options);
  const PictureFrame kept = frameOf(shown, width, height, Fit::letterbox);
  if (kept.width == width && kept.height == height) return {};
  return fmt::format("--size {}x{} stretches the {} of {:.6g} x {:.6g}; --size {} keeps its aspect", width,
                     height, options.view ? "view" : "domain", shown.xmax - shown.xmin,
                     shown.ymax - shown.ymin, std::max(width, height));
}

}  // namespace vorpipe::cli

#include "c/options.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <optional>

#include "base/try.h"
#include "c/calls.h"
#include "io/base/error.h"

namespace vorpipe::c {
namespace {

/// Takes options of appearance: mapping of values to colors, line widths, the domain's aspect ratio.
Result<void> takeLooks(const PlacedInput& placed, const vorpipe_render_options& given,
                       RenderOptions& options) {
  constexpr std::array scales{ColorScale::automatic, ColorScale::linear, ColorScale::log,
                              ColorScale::quantile};
  VORPIPE_LET(scale, chosen(scales, given.color_scale, "color_scale"));
  const std::array fits{usualFit(placed.domain), Fit::stretch, Fit::letterbox};
  VORPIPE_LET(fit, chosen(fits, given.fit, "fit"));
  options.color_scale = scale;
  options.fit = fit;
  if (given.has_range != 0) options.color_range = ColorRange{given.range_low, given.range_high};
  options.legend = given.legend != 0;
  if (given.edge_width != 0) options.edge_width = given.edge_width;
  options.dot_size = given.dot_size;
  if (given.antialias != 0) options.antialias = given.antialias;
  options.dual = given.dual != 0;
  options.labels = given.labels != 0;
  options.fill = given.no_fill == 0;
  if (given.label_size != 0) options.label_size = given.label_size;
  return {};
}

}  // namespace

Result<SearchOptions> searchOf(vorpipe_search search, std::int32_t neighbors) {
  constexpr std::array methods{Search::grid, Search::flann};
  VORPIPE_LET(method, chosen(methods, search, "search"));
  SearchOptions options;
  options.method = method;
  if (neighbors != 0) options.neighbors = neighbors;
  return options;
}

Progress progressOf(vorpipe_progress progress, void* user) {
  if (progress == nullptr) return {};
  return [progress, user](std::string_view stage, double fraction) {
    return progress(user, std::string(stage).c_str(), fraction) == 0;
  };
}

Result<Mask> maskOf(std::uint32_t disabled_count, const char* const* disabled, std::uint64_t limit_count,
                    const vorpipe_limit* limits) {
  Mask mask;
  if (disabled_count > 0 && disabled == nullptr) return inputError("disabled: is NULL");
  if (limit_count > 0 && limits == nullptr) return inputError("limits: is NULL");
  for (std::uint32_t k = 0; k < disabled_count; ++k) {
    const char* name = disabled[k];
    const auto known = featureNames();
    if (name == nullptr || std::ranges::find(known, name) == known.end()) {
      return inputError(fmt::format("disabled: no feature {}", name == nullptr ? "NULL" : name));
    }
    mask.disabled.emplace_back(name);
  }
  for (std::uint64_t k = 0; k < limit_count; ++k) {
    const auto& [name, value] = limits[k];
    const auto known = limitNames();
    if (name == nullptr || std::ranges::find(known, name) == known.end()) {
      return inputError(fmt::format("limits: no limit {}", name == nullptr ? "NULL" : name));
    }
    mask.limits.emplace_back(name, value);
  }
  return mask;
}

Result<int> threadsOf(std::int32_t threads) {
  if (threads >= 0) return threads;
  return inputError(fmt::format("threads: is {}", threads));
}

Result<CellsOptions> cellsOptions(const vorpipe_input& input, const PlacedInput& placed,
                                  const vorpipe_cells_options* given) {
  VORPIPE_LET(taken_options, taken(given, "vorpipe_cells_options"));
  constexpr std::array details{Detail::everything, Detail::measures, Detail::polygons};
  VORPIPE_LET(detail, chosen(details, taken_options.detail, "detail"));
  VORPIPE_LET(search, searchOf(taken_options.search, taken_options.search_neighbors));
  CellsOptions options{};
  options.domain = placed.domain.domain;
  options.outline = placed.domain.outline;
  options.periodic = placed.domain.periodic;
  options.density = input.density;
  options.search = search;
  options.detail = detail;
  options.progress = progressOf(taken_options.progress, taken_options.progress_user);
  return options;
}

Result<RenderOptions> renderOptions(const PlacedInput& placed, const vorpipe_render_options* given) {
  VORPIPE_LET(taken_options, taken(given, "vorpipe_render_options"));
  constexpr std::array colors{ColorBy::site, ColorBy::area, ColorBy::neighbors, ColorBy::weight};
  VORPIPE_LET(color, chosen(colors, taken_options.color, "color"));
  VORPIPE_LET(search, searchOf(taken_options.search, taken_options.search_neighbors));
  RenderOptions options{};
  options.domain = placed.domain.domain;
  options.outline = placed.domain.outline;
  options.periodic = placed.domain.periodic;
  if (taken_options.has_view != 0) {
    options.view = Box{taken_options.view_xmin, taken_options.view_ymin, taken_options.view_xmax,
                       taken_options.view_ymax};
  }
  const bool sized = taken_options.width != 0 || taken_options.height != 0;
  const PictureSize size =
      sized ? PictureSize{taken_options.width, taken_options.height} : defaultSize(shownBox(options));
  options.width = size.width;
  options.height = size.height;
  options.color = color;
  if (taken_options.colormap != nullptr) options.colormap = taken_options.colormap;
  options.edges = taken_options.edges != 0;
  options.show_sites = taken_options.show_sites != 0;
  options.search = search;
  options.progress = progressOf(taken_options.progress, taken_options.progress_user);
  VORPIPE_TRY(takeLooks(placed, taken_options, options));
  if (options.color == ColorBy::weight && placed.sites->weight.empty()) {
    return tl::unexpected(Error{ErrorCode::input, "color: weight needs weights", false, Subject::weights});
  }
  return options;
}

Result<CellsOptions> movingOptions(const vorpipe_input& input, const PlacedInput& placed,
                                   vorpipe_search search, std::int32_t neighbors) {
  vorpipe_cells_options options{};
  options.struct_size = sizeof(options);
  options.search = search;
  options.search_neighbors = neighbors;
  return cellsOptions(input, placed, &options);
}

}  // namespace vorpipe::c

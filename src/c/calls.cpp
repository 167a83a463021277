#include "c/calls.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>

#include "base/try.h"
#include "io/base/error.h"
#include "vorpipe/globe.h"

namespace vorpipe::c {
namespace {

/// No part is on the heap or needs a destructor: registering a thread's destructor takes memory, and without
/// memory the C library ends the program.
struct LastError {
  std::array<char, 8192> message{};  ///< zero-terminated; a longer message ends with "..."
  vorpipe_subject subject = VORPIPE_SUBJECT_NONE;
};

constinit thread_local LastError last_error;

void keep(std::string_view message) {
  constexpr std::string_view more = "...";
  std::array<char, 8192>& kept = last_error.message;
  std::size_t size = std::min(message.size(), kept.size() - 1);
  const bool is_cut = size < message.size();
  if (is_cut) {
    size -= more.size();
    const auto continues = [&](std::size_t at) {
      return (static_cast<unsigned char>(message[at]) & 0xC0u) == 0x80u;
    };
    while (size > 0 && continues(size)) --size;
  }
  std::memcpy(kept.data(), message.data(), size);
  if (is_cut) size += more.copy(kept.data() + size, more.size());
  kept[size] = 0;
}

vorpipe_subject numberOf(Subject subject) {
  switch (subject) {
    case Subject::none:
      return VORPIPE_SUBJECT_NONE;
    case Subject::sites:
      return VORPIPE_SUBJECT_SITES;
    case Subject::weights:
      return VORPIPE_SUBJECT_WEIGHTS;
    case Subject::domain:
      return VORPIPE_SUBJECT_DOMAIN;
    case Subject::outline:
      return VORPIPE_SUBJECT_OUTLINE;
    case Subject::period:
      return VORPIPE_SUBJECT_PERIOD;
    case Subject::density:
      return VORPIPE_SUBJECT_DENSITY;
    case Subject::search:
      return VORPIPE_SUBJECT_SEARCH;
    case Subject::masses:
      return VORPIPE_SUBJECT_MASSES;
  }
  return VORPIPE_SUBJECT_NONE;
}

vorpipe_code numberOf(ErrorCode code) {
  switch (code) {
    case ErrorCode::input:
      return VORPIPE_INPUT;
    case ErrorCode::device:
      return VORPIPE_DEVICE;
    case ErrorCode::cancelled:
      return VORPIPE_CANCELLED;
  }
  return VORPIPE_DEVICE;
}

}  // namespace

vorpipe_code fail(vorpipe_code code, std::string_view message, Subject subject) noexcept {
  keep(message);
  last_error.subject = numberOf(subject);
  return code;
}

vorpipe_code outOfMemory() noexcept { return fail(VORPIPE_DEVICE, "there is not enough memory for this"); }

vorpipe_code fail(const Error& error) { return fail(numberOf(error.code), error.message, error.subject); }

vorpipe_code missing(std::string_view argument) noexcept {
  return guarded([&] { return fail(VORPIPE_INPUT, fmt::format("{}: is NULL", argument)); });
}

Result<void> checkStruct(const void* given, std::uint32_t struct_size, std::size_t known,
                         std::string_view name) {
  if (struct_size < sizeof(struct_size)) {
    return inputError(
        fmt::format("{}: struct_size is {}; begin with {{sizeof {}}}", name, struct_size, name));
  }
  if (struct_size <= known) return {};
  const auto* bytes = static_cast<const unsigned char*>(given);
  if (std::all_of(bytes + known, bytes + struct_size, [](unsigned char byte) { return byte == 0; }))
    return {};
  return inputError(fmt::format("{}: has a field that vorpipe {} does not know", name, version()));
}

std::size_t sizeOf(vorpipe_type type) {
  switch (type) {
    case VORPIPE_UINT8:
      return 1;
    case VORPIPE_INT32:
    case VORPIPE_UINT32:
    case VORPIPE_FLOAT:
      return 4;
    case VORPIPE_INT64:
    case VORPIPE_UINT64:
    case VORPIPE_DOUBLE:
      return 8;
    default:
      return 0;
  }
}

tl::unexpected<Error> noField(std::int32_t field) {
  return inputError(fmt::format("field: no field {}", field));
}

vorpipe_code give(const Result<vorpipe_array>& array, vorpipe_array* to) {
  if (!array) return fail(array.error());
  *to = *array;
  return VORPIPE_DONE;
}

vorpipe_report reportOf(const Report& report) {
  vorpipe_report shown{};
  shown.note_count = static_cast<std::uint32_t>(report.notes.size());
  shown.backend = report.backend.c_str();
  shown.device = report.device.c_str();
  shown.driver = report.driver.c_str();
  shown.ok = report.ok;
  shown.empty = report.empty;
  shown.duplicate = report.duplicate;
  shown.hidden = report.hidden;
  shown.retried = report.retried;
  shown.in_double = report.in_double;
  shown.exact = report.exact;
  shown.pixels = report.pixels;
  shown.order_ms = report.time_ms.order;
  shown.upload_ms = report.time_ms.upload;
  shown.search_ms = report.time_ms.search;
  shown.cells_ms = report.time_ms.cells;
  shown.draw_ms = report.time_ms.draw;
  shown.download_ms = report.time_ms.download;
  shown.validation_count = report.validation_messages.size();
  return shown;
}

const char* textAt(const std::vector<std::string>& texts, std::size_t index) {
  return index < texts.size() ? texts[index].c_str() : nullptr;
}

namespace {

Result<void> takeColor(std::string_view name, const char* text, std::optional<Color>& color) {
  if (text == nullptr) return {};
  const auto read = readColor(text);
  if (!read) return inputError(fmt::format("{}: {}", name, read.error().message));
  color = *read;
  return {};
}

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
  VORPIPE_TRY(takeColor("edge_color", given.edge_color, options.edge_color));
  VORPIPE_TRY(takeColor("background", given.background, options.background));
  return {};
}

/// Takes what pictures of the globe alone have.
Result<void> takeMap(const PlacedInput& placed, const vorpipe_render_options& given, RenderOptions& options) {
  constexpr std::array maps{GlobeMap::plate_carree, GlobeMap::equal_earth};
  VORPIPE_LET(map, chosen(maps, given.map, "map"));
  options.globe = placed.domain.globe;
  options.map = map;
  options.graticule = given.graticule;
  if (given.has_view_from != 0) {
    options.view_from = Point{given.view_from_longitude, given.view_from_latitude};
  }
  if (!options.globe) {
    if (map == GlobeMap::plate_carree && !options.view_from) return {};
    return inputError(fmt::format("{}: is of the globe, and this input is in a plane",
                                  options.view_from ? "view_from" : "map"));
  }
  if (given.fit != VORPIPE_FIT_AUTOMATIC)
    return inputError("fit: is of a plane; maps of the globe keep their aspect");
  if (options.view) return {};
  VORPIPE_VAR(shown, domainOnMap(options));
  options.view = shown;
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
  options.globe = placed.domain.globe;
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
  VORPIPE_TRY(takeMap(placed, taken_options, options));
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

using namespace vorpipe;
using namespace vorpipe::c;

const char* vorpipe_last_error() { return vorpipe::c::last_error.message.data(); }

vorpipe_subject vorpipe_last_subject() { return vorpipe::c::last_error.subject; }

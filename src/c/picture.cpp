/// Pictures: runs, arrays, reports; and pictures as shapes.
#include <fmt/core.h>

#include <string>
#include <utility>

#include "base/try.h"
#include "c/calls.h"
#include "c/diagram.h"
#include "c/handles.h"
#include "c/options.h"
#include "c/outputs.h"
#include "c/placed_input.h"
#include "io/base/error.h"
#include "io/base/extension.h"
#include "io/pictures/npy_ids.h"
#include "io/pictures/picture_file.h"
#include "io/pictures/png_file.h"
#include "vorpipe/free_surface.h"

namespace vorpipe::c {
namespace {

/// One row of pixels is a row of the array.
template <class Number>
vorpipe_array rows(const std::vector<std::uint32_t>& pixels, int width) {
  constexpr auto numbers = static_cast<std::int32_t>(sizeof(std::uint32_t) / sizeof(Number));
  constexpr vorpipe_type type = sizeof(Number) == 1 ? VORPIPE_UINT8 : VORPIPE_UINT32;
  if (pixels.empty()) return {nullptr, 0, type, numbers * width};
  return {pixels.data(), pixels.size() / static_cast<std::size_t>(width), type, numbers * width};
}

Result<vorpipe_array> arrayOf(const Rendering& rendering, vorpipe_picture_field field) {
  const Image& image = rendering.image;
  switch (field) {
    case VORPIPE_PICTURE_RGBA:
      return rows<std::uint8_t>(image.rgba, image.width);
    case VORPIPE_PICTURE_IDS:
      return rows<std::uint32_t>(image.ids, image.width);
    case VORPIPE_PICTURE_STATUS:
      return array(rendering.status, VORPIPE_UINT8);
    case VORPIPE_PICTURE_OWNER:
      return array(rendering.owner, VORPIPE_UINT32);
    default:
      return noField(field);
  }
}

Result<Image> readPicture(const std::string& path) {
  const std::string extension = lowerExtension(path);
  if (extension == ".png") return readPng(path);
  if (extension == ".npy") return readNpyIds(path);
  return inputError(fmt::format("{}: unknown kind of picture; known are .png and .npy", path));
}

vorpipe_code draw(vorpipe_session& session, const vorpipe_input& input, const vorpipe_render_options* given,
                  vorpipe_picture** picture) {
  const auto placed = placedInput(input);
  if (!placed) return fail(placed.error());
  auto options = renderOptions(**placed, given);
  if (!options) return fail(options.error());
  auto drawn = session.session.render(*(*placed)->sites, *options);
  if (!drawn) return fail(drawn.error());
  const bool has_air = input.surface == Surface::free;
  if (has_air) {
    auto taken_out = takeOutAir(*(*placed)->sites, *options, drawn->image, session.threads);
    if (!taken_out) return fail(taken_out.error());
  }
  options->progress = nullptr;
  *picture = new vorpipe_picture{*placed, std::move(*options), std::move(*drawn), has_air};
  return VORPIPE_DONE;
}

/// Returns the meaning of colors, in the form of vorpipe_c.h.
vorpipe_color_key keyOf(const Rendering& rendering) {
  vorpipe_color_key shown{};
  shown.ticks = {nullptr, 0, VORPIPE_DOUBLE, 2};
  if (!rendering.key) return shown;
  const ColorKey& key = *rendering.key;
  static_assert(sizeof(key.ticks[0]) == 2 * sizeof(double));
  shown.color = static_cast<vorpipe_color>(key.color);
  shown.scale = static_cast<vorpipe_color_scale>(key.scale);
  shown.low = key.range.low;
  shown.high = key.range.high;
  shown.ticks = array(key.ticks, VORPIPE_DOUBLE);
  return shown;
}

/// Returns the format of shapes that a path names. Error (input): it names none.
Result<const PictureFormat*> shapesFormatOf(const std::string& path) {
  const auto format = pictureFormatOf(path);
  if (format && !(*format)->of_shapes) {
    return inputError(fmt::format("{}: is made of pixels, which vorpipe_render draws", path));
  }
  return format;
}

/// Finds the cells, and writes them as a picture.
Result<void> draw(vorpipe_session& session, const vorpipe_input& input, const vorpipe_render_options* given,
                  const PictureFormat& format, ByteSink& to) {
  VORPIPE_LET(placed, placedInput(input));
  VORPIPE_LET(options, renderOptions(*placed, given));
  VORPIPE_TRY(checkPicture(options));
  CellsOptions cells = cellsOptions(options);
  cells.detail = Detail::polygons;
  const Sites& sites = *placed->sites;
  VORPIPE_LET(found, cellsWith(input.surface, session.session, sites, cells));
  return format.write(to, {sites, options, nullptr, &found, placed->domain.system, session.threads});
}

}  // namespace
}  // namespace vorpipe::c

using namespace vorpipe;
using namespace vorpipe::c;

vorpipe_code vorpipe_render(vorpipe_session* session, const vorpipe_input* input,
                            const vorpipe_render_options* options, vorpipe_picture** picture) {
  if (session == nullptr) return missing("session");
  if (input == nullptr) return missing("input");
  if (picture == nullptr) return missing("picture");
  return guardedRun(*session, [&] { return draw(*session, *input, options, picture); });
}

vorpipe_code vorpipe_picture_read(const char* path, vorpipe_picture** picture) {
  if (path == nullptr) return missing("path");
  if (picture == nullptr) return missing("picture");
  return guarded([&] {
    auto image = readPicture(path);
    if (!image) return fail(image.error());
    *picture = new vorpipe_picture{nullptr, {}, {std::move(*image), {}, {}, {}, {}}};
    return vorpipe_code{VORPIPE_DONE};
  });
}

void vorpipe_picture_free(vorpipe_picture* picture) { delete picture; }

vorpipe_code vorpipe_picture_array(const vorpipe_picture* picture, vorpipe_picture_field field,
                                   vorpipe_array* array) {
  if (picture == nullptr) return missing("picture");
  if (array == nullptr) return missing("array");
  return guarded([&] { return give(arrayOf(picture->rendering, field), array); });
}

int32_t vorpipe_picture_width(const vorpipe_picture* picture) {
  return picture == nullptr ? 0 : picture->rendering.image.width;
}

int32_t vorpipe_picture_height(const vorpipe_picture* picture) {
  return picture == nullptr ? 0 : picture->rendering.image.height;
}

vorpipe_code vorpipe_picture_key(const vorpipe_picture* picture, vorpipe_color_key* key) {
  if (picture == nullptr) return missing("picture");
  if (key == nullptr) return missing("key");
  return guarded([&] { return codeOf(give(keyOf(picture->rendering), key, "vorpipe_color_key")); });
}

vorpipe_code vorpipe_picture_report(const vorpipe_picture* picture, vorpipe_report* report) {
  if (picture == nullptr) return missing("picture");
  if (report == nullptr) return missing("report");
  return guarded([&] { return codeOf(give(reportOf(picture->rendering.report), report, "vorpipe_report")); });
}

const char* vorpipe_picture_note(const vorpipe_picture* picture, size_t index) {
  return picture == nullptr ? nullptr : textAt(picture->rendering.report.notes, index);
}

const char* vorpipe_picture_validation(const vorpipe_picture* picture, size_t index) {
  return picture == nullptr ? nullptr : textAt(picture->rendering.report.validation_messages, index);
}

vorpipe_code vorpipe_draw(vorpipe_session* session, const vorpipe_input* input,
                          const vorpipe_render_options* options, const char* format, vorpipe_write write,
                          void* user) {
  if (session == nullptr) return missing("session");
  if (input == nullptr) return missing("input");
  if (format == nullptr) return missing("format");
  if (write == nullptr) return missing("write");
  return guardedRun(*session, [&] {
    const auto known = shapesFormatOf(std::string("picture.") + format);
    if (!known) return fail(known.error());
    auto sink = sinkOf(format, write, user);
    return codeOf(draw(*session, *input, options, **known, sink));
  });
}

vorpipe_code vorpipe_draw_save(vorpipe_session* session, const vorpipe_input* input,
                               const vorpipe_render_options* options, const char* path) {
  if (session == nullptr) return missing("session");
  if (input == nullptr) return missing("input");
  if (path == nullptr) return missing("path");
  return guardedRun(*session, [&] {
    const auto known = shapesFormatOf(path);
    if (!known) return fail(known.error());
    return codeOf(
        writeFile(path, [&](ByteSink& to) { return draw(*session, *input, options, **known, to); }));
  });
}

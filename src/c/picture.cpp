/// Pictures; and what checks and compares results.
#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <utility>

#include "base/try.h"
#include "c/calls.h"
#include "c/handles.h"
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
  constexpr bool by_channel = sizeof(Number) == 1;
  constexpr std::int32_t numbers = by_channel ? 4 : 1;
  constexpr vorpipe_type type = by_channel ? VORPIPE_UINT8 : VORPIPE_UINT32;
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
  VORPIPE_TAKE(placed, placedInput(input));
  VORPIPE_TAKE(options, renderOptions(*placed, given));
  VORPIPE_TAKE(drawn, session.session.render(*placed->sites, options));
  const bool has_air = input.surface == Surface::free;
  if (has_air) {
    const auto taken_out = takeOutAir(*placed->sites, options, drawn.image, session.threads);
    if (!taken_out) return fail(taken_out.error());
  }
  options.progress = nullptr;
  *picture = new vorpipe_picture{placed, std::move(options), std::move(drawn), has_air};
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

/// Sends each broken promise to the caller, in a line of its own.
vorpipe_code tellBroken(const Result<std::vector<std::string>>& broken, vorpipe_write write, void* user) {
  if (!broken) return fail(broken.error());
  if (broken->empty()) return VORPIPE_DONE;
  for (const std::string& promise : *broken) {
    const std::string line = promise + "\n";
    if (write != nullptr && write(user, line.data(), line.size()) != 0) break;
  }
  return fail(VORPIPE_DIFFERENT, broken->front());
}

/// Returns broken promises of cells, checked in the plane where they were made.
Result<std::vector<std::string>> checkCells(const vorpipe_diagram& given, int threads) {
  if (given.space) return check(given.space->sites, given.space->whole(), given.space->diagram, threads);
  const Sites& sites = *given.input->sites;
  if (!given.plane) return check(sites, given.options, given.diagram, threads);
  Diagram diagram = given.diagram;
  diagram.vertices = given.plane->vertices;
  diagram.centroid = given.plane->centroid;
  diagram.mass_centroid = given.plane->mass_centroid;
  return check(sites, given.options, diagram, threads);
}

/// Returns the result of a compare function, and stores the figures for the caller.
template <class Difference>
vorpipe_code tellDifference(bool agree, const std::string& message, const Difference& figures, Difference* to,
                            std::string_view name) {
  if (to != nullptr) {
    if (auto given = give(figures, to, name); !given) return fail(given.error());
  }
  return agree ? vorpipe_code{VORPIPE_DONE} : fail(VORPIPE_DIFFERENT, message);
}

vorpipe_code compareIds(const vorpipe_picture& a, const vorpipe_picture& b,
                        vorpipe_picture_difference* difference) {
  const Image& first = a.rendering.image;
  const auto& ids = b.rendering.image.ids;
  const vorpipe_picture& drawn = a.input != nullptr ? a : b;
  Result<IdDiff> found = drawn.input == nullptr
                             ? diffIds(first.ids, ids, first.width, first.height)
                             : diffIds(first.ids, ids, first.width, first.height, *drawn.input->sites,
                                       drawn.options.domain, drawn.options.periodic, drawn.options.fit);
  if (!found) return fail(found.error());
  vorpipe_picture_difference figures{};
  figures.equal = found->equal;
  figures.ties = found->ties;
  figures.wrong = found->wrong;
  figures.ties_allowed = found->ties_allowed;
  figures.widest_tie = found->widest_tie;
  return tellDifference(
      found->agree(),
      fmt::format("{} pixels have different sites, {} others are ties, {} of which are allowed", found->wrong,
                  found->ties, found->ties_allowed),
      figures, difference, "vorpipe_picture_difference");
}

vorpipe_code compareColors(const Image& a, const Image& b, vorpipe_picture_difference* difference) {
  const ImageDiff found = diffImages(a.rgba, b.rgba, a.width, a.height);
  vorpipe_picture_difference figures{};
  figures.largest = static_cast<std::uint32_t>(found.largest);
  figures.equal = a.rgba.size() - found.different;
  figures.wrong = found.different;
  return tellDifference(found.different == 0,
                        fmt::format("{} pixels differ, by up to {}", found.different, found.largest), figures,
                        difference, "vorpipe_picture_difference");
}

vorpipe_code comparePictures(const vorpipe_picture& a, const vorpipe_picture& b,
                             vorpipe_picture_difference* difference) {
  const Image &first = a.rendering.image, &second = b.rendering.image;
  if (first.width != second.width || first.height != second.height) {
    return fail(VORPIPE_INPUT, fmt::format("pictures of {} x {} and {} x {} pixels cannot be compared",
                                           first.width, first.height, second.width, second.height));
  }
  if (!first.ids.empty() && !second.ids.empty()) return compareIds(a, b, difference);
  if (!first.rgba.empty() && !second.rgba.empty()) return compareColors(first, second, difference);
  return fail(VORPIPE_INPUT, "one picture has pixels alone, the other has ids alone");
}

vorpipe_code compareDiagrams(const vorpipe_diagram& a, const vorpipe_diagram& b,
                             vorpipe_cells_difference* difference) {
  for (const vorpipe_diagram* diagram : {&a, &b}) {
    if (auto refused = refuseSpace(*diagram, "what is compared"); !refused) return fail(refused.error());
  }
  VORPIPE_TAKE(found, diffCells(a.diagram, b.diagram));
  vorpipe_cells_difference figures{};
  figures.worst_site = found.worst_site;
  figures.equal = found.equal;
  figures.statuses = found.statuses;
  figures.neighbors = found.neighbors;
  figures.areas = found.areas;
  figures.worst_area = found.worst_area;
  return tellDifference(
      found.agree(),
      fmt::format("{} cells differ in their status, {} in their neighbors, {} in their area", found.statuses,
                  found.neighbors, found.areas),
      figures, difference, "vorpipe_cells_difference");
}

}  // namespace
}  // namespace vorpipe::c

using namespace vorpipe;
using namespace vorpipe::c;

vorpipe_code vorpipe_render(vorpipe_session* session, const vorpipe_input* input,
                            const vorpipe_render_options* options, vorpipe_picture** picture) {
  VORPIPE_NEEDS(session, input, picture);
  return guardedRun(*session, [&] { return draw(*session, *input, options, picture); });
}

vorpipe_code vorpipe_picture_read(const char* path, vorpipe_picture** picture) {
  VORPIPE_NEEDS(path, picture);
  return guarded([&] {
    VORPIPE_TAKE(image, readPicture(path));
    *picture = new vorpipe_picture{nullptr, {}, {std::move(image), {}, {}, {}, {}}};
    return vorpipe_code{VORPIPE_DONE};
  });
}

void vorpipe_picture_free(vorpipe_picture* picture) { delete picture; }

vorpipe_code vorpipe_picture_array(const vorpipe_picture* picture, vorpipe_picture_field field,
                                   vorpipe_array* array) {
  VORPIPE_NEEDS(picture, array);
  return guarded([&] { return give(arrayOf(picture->rendering, field), array); });
}

int32_t vorpipe_picture_width(const vorpipe_picture* picture) {
  return picture == nullptr ? 0 : picture->rendering.image.width;
}

int32_t vorpipe_picture_height(const vorpipe_picture* picture) {
  return picture == nullptr ? 0 : picture->rendering.image.height;
}

vorpipe_code vorpipe_picture_key(const vorpipe_picture* picture, vorpipe_color_key* key) {
  VORPIPE_NEEDS(picture, key);
  return guarded([&] { return codeOf(give(keyOf(picture->rendering), key, "vorpipe_color_key")); });
}

vorpipe_code vorpipe_picture_report(const vorpipe_picture* picture, vorpipe_report* report) {
  VORPIPE_NEEDS(picture, report);
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
  VORPIPE_NEEDS(session, input, format, write);
  return guardedRun(*session, [&] {
    VORPIPE_TAKE(known, shapesFormatOf(std::string("picture.") + format));
    auto sink = sinkOf(format, write, user);
    return codeOf(draw(*session, *input, options, *known, sink));
  });
}

vorpipe_code vorpipe_draw_save(vorpipe_session* session, const vorpipe_input* input,
                               const vorpipe_render_options* options, const char* path) {
  VORPIPE_NEEDS(session, input, path);
  return guardedRun(*session, [&] {
    VORPIPE_TAKE(known, shapesFormatOf(path));
    return codeOf(writeFile(path, [&](ByteSink& to) { return draw(*session, *input, options, *known, to); }));
  });
}

vorpipe_code vorpipe_diagram_check(const vorpipe_diagram* diagram, int32_t threads, vorpipe_write broken,
                                   void* user) {
  VORPIPE_NEEDS(diagram);
  return guarded([&] {
    VORPIPE_TAKE(count, threadsOf(threads));
    if (diagram->has_air) return fail(VORPIPE_INPUT, "cells with a free surface cannot be checked yet");
    return tellBroken(checkCells(*diagram, count), broken, user);
  });
}

vorpipe_code vorpipe_picture_check(const vorpipe_picture* picture, int32_t threads, vorpipe_write broken,
                                   void* user) {
  VORPIPE_NEEDS(picture);
  return guarded([&] {
    VORPIPE_TAKE(count, threadsOf(threads));
    if (picture->input == nullptr) {
      return fail(VORPIPE_INPUT, "a picture that was read cannot be checked: its sites are not known");
    }
    if (picture->has_air) return fail(VORPIPE_INPUT, "pictures with a free surface cannot be checked yet");
    return tellBroken(check(*picture->input->sites, picture->options, picture->rendering, count), broken,
                      user);
  });
}

vorpipe_code vorpipe_diagrams_compare(const vorpipe_diagram* a, const vorpipe_diagram* b,
                                      vorpipe_cells_difference* difference) {
  if (a == nullptr || b == nullptr) return missing("diagram");
  return guarded([&] { return compareDiagrams(*a, *b, difference); });
}

vorpipe_code vorpipe_pictures_compare(const vorpipe_picture* a, const vorpipe_picture* b,
                                      vorpipe_picture_difference* difference) {
  if (a == nullptr || b == nullptr) return missing("picture");
  return guarded([&] { return comparePictures(*a, *b, difference); });
}

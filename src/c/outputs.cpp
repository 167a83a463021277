#include "c/calls.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <span>
#include <string>

#include "c/handles.h"
#include "io/base/error.h"
#include "io/base/extension.h"
#include "io/cells/cells_file.h"
#include "io/cells/edges_file.h"
#include "io/cells/points_file.h"
#include "io/pictures/picture_file.h"

namespace vorpipe::c {
namespace {

Result<void> writeTo(ByteSink& to, const MovedSites& moved, const PointsFormat& format) {
  return writePoints(
      to, {shownSites(moved.placed, moved.sites), *moved.input.attributes, systemOf(moved.placed)}, format);
}

Result<void> writeAs(ByteSink& to, const vorpipe_diagram& diagram, const CellsFormat& format,
                     const vorpipe_write_options& options) {
  if (format.detail > diagram.options.detail) {
    return inputError(
        fmt::format("{}: {} needs cells of more detail than these have", to.name(), format.extension));
  }
  if (options.only_cells != 0 && !format.features) {
    return inputError(fmt::format("only_cells: {} has no features to leave out", to.name()));
  }
  const std::span<const Attribute> attributes(*diagram.attributes);
  return writeCells(
      to,
      {*diagram.input->given, diagram.diagram, attributes, systemOf(*diagram.input), options.only_cells != 0},
      format);
}

Result<void> writeEdgesAs(ByteSink& to, const vorpipe_diagram& diagram, const EdgesFormat& format) {
  VORPIPE_TRY(refuseSpace(diagram, "files of edges"));
  const auto& topology = sharedPartsOf(diagram);
  if (!topology) return tl::unexpected(topology.error());
  return writeLines(to, edgesOf(*diagram.input->given, diagram.diagram, *topology, systemOf(*diagram.input)),
                    format);
}

/// Writes pixels, ids or their place, by the extension.
Result<void> writeAs(ByteSink& to, const vorpipe_picture& picture, const std::string& extension) {
  static const Sites no_sites;
  const Image& image = picture.rendering.image;
  const PlacedInput* const input = picture.input.get();
  const PictureOutput output{input == nullptr ? no_sites : *input->sites, picture.options, &image, nullptr,
                             input == nullptr ? CoordinateSystem{} : input->domain.system};
  const auto lacks = [&](std::string_view what) {
    return inputError(fmt::format("{}: the picture has no {}", to.name(), what));
  };
  const bool of_place = extension != ".png" && extension != ".npy";
  if (const auto format = pictureFormatOf("picture" + extension); format && !(*format)->of_shapes) {
    if (of_place && input == nullptr) return lacks("domain, since it was read");
    if (!of_place && image.rgba.empty()) return lacks("pixels");
    return (*format)->write(to, output);
  }
  if (const auto format = idsFormatOf("ids" + extension)) {
    if (of_place && input == nullptr) return lacks("domain, since it was read");
    if (image.ids.empty()) return lacks("ids");
    return (*format)->write(to, output);
  }
  return inputError(fmt::format("{}: unknown kind of picture; known are .png, .pgw, {}", to.name(),
                                fmt::join(idsExtensions(), ", ")));
}

}  // namespace

vorpipe_code writeMoved(const MovedSites& moved, const char* format, vorpipe_write write, void* user) {
  const auto known = pointsFormatOf(std::string("sites.") + format);
  if (!known) return fail(known.error());
  auto sink = sinkOf(format, write, user);
  return codeOf(writeTo(sink, moved, **known));
}

vorpipe_code saveMoved(const MovedSites& moved, const char* path) {
  const auto known = pointsFormatOf(path);
  if (!known) return fail(known.error());
  return codeOf(writeFile(path, [&](ByteSink& to) { return writeTo(to, moved, **known); }));
}

vorpipe_code giveMoved(const MovedSites& moved, Surface surface, vorpipe_input** input) {
  auto made = inputOf(moved.input, moved.placed, moved.sites);
  made->surface = surface;
  *input = made.release();
  return VORPIPE_DONE;
}

vorpipe_code giveReport(const Report& report, vorpipe_report* to) {
  return codeOf(give(reportOf(report), to, "vorpipe_report"));
}

}  // namespace vorpipe::c

using namespace vorpipe;
using namespace vorpipe::c;

vorpipe_code vorpipe_diagram_write(const vorpipe_diagram* diagram, const char* format, vorpipe_write write,
                                   void* user) {
  return vorpipe_diagram_write_with(diagram, format, nullptr, write, user);
}

vorpipe_code vorpipe_diagram_save(const vorpipe_diagram* diagram, const char* path) {
  return vorpipe_diagram_save_with(diagram, path, nullptr);
}

vorpipe_code vorpipe_diagram_write_with(const vorpipe_diagram* diagram, const char* format,
                                        const vorpipe_write_options* options, vorpipe_write write,
                                        void* user) {
  if (diagram == nullptr) return missing("diagram");
  if (format == nullptr) return missing("format");
  if (write == nullptr) return missing("write");
  return guarded([&] {
    const auto given = taken(options, "vorpipe_write_options");
    if (!given) return fail(given.error());
    auto sink = sinkOf(format, write, user);
    if (diagram->space) return codeOf(writeInSpace(sink, *diagram, std::string("cells.") + format));
    const auto known = cellsFormatOf(std::string("cells.") + format);
    if (!known) return fail(known.error());
    return codeOf(writeAs(sink, *diagram, **known, *given));
  });
}

vorpipe_code vorpipe_diagram_save_with(const vorpipe_diagram* diagram, const char* path,
                                       const vorpipe_write_options* options) {
  if (diagram == nullptr) return missing("diagram");
  if (path == nullptr) return missing("path");
  return guarded([&] {
    const auto given = taken(options, "vorpipe_write_options");
    if (!given) return fail(given.error());
    if (diagram->space)
      return codeOf(writeFile(path, [&](ByteSink& to) { return writeInSpace(to, *diagram, path); }));
    const auto known = cellsFormatOf(path);
    if (!known) return fail(known.error());
    return codeOf(writeFile(path, [&](ByteSink& to) { return writeAs(to, *diagram, **known, *given); }));
  });
}

vorpipe_code vorpipe_diagram_write_edges(const vorpipe_diagram* diagram, const char* format,
                                         vorpipe_write write, void* user) {
  if (diagram == nullptr) return missing("diagram");
  if (format == nullptr) return missing("format");
  if (write == nullptr) return missing("write");
  return guarded([&] {
    const auto known = edgesFormatOf(std::string("edges.") + format);
    if (!known) return fail(known.error());
    auto sink = sinkOf(format, write, user);
    return codeOf(writeEdgesAs(sink, *diagram, **known));
  });
}

vorpipe_code vorpipe_diagram_save_edges(const vorpipe_diagram* diagram, const char* path) {
  if (diagram == nullptr) return missing("diagram");
  if (path == nullptr) return missing("path");
  return guarded([&] {
    const auto known = edgesFormatOf(path);
    if (!known) return fail(known.error());
    return codeOf(writeFile(path, [&](ByteSink& to) { return writeEdgesAs(to, *diagram, **known); }));
  });
}

vorpipe_code vorpipe_picture_write(const vorpipe_picture* picture, const char* format, vorpipe_write write,
                                   void* user) {
  if (picture == nullptr) return missing("picture");
  if (format == nullptr) return missing("format");
  if (write == nullptr) return missing("write");
  return guarded([&] {
    auto sink = sinkOf(format, write, user);
    return codeOf(writeAs(sink, *picture, std::string(".") + format));
  });
}

vorpipe_code vorpipe_picture_save(const vorpipe_picture* picture, const char* path) {
  if (picture == nullptr) return missing("picture");
  if (path == nullptr) return missing("path");
  return guarded([&] {
    return codeOf(writeFile(path, [&](ByteSink& to) { return writeAs(to, *picture, lowerExtension(path)); }));
  });
}

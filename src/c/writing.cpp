/// Results as files: to the caller, or to a path.
#include <fmt/core.h>

#include <algorithm>
#include <string>

#include "c/failure.h"
#include "c/handles.h"
#include "io/cells/cells_file.h"
#include "io/files/byte_sink.h"
#include "io/files/error.h"
#include "io/files/extension.h"
#include "io/files/output_file.h"
#include "io/pictures/npy_ids.h"
#include "io/pictures/png_file.h"

namespace vorpipe::c {
namespace {

CallbackSink sinkOf(std::string name, vorpipe_write write, void* user) {
  return {std::move(name),
          [write, user](std::string_view bytes) { return write(user, bytes.data(), bytes.size()) == 0; }};
}

Result<void> writeAs(ByteSink& to, const vorpipe_diagram& diagram, const CellsFormat& format) {
  if (format.detail > diagram.options.detail) {
    return inputError(
        fmt::format("{}: {} needs cells of more detail than these have", to.name(), format.extension));
  }
  return writeCells(to, {*diagram.sites, diagram.diagram}, format);
}

/// Pixels or ids, by the extension.
Result<void> writeAs(ByteSink& to, const vorpipe_picture& picture, const std::string& extension) {
  const Image& image = picture.rendering.image;
  const auto lacks = [&](std::string_view what) {
    return inputError(fmt::format("{}: the picture has no {}", to.name(), what));
  };
  if (extension == ".png") {
    if (image.rgba.empty()) return lacks("pixels");
    return writePng(to, image.width, image.height, image.rgba);
  }
  if (extension == ".npy") {
    if (image.ids.empty()) return lacks("ids");
    return writeNpyIds(to, image.width, image.height, image.ids);
  }
  return inputError(fmt::format("{}: unknown kind of picture; known are .png and .npy", to.name()));
}

/// Creates a file, lets `write` fill it, and puts it in place.
template <class Write>
Result<void> save(const std::string& path, const Write& write) {
  auto file = OutputFile::create(path);
  if (!file) return tl::unexpected(file.error());
  if (auto written = write(*file); !written) return written;
  return file->commit();
}

}  // namespace
}  // namespace vorpipe::c

using namespace vorpipe;
using namespace vorpipe::c;

vorpipe_code vorpipe_diagram_write(const vorpipe_diagram* diagram, const char* format, vorpipe_write write,
                                   void* user) {
  if (diagram == nullptr) return missing("diagram");
  if (format == nullptr) return missing("format");
  if (write == nullptr) return missing("write");
  return guarded([&] {
    const auto known = cellsFormatOf(std::string("cells.") + format);
    if (!known) return fail(known.error());
    auto sink = sinkOf(format, write, user);
    return codeOf(writeAs(sink, *diagram, **known));
  });
}

vorpipe_code vorpipe_diagram_save(const vorpipe_diagram* diagram, const char* path) {
  if (diagram == nullptr) return missing("diagram");
  if (path == nullptr) return missing("path");
  return guarded([&] {
    const auto known = cellsFormatOf(path);
    if (!known) return fail(known.error());
    return codeOf(save(path, [&](ByteSink& to) { return writeAs(to, *diagram, **known); }));
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
    return codeOf(save(path, [&](ByteSink& to) { return writeAs(to, *picture, lowerExtension(path)); }));
  });
}

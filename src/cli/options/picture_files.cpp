#include "cli/options/picture_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "base/try.h"
#include "cli/options/options.h"
#include "io/base/error.h"
#include "io/base/extension.h"

namespace vorpipe::cli {
namespace {

/// Parses a file and its format; that of `usual` if the name has no extension (/dev/stdout).
template <class File, class FormatOf>
Parsed<File> parseAs(std::string_view text, const FormatOf& format_of, const std::string& usual) {
  VORPIPE_VAR(path, parseFile(text, ""));
  const auto format = format_of(lowerExtension(path).empty() ? usual : path);
  if (!format) return tl::unexpected(format.error().message);
  return File{std::move(path), *format};
}

Parsed<PictureFile> parsePicture(std::string_view text) {
  if (text == "-") return PictureFile{std::string(standard_output), nullptr};
  return parseAs<PictureFile>(text, pictureFormatOf, "x.png");
}

Parsed<IdsFile> parseIds(std::string_view text) { return parseAs<IdsFile>(text, idsFormatOf, "x.npy"); }

}  // namespace

bool PictureFiles::needCells() const {
  return std::ranges::any_of(pictures, [](const PictureFile& file) { return file.format->of_shapes; });
}

bool PictureFiles::needPixels() const {
  const auto of_pixels = [](const PictureFile& file) { return !file.format->of_shapes; };
  return !needCells() || !ids.path.empty() || std::ranges::any_of(pictures, of_pixels);
}

void addPictureFiles(Options& options, PictureFiles& files) {
  const auto extensions = pictureExtensions();
  addRepeatable(
      options, "-o", "FILE",
      fmt::format(
          "the picture, by the extension: {} (.pgw: where a .png lies on a map); - is standard output; "
          "repeatable",
          fmt::join(extensions, ", ")),
      parsePicture, [to = &files.pictures](PictureFile file) { to->push_back(std::move(file)); },
      {{}, {extensions.begin(), extensions.end()}});
  const auto ids = idsExtensions();
  addParsed(
      options, "--ids", files.ids, "FILE",
      "the site of each pixel: uint32, row 0 at the top, 4294967295 where there is none; .npy, or .tif, "
      "a GeoTIFF",
      parseIds, {{}, {ids.begin(), ids.end()}});
}

Result<void> nameStandardOutput(PictureFiles& files, const std::string& kind) {
  for (PictureFile& file : files.pictures) {
    if (file.format != nullptr) continue;
    const auto format = pictureFormatOf(fmt::format("x.{}", kind.empty() ? "png" : kind));
    if (!format) {
      return inputError(fmt::format("--format: {} is no kind of picture; known are {}", kind,
                                    fmt::join(pictureExtensions(), ", ")));
    }
    file.format = *format;
  }
  return {};
}

}  // namespace vorpipe::cli

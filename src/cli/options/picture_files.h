/// The output files of render, and their formats.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/options/command_line.h"
#include "cli/options/parse.h"
#include "io/pictures/picture_file.h"

namespace vorpipe::cli {

struct PictureFile {
  std::string path;
  const PictureFormat* format = nullptr;  ///< null for standard output until nameStandardOutput()
};

struct IdsFile {
  std::string path;  ///< empty: not requested
  const IdsFormat* format = nullptr;
};

/// The outputs of render besides --stats.
struct PictureFiles {
  std::vector<PictureFile> pictures;
  IdsFile ids;

  [[nodiscard]] bool needPixels() const;
  [[nodiscard]] bool needCells() const;
};

/// -o, --ids
void addPictureFiles(Options& options, PictureFiles& files);

/// Sets the format of `-o -`, standard output: `kind`, the extension without its dot from --format, or PNG.
/// Error (input): `kind` is no format of pictures.
Result<void> nameStandardOutput(PictureFiles& files, const std::string& kind);

}  // namespace vorpipe::cli

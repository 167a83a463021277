/// The files that render writes, and their kinds.
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
  std::string path;  ///< empty: none is asked for
  const IdsFormat* format = nullptr;
};

/// What render writes besides --stats.
struct PictureFiles {
  std::vector<PictureFile> pictures;
  IdsFile ids;

  [[nodiscard]] bool needPixels() const;
  [[nodiscard]] bool needCells() const;
};

/// -o, --ids
void addPictureFiles(Options& options, PictureFiles& files);

/// Has `-o -` go to standard output, as `kind`, an extension without its dot, which --format names, or as
/// PNG. Error (input): it is no kind of picture.
Result<void> nameStandardOutput(PictureFiles& files, const std::string& kind);

}  // namespace vorpipe::cli

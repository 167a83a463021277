/// Names that options take.
#include <fmt/core.h>

#include <string>
#include <vector>

#include "c/array.h"
#include "c/vorpipe_c.h"
#include "io/cells/cells_file.h"
#include "vorpipe.h"

namespace vorpipe::c {
namespace {

/// Formats are extensions without their dot.
std::vector<std::string> cellsFormats() {
  std::vector<std::string> names;
  for (const auto extension : cellsExtensions()) names.emplace_back(extension.substr(1));
  return names;
}

const char* nameOf(vorpipe_list list, std::size_t index) {
  static const auto backends = backendNames(), maps = colormaps(), formats = cellsFormats(),
                    features = featureNames(), limits = limitNames();
  switch (list) {
    case VORPIPE_BACKENDS:
      return textAt(backends, index);
    case VORPIPE_COLORMAPS:
      return textAt(maps, index);
    case VORPIPE_CELLS_FORMATS:
      return textAt(formats, index);
    case VORPIPE_FEATURES:
      return textAt(features, index);
    case VORPIPE_LIMITS:
      return textAt(limits, index);
    default:
      return nullptr;
  }
}

}  // namespace
}  // namespace vorpipe::c

const char* vorpipe_version() {
  // A string of the program's, which ends with a zero.
  return vorpipe::version().data();
}

const char* vorpipe_name(vorpipe_list list, size_t index) {
  try {
    return vorpipe::c::nameOf(list, index);
  } catch (...) {
    return nullptr;  // no memory
  }
}

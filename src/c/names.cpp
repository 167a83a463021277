/// Names accepted by options.
#include <fmt/core.h>

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "c/array.h"
#include "c/vorpipe_c.h"
#include "io/cells/cells_file.h"
#include "io/cells/edges_file.h"
#include "io/pictures/picture_file.h"
#include "io/sites/sites_file.h"
#include "vorpipe.h"
#include "vorpipe/fluid.h"

namespace vorpipe::c {
namespace {

/// Formats are extensions without their dot.
std::vector<std::string> formats(std::initializer_list<std::vector<std::string_view>> lists) {
  std::vector<std::string> names;
  for (const auto& extensions : lists) {
    for (const std::string_view extension : extensions) names.emplace_back(extension.substr(1));
  }
  return names;
}

const char* nameOf(vorpipe_list list, std::size_t index) {
  static const auto backends = backendNames(), maps = colormaps(), features = featureNames(),
                    limits = limitNames(), cells = formats({cellsExtensions()}),
                    sites = formats({sitesExtensions()}), edges = formats({edgesExtensions()}),
                    pictures = formats({pictureExtensions(), idsExtensions()}), cases = fluidCaseNames();
  switch (list) {
    case VORPIPE_BACKENDS:
      return textAt(backends, index);
    case VORPIPE_COLORMAPS:
      return textAt(maps, index);
    case VORPIPE_CELLS_FORMATS:
      return textAt(cells, index);
    case VORPIPE_FEATURES:
      return textAt(features, index);
    case VORPIPE_LIMITS:
      return textAt(limits, index);
    case VORPIPE_SITES_FORMATS:
      return textAt(sites, index);
    case VORPIPE_EDGES_FORMATS:
      return textAt(edges, index);
    case VORPIPE_PICTURE_FORMATS:
      return textAt(pictures, index);
    case VORPIPE_FLUID_CASES:
      return textAt(cases, index);
    default:
      return nullptr;
  }
}

}  // namespace
}  // namespace vorpipe::c

const char* vorpipe_version() {
  // A string in the program itself, zero-terminated.
  return vorpipe::version().data();
}

const char* vorpipe_name(vorpipe_list list, size_t index) {
  try {
    return vorpipe::c::nameOf(list, index);
  } catch (...) {
    return nullptr;  // no memory
  }
}

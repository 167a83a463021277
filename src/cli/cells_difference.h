/// Compares two .npz files of cells, in the plane or in space.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "vorpipe.h"

namespace vorpipe::cli {

struct CellsDifference {
  std::string agreement, difference;  ///< in words; `difference` is empty if the two agree
  nlohmann::ordered_json found;       ///< the counts, and the first sites that differ
};

/// Errors (input): a file is no .npz of whole cells; one is of the plane, the other of space; they have
/// different numbers of sites.
Result<CellsDifference> compareCellsFiles(const std::string& a, const std::string& b);

}  // namespace vorpipe::cli

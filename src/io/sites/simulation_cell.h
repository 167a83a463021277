/// Cells of simulations, as files of sites in space name them.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/line_reader.h"
#include "io/sites/sites_file.h"
#include "vorpipe.h"

namespace vorpipe {

/// What the second line of a frame of .xyz says.
struct FrameComment {
  std::vector<std::string> names{};  ///< of the columns, positions being x, y and z; none if it names none
  std::size_t names_at = 1;          ///< column of that line
  std::optional<SimulationCell> cell{};
};

/// Reads the comment of a frame, the last line of `lines`: Properties, Lattice, Origin and pbc of an extended
/// xyz, where it has some. Error (input): one of them is wrong, with its column.
Result<FrameComment> readFrameComment(const LineReader& lines, std::string_view comment);

/// Whether a line is the comment of an extended xyz.
bool isExtendedComment(std::string_view line);

/// The cell between two bounds on each axis that is tilted by xy, xz and yz.
SimulationCell tiltedCell(const std::array<double, 3>& low, const std::array<double, 3>& high,
                          const std::array<double, 3>& tilt);

/// The place of fractions along the vectors of a cell.
Point3 placeIn(const SimulationCell& cell, const std::array<double, 3>& fractions);

/// The cell as a box; none if it is not upright.
std::optional<Box3> boxOf(const SimulationCell& cell);

/// The axes along which it repeats itself: "x, y".
std::string periodsOf(const SimulationCell& cell);

}  // namespace vorpipe

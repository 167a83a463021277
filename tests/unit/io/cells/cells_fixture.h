/// Cells made by hand for the tests of their files.
#pragma once

#include <cmath>
#include <string>

#include "io/base/output_file.h"
#include "io/cells/cells_file.h"
#include "unit/fixtures/temporary_directory.h"

namespace vorpipe::test {

inline constexpr double third = 1.0 / 3, tenth = 0.1;

inline Sites someSites() { return {{0.25, 0.5, 0.25, 7, 0.5}, {0.5, tenth / 2, 0.5, 0.5, 0.75}, {}}; }

/// The domain 0,0,1,1: site 0 has x <= third, sites 1 and 4 the rest below and above tenth. Site 2 is a
/// duplicate of site 0, site 3 is empty.
inline Diagram someCells() {
  Diagram cells;
  cells.status = {Status::ok, Status::ok, Status::duplicate, Status::empty, Status::ok};
  cells.owner = {0, 1, 0, 3, 4};
  cells.area = {third, (1 - third) * tenth, 0, 0, (1 - third) * (1 - tenth)};
  cells.perimeter = {2 + 2 * third, 2 * (1 - third + tenth), 0, 0, 2 * (1 - third + 1 - tenth)};
  cells.centroid = {{third / 2, 0.5}, {2 * third, tenth / 2}, {0.25, 0.5}, {7, 0.5}, {2 * third, 0.55}};
  cells.second_moments = {{1, 2, 3}, {4, 5, 6}, {0, 0, 0}, {0, 0, 0}, {7, 8, 9}};
  cells.cell_offsets = {0, 5, 9, 9, 9, 13};
  cells.vertices = {{0, 0},     {third, 0}, {third, tenth}, {third, 1},     {0, 1},  //
                    {third, 0}, {1, 0},     {1, tenth},     {third, tenth},          //
                    {1, tenth}, {1, 1},     {third, 1},     {third, tenth}};
  cells.neighbors = {wall_ymin, 1, 4,         wall_ymax, wall_xmin, wall_ymin, wall_xmax,
                     4,         0, wall_xmax, wall_ymax, 0,         1};
  cells.edge_lengths = {third,     tenth, 0.9, third,     1,   2 * third, tenth,
                        2 * third, tenth, 0.9, 2 * third, 0.9, 2 * third};
  cells.triangles = {{0, 1, 4}};
  return cells;
}

/// Site 0 has a square with a hole, which is the cell of site 1, and a triangle; site 2 is empty.
inline Diagram cellsInPieces() {
  Diagram cells;
  cells.status = {Status::ok, Status::ok, Status::empty};
  cells.owner = {0, 1, 2};
  cells.area = {15.5, 1, 0};
  cells.perimeter = {22 + std::sqrt(2.0), 4, 0};
  cells.centroid = {{2.25, 2}, {1.5, 1.5}, {9, 9}};
  cells.second_moments.resize(3);
  cells.cell_offsets = {0, 11, 15, 15};
  cells.vertices = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 1}, {1, 2}, {2, 2}, {2, 1},  //
                    {5, 0}, {6, 0}, {5, 1}, {1, 1}, {2, 1}, {2, 2}, {1, 2}};
  cells.neighbors = {-5, -5, -5, -5, 1, 1, 1, 1, -5, -5, -5, 0, 0, 0, 0};
  cells.edge_lengths.assign(15, 1);
  cells.ring_starts = {0, 4, 8, 11};
  return cells;
}

/// someCells() of a domain that repeats itself, with a density.
inline Diagram cellsWithShiftsAndMass() {
  Diagram cells = someCells();
  cells.neighbor_shifts.resize(cells.neighbors.size());
  cells.neighbor_shifts[0] = {0, -1};
  cells.neighbor_shifts[12] = {1, 2};
  cells.mass = {tenth, 2, 0, 0, 3};
  cells.mass_centroid = cells.centroid;
  return cells;
}

inline Sites sitesInPieces() { return {{3, 1.5, 9}, {3, 1.5, 9}, {}}; }

class CellsFile : public InTemporaryDirectory {
 protected:
  /// Writes cells as a file of that name and returns its bytes.
  std::string written(const std::string& name, const Sites& sites, const Diagram& cells) const {
    const auto format = cellsFormatOf(name);
    auto file = OutputFile::create(path(name));
    if (!format || !file) {
      ADD_FAILURE() << name << " cannot be written";
      return "";
    }
    auto result = writeCells(*file, {sites, cells}, **format);
    if (result) {
      result = file->commit();
    }
    EXPECT_TRUE(result) << result.error().message;
    return contents(path(name));
  }
  std::string written(const std::string& name) const { return written(name, someSites(), someCells()); }
};

}  // namespace vorpipe::test

/// Cells as data, their comparison and their check.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "vorpipe/result.h"
#include "vorpipe/run.h"
#include "vorpipe/sites.h"
#include "vorpipe/wall.h"

namespace vorpipe {

/// Which parts of a Diagram are wanted; what is not costs no time.
enum class Detail : std::uint8_t {
  measures,    ///< status, owner, area, centroid, cell_offsets, neighbors
  polygons,    ///< and perimeter, second moments, vertices, edge lengths
  everything,  ///< and triangles
};

struct CellsOptions {
  Box domain;         ///< what cells are clipped to
  Outline outline{};  ///< what cells are clipped to besides, inside the domain
  Periodic periodic = Periodic::none;
  Density density{};  ///< over the domain
  SearchOptions search;
  Detail detail = Detail::everything;
  Progress progress;  ///< may be empty
};

/// Refuses what every run over these sites would, so that none needs to be begun: a domain that is no
/// rectangle, whose area is not between 1e-301 and 1e301, or one of whose sides is less than 1e-12 of the
/// other; no sites, or too many; a coordinate or a weight that is not finite or too large for the domain; an
/// outline that is no polygon; a density that is none; a search that does not know weights. Only sites too
/// near to each other, and too far from a periodic domain, are found later. Errors (input).
Result<void> checkInput(const Sites& sites, const CellsOptions& options, int threads = 0);

class Cell;          // cell.h
class CellIterator;  // cell.h

/// Cells as data, in input order and in the caller's units: one record for each site, whatever
/// happened to it. Cell i has the vertices cell_offsets[i] .. cell_offsets[i + 1] - 1, counter-
/// clockwise; edge k of a cell runs from its vertex k to the next and belongs to its neighbor k, so
/// that one table of offsets serves vertices, neighbors and edge lengths.
/// An edge shorter than 1e-6 of the distance between its two sites, or of the domain's shorter side if that
/// is less, is a tie: neither cell has it, but where ten and more of them stand in a row.
///
/// In a domain with an outline a cell may have several rings, outer ones counter-clockwise, each followed
/// by its holes, clockwise; a neighbor may have several edges. Where an axis is periodic, a cell is whole,
/// around its site, as wrapped() places it, and may reach beyond the domain; it may neighbor itself.
struct Diagram {
  std::vector<Status> status;
  std::vector<std::uint32_t> owner;  ///< the site that owns the cell: itself unless a duplicate
  std::vector<double> area, perimeter;
  std::vector<Point> centroid;                        ///< of the cell; the site itself where there is no cell
  std::vector<std::array<double, 3>> second_moments;  ///< about the centroid: integrals of xx, xy, yy
  std::vector<std::uint64_t> cell_offsets;            ///< size: sites + 1
  std::vector<Point> vertices;
  std::vector<std::int64_t> neighbors;  ///< indices of sites, or walls, as isWall() tells
  std::vector<double> edge_lengths;
  /// Of a periodic domain, one for each of `neighbors`: the image of the neighbor that the cell meets stands
  /// that many widths and heights of the domain from the neighbor itself, as wrapped() places it.
  std::vector<std::array<std::int32_t, 2>> neighbor_shifts;
  /// Of a domain with an outline: where in `vertices` each ring begins, ascending; it ends where the next one
  /// or the cell does. Empty without an outline: every cell is one ring.
  std::vector<std::uint64_t> ring_starts;
  std::vector<double> mass;          ///< of a density, by site: its integral over the cell
  std::vector<Point> mass_centroid;  ///< by site: center of the mass; the centroid where there is no mass
  /// The Delaunay triangulation of all sites but duplicates, whatever the domain: counter-clockwise from the
  /// lowest index, ties triangulated from the lowest index; empty if all sites lie on a line. With weights,
  /// the regular triangulation, without hidden sites. Empty where the domain is periodic.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  Report report;

  /// Sites, and so cells; each of them in place. `for (const Cell cell : diagram)` goes through all.
  [[nodiscard]] std::size_t size() const { return status.size(); }
  [[nodiscard]] Cell cell(std::size_t site) const;
  [[nodiscard]] CellIterator begin() const;
  [[nodiscard]] CellIterator end() const;
};

/// The sum of the cells' areas, without what adding up would round off.
double areaSum(const Diagram& diagram);

/// Areas of one cell may differ by this part of the larger and this part of the mean cell.
inline constexpr double area_slack_of_cell = 1e-5, area_slack_of_mean = 1e-9;

/// One site whose cells differ in two diagrams, and how.
struct CellDifference {
  std::uint32_t site = 0;
  bool status = false, neighbors = false, area = false;  ///< status stands for the owner as well
  double area_a = 0, area_b = 0;
};

struct CellsDiff {
  std::uint64_t equal = 0;                               ///< sites without a difference
  std::uint64_t statuses = 0, neighbors = 0, areas = 0;  ///< sites that differ in each
  std::uint32_t worst_site = 0;                          ///< whose areas differ most, by what is allowed
  double worst_area = 0;                                 ///< that difference, as a part of what is allowed
  std::vector<CellDifference> first;                     ///< the first 10 sites that differ
  [[nodiscard]] bool agree() const { return statuses == 0 && neighbors == 0 && areas == 0; }
};

/// Compares two diagrams of the same sites and domain: status and owner of every site, the sets of its
/// neighbors, walls and shifts included, and its area. Error (input): they have different numbers of sites.
Result<CellsDiff> diffCells(const Diagram& a, const Diagram& b);

/// Verifies what is promised about cells, with nothing of what computes them: statuses and owners, each
/// record at its site's place, areas that add up to the domain's (to 1e-12), neighbors that name each
/// other with the same edge, closed convex polygons, counter-clockwise, on the bisectors of their
/// neighbors, Euler's formula for cells and triangles, and the nearest sites of sampled places. `options`
/// are those of the run; parts that its detail leaves out are not looked at. Returns one line for each
/// promise that is broken, which begins with its name. Error (device): out of memory.
Result<std::vector<std::string>> check(const Sites& sites, const CellsOptions& options,
                                       const Diagram& diagram, int threads = 0);

}  // namespace vorpipe

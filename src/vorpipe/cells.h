/// Cells as data, how to compare them and how to check them.
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

/// Which parts of a Diagram to compute; parts left out cost no time.
enum class Detail : std::uint8_t {
  measures,    ///< status, owner, area, centroid, cell_offsets, neighbors
  polygons,    ///< and perimeter, second moments, vertices, edge lengths
  everything,  ///< and triangles
};

struct CellsOptions {
  Box domain;         ///< what cells are clipped to
  Outline outline{};  ///< also clips cells, inside the domain
  Periodic periodic = Periodic::none;
  Density density{};  ///< over the domain
  SearchOptions search;
  Detail detail = Detail::everything;
  Progress progress;  ///< may be empty
  /// Sites are degrees of longitude and latitude, and cells are those on the sphere (globe.md): domain,
  /// outline, period and density are not used.
  bool globe = false;
};

/// Refuses input that every run over these sites would refuse, so that no run need begin. It refuses: a
/// domain that is no rectangle, whose area is not between 1e-301 and 1e301, or one side of which is less than
/// 1e-12 of the other; no sites, or too many; a coordinate or weight that is not finite or too large for the
/// domain; an invalid outline; an invalid density; weights with a search that does not support them. Only
/// sites too close to each other, or too far from a periodic domain, are found later. Errors (input).
Result<void> checkInput(const Sites& sites, const CellsOptions& options, int threads = 0);

class Cell;          // cell.h
class CellIterator;  // cell.h

/// Cells as data, in input order and in the caller's units: one record for each site, whatever its status.
/// Cell i has the vertices cell_offsets[i] .. cell_offsets[i + 1] - 1, counter-clockwise. Edge k of a cell
/// runs from its vertex k to the next and belongs to its neighbor k: one table of offsets serves vertices,
/// neighbors and edge lengths. An edge is a tie if it is shorter than 1e-6 of the distance between its two
/// sites, or of the domain's shorter side if that is less. Neither cell has a tie as an edge, except where
/// ten or more ties follow each other in a row.
///
/// In a domain with an outline a cell may have several rings: outer ones counter-clockwise, each followed by
/// its holes, clockwise. A neighbor may then share several edges with it. Where an axis is periodic, a cell
/// is whole, around its site as wrapped() places it; it may reach beyond the domain and may neighbor itself.
struct Diagram {
  std::vector<Status> status;
  std::vector<std::uint32_t> owner;  ///< the site that owns the cell: itself unless a duplicate
  std::vector<double> area, perimeter;
  std::vector<double> solid_angle;                    ///< on the globe, by site: steradians
  std::vector<Point> centroid;                        ///< of the cell; the site itself if it has no cell
  std::vector<std::array<double, 3>> second_moments;  ///< about the centroid: integrals of xx, xy, yy
  std::vector<std::uint64_t> cell_offsets;            ///< size: sites + 1
  std::vector<Point> vertices;
  std::vector<std::int64_t> neighbors;  ///< indices of sites, or walls; see isWall()
  std::vector<double> edge_lengths;
  /// For a periodic domain, one per entry of `neighbors`: the image that the cell meets is offset from the
  /// neighbor itself, as wrapped() places it, by that many widths and heights of the domain.
  std::vector<std::array<std::int32_t, 2>> neighbor_shifts;
  /// For a domain with an outline: where in `vertices` each ring begins, ascending; a ring ends where the
  /// next ring begins or the cell ends. Empty without an outline: every cell is one ring.
  std::vector<std::uint64_t> ring_starts;
  std::vector<double> mass;          ///< with a density, by site: its integral over the cell
  std::vector<Point> mass_centroid;  ///< by site: center of mass; the centroid if there is no mass
  /// The Delaunay triangulation of all sites except duplicates, whatever the domain. Triangles are
  /// counter-clockwise from the lowest index; ties are triangulated from the lowest index. Empty if all sites
  /// lie on a line. With weights, it is the regular triangulation, without hidden sites. Empty if the domain
  /// is periodic.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  Report report;

  /// Number of sites, and so of cells; access to each cell. `for (const Cell cell : diagram)` visits all.
  [[nodiscard]] std::size_t size() const { return status.size(); }
  [[nodiscard]] Cell cell(std::size_t site) const;
  [[nodiscard]] CellIterator begin() const;
  [[nodiscard]] CellIterator end() const;
};

/// The sum of the cells' areas, without the rounding error of summation.
double areaSum(const Diagram& diagram);

/// The areas of one cell may differ by this fraction of the larger, plus this fraction of the mean cell area.
inline constexpr double area_slack_of_cell = 1e-5, area_slack_of_mean = 1e-9;

/// One site whose cells differ in two diagrams, and how.
struct CellDifference {
  std::uint32_t site = 0;
  bool status = false, neighbors = false, area = false;  ///< status covers the owner, too
  double area_a = 0, area_b = 0;
};

struct CellsDiff {
  std::uint64_t equal = 0;                               ///< sites without a difference
  std::uint64_t statuses = 0, neighbors = 0, areas = 0;  ///< sites that differ in each
  std::uint32_t worst_site = 0;  ///< the site whose areas differ most, relative to the allowed difference
  double worst_area = 0;         ///< that difference, as a fraction of the allowed one
  std::vector<CellDifference> first;  ///< the first 10 sites that differ
  [[nodiscard]] bool agree() const { return statuses == 0 && neighbors == 0 && areas == 0; }
};

/// Compares two diagrams of the same sites and domain. For every site it compares status and owner, the sets
/// of neighbors, with walls and shifts, and the area. Error (input): the numbers of sites differ.
Result<CellsDiff> diffCells(const Diagram& a, const Diagram& b);

/// Verifies the promises about cells, without any of the code that computes them. It checks: statuses and
/// owners; each record at its site's index; areas that add up to the domain's (to 1e-12); neighbors that name
/// each other with the same edge; closed convex polygons, counter-clockwise, on the bisectors of their
/// neighbors; Euler's formula for cells and triangles; and the nearest sites of sampled places. `options` are
/// those of the run; parts that its detail leaves out are skipped. Returns one line for each broken promise,
/// beginning with its name. Error (device): out of memory.
Result<std::vector<std::string>> check(const Sites& sites, const CellsOptions& options,
                                       const Diagram& diagram, int threads = 0);

}  // namespace vorpipe

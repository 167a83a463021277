/// Cells in space: Voronoi and power diagrams of sites with three coordinates, in a box.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vorpipe/maps.h"
#include "vorpipe/result.h"
#include "vorpipe/run.h"
#include "vorpipe/sites.h"
#include "vorpipe/wall.h"

namespace vorpipe {

/// An axis-parallel box; valid when finite and xmin < xmax, ymin < ymax, zmin < zmax.
struct Box3 {
  double xmin, ymin, zmin, xmax, ymax, zmax;
};

/// Three vectors by which sites in space repeat; of no plane.
struct Lattice {
  Point3 a, b, c;
};

/// Sites in the caller's order.
using Sites3 = std::vector<Point3>;

/// The default domain of sites: the box of at least one site, grown on every side by 5 % of its longest side,
/// or by 0.5 if all sites are equal. It grows more where that would vanish beside the coordinates. It is not
/// finite if the sites extend too far.
Box3 domainOf(std::span<const Point3> sites, const Margin& margin = {});

/// Which parts of a Diagram3 to compute; parts left out cost no time.
enum class Detail3 : std::uint8_t {
  measures,   ///< status, owner, volume, surface, centroid, face_offsets, neighbors, face_areas
  polyhedra,  ///< and second moments, vertices, faces as rings of vertices
};

struct Cells3Options {
  Box3 domain;  ///< what cells are clipped to
  Detail3 detail = Detail3::polyhedra;
  Progress progress;  ///< may be empty
  /// Of each site, or empty: the cell of site i is where |x - p_i|^2 - w_i is least. As Sites::weight in the
  /// plane; a radius is the weight of its square.
  std::span<const double> weights{};
  /// The axes along which the domain repeats: x, y, z. There are no walls across them, and sites outside are
  /// images of sites inside.
  std::array<bool, 3> periodic{};
  /// Or sites repeat by these vectors: then there is no domain.
  std::optional<Lattice> lattice{};

  [[nodiscard]] bool repeats() const { return lattice || periodic[0] || periodic[1] || periodic[2]; }
};

/// Refuses input that every run over these sites would refuse: a domain that is no box, whose volume is not
/// between 1e-301 and 1e301, or one side of which is less than 1e-12 of another; no sites, or too many; a
/// coordinate or a weight that is not finite or too large for the domain; weights that are not as many as the
/// sites. Errors (input).
Result<void> checkInput(std::span<const Point3> sites, const Cells3Options& options, int threads = 0);

/// Cells as data, in input order and in the caller's units: one record for each site, whatever its status.
/// Cell i has the faces face_offsets[i] .. face_offsets[i + 1] - 1, in ascending order of their neighbors;
/// each is a ring of vertices, counter-clockwise seen from outside. Both cells of a face have the same
/// vertices in it; of sites that repeat, each of its own where the sites lie in different periods.
///
/// An edge is a tie if it is not longer than 1e-6 of the least distance between two of the sites around it
/// (from a wall: of the domain's shortest side). The ends of a tie are one vertex. A face that is left with
/// fewer than three vertices is no face of either cell. So a cubic lattice has cells of 6 faces. A cell that
/// is left without faces is `empty`.
struct Diagram3 {
  std::vector<Status> status;
  std::vector<std::uint32_t> owner;  ///< the site that owns the cell: itself unless a duplicate
  std::vector<double> volume, surface;
  std::vector<Point3> centroid;                       ///< of the cell; the site itself if it has no cell
  std::vector<std::array<double, 6>> second_moments;  ///< about the centroid: xx, yy, zz, yz, xz, xy
  std::vector<std::uint64_t> face_offsets;            ///< size: sites + 1
  std::vector<std::int64_t> neighbors;                ///< by face: index of a site, or a wall; see isWall()
  std::vector<double> face_areas;
  /// By face, of sites that repeat: the neighbor is the image of its site moved by that many sides of the
  /// domain, or vectors of the lattice. Faces of one neighbor are ordered by them.
  std::vector<std::array<std::int32_t, 3>> neighbor_shifts;
  std::vector<std::uint64_t> face_vertex_offsets;  ///< by face: where its ring begins; size: faces + 1
  std::vector<std::uint32_t> face_vertices;        ///< indices of vertices
  std::vector<Point3> vertices;                    ///< each once, whatever the number of its cells
  std::vector<std::uint64_t> vertex_site_offsets;  ///< size: vertices + 1
  std::vector<std::int64_t> vertex_sites;          ///< the sites and walls that meet in each vertex
  /// Number of cells that are too thin to have four faces: they are ok, with volume and neighbors, but their
  /// faces are no polyhedron.
  std::uint64_t flat = 0;
  Report report;

  [[nodiscard]] std::size_t size() const { return status.size(); }
};

/// The sum of the cells' volumes, without the rounding error of summation.
double volumeSum(const Diagram3& diagram);

/// Generators of sites in the unit cube; the same seed gives the same sites on every platform.
enum class Pattern3 : std::uint8_t {
  random,    ///< white noise
  jitter,    ///< cubic lattice, each site moved at random inside its own cube
  clusters,  ///< 200 normal clusters of different sizes, and white noise for a tenth of the sites
  sphere,    ///< random on a sphere of radius 0.4 about the center
  cubic,     ///< lattices of k^3 cells, with 1, 2, 4, 8 and 8 sites in each
  bcc,
  fcc,
  diamond,
  a15,
  hcp,  ///< hexagonal close packing, of as many whole layers and rows as the cube holds
};

/// Returns about n sites of a pattern (exactly n except for lattices), n >= 1. Sites of lattices do not
/// depend on seed.
Sites3 generate(Pattern3 pattern, std::uint64_t n, std::uint64_t seed);

/// The same over a whole box, whose sides are finite and positive. Lattices, and the cubes of `jitter`, are
/// as nearly cubic as whole numbers of their cells along the three axes allow; the radius of the sphere is
/// 0.4 of the shortest side.
Sites3 generate(Pattern3 pattern, std::uint64_t n, std::uint64_t seed, const Box3& box);

/// The same checks as check() of the plane, for cells in space, without any of the code that computes them:
/// statuses and owners; volumes that add up to the domain's (to 1e-12); area vectors of each cell that add up
/// to zero; neighbors that name each other with the same area and ring; Euler's formula; vertices at equal
/// distance from their sites, with none nearer; and the nearest sites of sampled places. Returns one line for
/// each broken promise, beginning with its name.
Result<std::vector<std::string>> check(std::span<const Point3> sites, const Cells3Options& options,
                                       const Diagram3& diagram, int threads = 0);

/// Compares two diagrams of the same sites and domain. For every site it compares status and owner, the sets
/// of neighbors, and the volume. Error (input): the numbers of sites differ.
struct Cells3Diff {
  std::uint64_t equal = 0;
  std::uint64_t statuses = 0, neighbors = 0, volumes = 0;  ///< sites that differ in each
  std::vector<std::uint32_t> first;                        ///< the first 10 sites that differ
  [[nodiscard]] bool agree() const { return statuses == 0 && neighbors == 0 && volumes == 0; }
};
Result<Cells3Diff> diffCells(const Diagram3& a, const Diagram3& b);

}  // namespace vorpipe

/// Places, signs and measures of one cell, several vertices or edges side by side.
#pragma once

#include <cstddef>
#include <cstdint>

namespace vorpipe::space {

/// A cell with its faces, vertices and edges in arrays that have room for 8 more of each. Everything is
/// relative to the site. A face lies in the plane p . n = h: n is the place of another site, h half of its
/// square, with weights and of what it is lighter by; or a wall's normal and distance. A vertex has three
/// faces, counter-clockwise seen from outside. An edge lies between faces a and b: from the vertex where b
/// follows a to the one where a follows b.
struct CornerJob {
  std::size_t faces, vertices, edges;
  const double *nx, *ny, *nz, *h;
  const double* h_size;                   ///< with weights: half the magnitudes of h's two parts; else null
  double* h_around;                       ///< with weights: room by face
  const double* distance;                 ///< by face: to the site, or for a wall the box's shortest side
  const std::int32_t* corner[3];          ///< by vertex: its faces
  const std::int32_t *a, *b, *from, *to;  ///< by edge: its faces and vertices
  double tie;                             ///< edges of this part of the least distance are ties
  bool measure;                           ///< whether to compute what is marked so
  bool moments;                           ///< whether to compute second moments, too

  // What is found.
  double *x, *y, *z;         ///< by vertex: its place
  double* error;             ///< by vertex: no less than that of its place, with the rounding of a difference
  std::uint8_t* turned;      ///< by vertex: 0 if its orientation is proved to be positive
  std::uint8_t* unproved;    ///< by edge: 0 if its length is proved to be positive
  bool unsure;               ///< some vertex is turned, or too badly conditioned for measures
  bool tied;                 ///< some edge may be a tie
  double* twice_area;        ///< measured, by face: twice its area, times the length of n
  double volume, surface;    ///< measured
  double second_moments[6];  ///< measured with moments, about the centroid: xx, yy, zz, yz, xz, xy
  double centroid[3];        ///< measured
};

/// Where a vertex is worse conditioned, its place is not good enough for measures, and its edges are not
/// proved.
constexpr double worst_condition = 1e4;

using FindCorners = void (*)(CornerJob& job);

/// The widest that the processor has. VORPIPE_LANES limits it. All give the same bits.
FindCorners findCorners();

}  // namespace vorpipe::space

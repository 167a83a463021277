/// The other programs that compute cells in space, each in a file of its own, as its documentation says to
/// use it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bench/taken.h"
#include "vorpipe.h"

namespace vorpipe::test {

/// Sites in the cube [0, side]^3, no two of which are equal. Neighbors are about 1 apart: Voro++ compares
/// lengths with constants.
struct SpaceInput {
  Sites3 sites;
  double side;
};

/// Cells one after the other, as they are found, with what was wanted of them.
struct CellsInOrder {
  std::vector<int> site;
  std::vector<double> volume, surface;
  std::vector<Point3> centroid;
  std::vector<std::size_t> faces_end;  ///< of each cell, in the lists of faces
  std::vector<int> neighbors;          ///< of each face: a site, or -1 to -6, a wall
  std::vector<double> face_areas;
  std::vector<double> vertices;    ///< with polyhedra: x, y and z of each, cell by cell
  std::vector<int> face_vertices;  ///< with polyhedra: for each face their number, and which of the cell
};

/// The time counts from coordinates as the peer takes them to results in memory; not what frees them.
struct MeasuredInSpace {
  Taken taken;
  std::vector<CellsInOrder> parts;  ///< of each thread
};

struct TriangulatedInSpace {
  Taken taken;
  std::size_t tetrahedra;  ///< those whose circumcenter is in the cube
};

struct SpacePeer {
  std::string name;     ///< as `--peers` takes it
  std::string what;     ///< of the peer is measured
  std::string version;  ///< of its package
  bool threaded;        ///< else it takes one thread
  /// Empty: it has no such job.
  std::function<Result<TriangulatedInSpace>(const SpaceInput&, int threads)> triangulate;
  std::function<Result<MeasuredInSpace>(const SpaceInput&, int threads, Detail3)> measure;
};

SpacePeer cgalInSpace();
SpacePeer voroInSpace();
SpacePeer voroDevelopment();

}  // namespace vorpipe::test

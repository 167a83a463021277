/// The other programs that are measured, each in a file of its own, each single-threaded, as its
/// documentation says to use it.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "bench/peers/peer_cells.h"
#include "bench/taken.h"
#include "vorpipe.h"

namespace vorpipe::test {

/// The time counts from coordinates as the peer takes them to results in memory; not what frees them.
struct Triangulated {
  Taken taken;
  std::size_t triangles;  ///< Delaunay polygons of k sites on one circle count as k - 2
};

struct FullyMeasured {
  Taken taken;
  PeerCells cells;
};

struct Peer {
  std::string name;                    ///< as `--peers` takes it
  std::string what;                    ///< of the peer is measured
  std::string version;                 ///< of its package
  bool without_weights, with_weights;  ///< the sites that it is meant for
  /// The one job: the triangulation alone. Empty: the peer has none.
  std::function<Result<Triangulated>(const BenchInput&)> triangulate;
  /// The other: all cells clipped to the domain, with areas, centroids and neighbors.
  std::function<Result<FullyMeasured>(const BenchInput&)> measure;
};

Peer cgalDelaunay();
Peer cgalRegular();
Peer boostVoronoi();
Peer qhull();
Peer voroPlusPlus();
/// Run by node, from a folder that npm has installed it in. Error (device): it is not there.
Result<Peer> d3Delaunay(const std::string& node_modules);

/// Those whose libraries were there when this was built.
std::vector<Peer> builtPeers();

}  // namespace vorpipe::test

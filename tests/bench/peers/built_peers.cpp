#include "bench/peers/peer.h"

namespace vorpipe::test {

std::vector<Peer> builtPeers() {
  return {
#ifdef WITH_CGAL
      cgalDelaunay(), cgalRegular(),
#endif
#ifdef WITH_BOOST
      boostVoronoi(),
#endif
#ifdef WITH_QHULL
      qhull(),
#endif
#ifdef WITH_VORO
      voroPlusPlus(),
#endif
  };
}

}  // namespace vorpipe::test

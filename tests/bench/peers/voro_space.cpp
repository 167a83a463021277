#include <voro++/voro++.hh>

#include "bench/peers/voro_cells.h"

namespace vorpipe::test {
namespace {

Result<MeasuredInSpace> measure(const SpaceInput& input, int /*threads*/, Detail3 detail) {
  MeasuredInSpace result{{}, std::vector<CellsInOrder>(1)};
  const JobWatch watch;
  const double side = input.side;
  const int blocks = voroBlocks(input, voro::optimal_particles);
  voro::container container(0, side, 0, side, 0, side, blocks, blocks, blocks, false, false, false,
                            room_in_voro_block);
  for (std::size_t i = 0; i < input.sites.size(); ++i) {
    const Point3& p = input.sites[i];
    container.put(static_cast<int>(i), p.x, p.y, p.z);
  }
  VoroCells<voro::voronoicell_neighbor> cells(result.parts[0], input.sites.size(), detail);
  voro::voronoicell_neighbor cell;
  voro::c_loop_all loop(container);
  if (loop.start()) {
    do {
      if (container.compute_cell(cell, loop)) cells.add(cell, loop.pid(), {loop.x(), loop.y(), loop.z()});
    } while (loop.inc());
  }
  result.taken = watch.taken();
  return result;
}

}  // namespace

// The only one with this interface that was distributed; its headers do not say.
SpacePeer voroInSpace() { return {"voro++", "Voro++", "0.4.6", false, {}, measure}; }

}  // namespace vorpipe::test

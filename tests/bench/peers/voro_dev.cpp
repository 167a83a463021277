// Compiled with another name for Voro++'s namespace, see CMakeLists.txt: the released one is there, too.
#include <omp.h>
#include <voro++.hh>

#include "bench/peers/voro_cells.h"

namespace vorpipe::test {
namespace {

Result<MeasuredInSpace> measure(const SpaceInput& input, int threads, Detail3 detail) {
  MeasuredInSpace result{{}, std::vector<CellsInOrder>(static_cast<std::size_t>(threads))};
  const JobWatch watch;
  const double side = input.side;
  const int blocks = voroBlocks(input, voro::optimal_particles_3d);
  voro::container_3d container(0, side, 0, side, 0, side, blocks, blocks, blocks, false, false, false,
                               room_in_voro_block, threads);
  // It takes what it does not change as an array that is not constant.
  auto* coordinates = const_cast<double*>(&input.sites[0].x);
  container.add_parallel(coordinates, static_cast<int>(input.sites.size()), threads);
  container.put_reconcile_overflow();
#pragma omp parallel num_threads(threads)
  {
    auto& part = result.parts[static_cast<std::size_t>(omp_get_thread_num())];
    VoroCells<voro::voronoicell_neighbor_3d> cells(part, input.sites.size() / result.parts.size(), detail);
    voro::voronoicell_neighbor_3d cell(container);
#pragma omp for schedule(dynamic, 1000)
    for (auto at = container.begin(); at < container.end(); ++at) {
      if (!container.compute_cell(cell, at)) continue;
      const int site = container.id[at->ijk][at->q];
      cells.add(cell, site, input.sites[static_cast<std::size_t>(site)]);
    }
  }
  result.taken = watch.taken();
  return result;
}

}  // namespace

SpacePeer voroDevelopment() { return {"voro++-dev", "Voro++, branch dev, OpenMP", "dev", true, {}, measure}; }

}  // namespace vorpipe::test

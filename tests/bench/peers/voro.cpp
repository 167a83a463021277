#include <voro++/voro++.hh>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "bench/peers/peer.h"

namespace vorpipe::test {
namespace {

// Voro++ makes cells in space: these are prisms, between two planes this far apart, where neighboring sites
// are 1 apart. From a twentieth to twice of that the time is the same.
constexpr double thickness = 1;
constexpr int room_in_block = 8;
// The only one with this interface that was distributed; its headers do not say.
constexpr const char* version = "0.4.6";

/// As many as its documentation finds best.
int blocks(double side, const BenchInput& input) {
  const double area = input.domain.xmax * input.domain.ymax;
  const double block = std::sqrt(voro::optimal_particles * area / static_cast<double>(input.sites.size()));
  return std::max(1, static_cast<int>(side / block));
}

template <class Container>
Container makeContainer(const BenchInput& input) {
  const auto& domain = input.domain;
  return Container(0, domain.xmax, 0, domain.ymax, -thickness / 2, thickness / 2, blocks(domain.xmax, input),
                   blocks(domain.ymax, input), 1, false, false, false, room_in_block);
}

void fill(voro::container& container, const Sites& sites) {
  for (std::size_t i = 0; i < sites.size(); ++i)
    container.put(static_cast<int>(i), sites.x[i], sites.y[i], 0);
}

/// Its weights are squares of radii; only their differences matter.
void fill(voro::container_poly& container, const Sites& sites) {
  const double least = *std::ranges::min_element(sites.weight);
  for (std::size_t i = 0; i < sites.size(); ++i)
    container.put(static_cast<int>(i), sites.x[i], sites.y[i], 0, std::sqrt(sites.weight[i] - least));
}

template <class Container>
FullyMeasured measureIn(const BenchInput& input) {
  const JobWatch watch;
  auto container = makeContainer<Container>(input);
  fill(container, input.sites);
  PeerCells cells(input);
  voro::voronoicell_neighbor cell;
  voro::c_loop_all loop(container);
  std::vector<int> neighbors;
  std::vector<double> sides;
  if (loop.start()) {
    do {
      if (!container.compute_cell(cell, loop)) continue;
      Point centroid{};
      double height = 0;
      cell.centroid(centroid.x, centroid.y, height);
      const auto site = static_cast<std::uint32_t>(loop.pid());
      cells.begin(site, cell.volume() / thickness,
                  {input.sites.x[site] + centroid.x, input.sites.y[site] + centroid.y});
      cell.neighbors(neighbors);
      cell.face_areas(sides);
      for (std::size_t k = 0; k < neighbors.size(); ++k) {
        const double length = sides[k] / thickness;
        // What is left are the planes; the other walls are numbered as ours.
        if (neighbors[k] >= wall_ymax) cells.addNeighbor(site, neighbors[k], length * length);
      }
    } while (loop.inc());
  }
  return {watch.taken(), std::move(cells)};
}

Result<FullyMeasured> measure(const BenchInput& input) {
  for (std::size_t i = 0; i < input.sites.size(); ++i) {
    if (!contains(input.domain, {input.sites.x[i], input.sites.y[i]}))
      return tl::unexpected(Error{ErrorCode::input, "Voro++ leaves out sites beyond the domain"});
  }
  return input.sites.weight.empty() ? measureIn<voro::container>(input)
                                    : measureIn<voro::container_poly>(input);
}

}  // namespace

Peer voroPlusPlus() { return {"voro++", "Voro++, a layer of one cell", version, true, true, {}, measure}; }

}  // namespace vorpipe::test

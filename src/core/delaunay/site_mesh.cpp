#include "core/delaunay/site_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel.h"
#include "core/delaunay/hilbert_order.h"
#include "core/delaunay/triangulation.h"

namespace vorpipe::core {
namespace {

/// Two triangles for each site are numbered by 32 bits with a sign.
constexpr std::size_t most_mesh_sites = std::size_t{1} << 29;

/// Whether coordinates and their differences are in the range of predicates.h: those up to 2^240 are
/// multiples of 2^-200, and of larger ones two differ by at least 2^-53 of the smaller.
bool isInRange(const SiteSet& sites) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  const auto look = [&](double coordinate) {
    const double size = std::abs(coordinate);
    if (size > 0) least = std::min(least, size);
    most = std::max(most, size);
  };
  std::for_each(sites.x.begin(), sites.x.end(), look);
  std::for_each(sites.y.begin(), sites.y.end(), look);
  for (const auto wall : {sites.domain.xmin, sites.domain.xmax, sites.domain.ymin, sites.domain.ymax})
    look(wall);
  return most <= 0x1p240 || (sites.weight.empty() && most <= 0x1p300 && least >= 0x1p-83);
}

bool areInRange(const std::vector<double>& weights) {
  return std::all_of(weights.begin(), weights.end(), [](double weight) {
    const double size = std::abs(weight);
    return size == 0 || (size >= 0x1p-440 && size <= 0x1p480);
  });
}

/// The mesh with its points numbered by index in the set.
Mesh triangulate(const SiteSet& sites, int threads) {
  constexpr std::size_t grain = std::size_t{1} << 15;
  const auto order = orderAlongCurve(sites, threads);
  std::vector<Point> points(order.size());
  std::vector<double> weights(sites.weight.empty() ? 0 : order.size());
  parallelFor(order.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto k = begin; k < end; ++k) points[k] = {sites.x[order[k]], sites.y[order[k]]};
    if (weights.empty()) return;
    for (auto k = begin; k < end; ++k) weights[k] = sites.weight[order[k]];
  });
  auto mesh = delaunay(std::move(points), std::move(weights), threads);
  if (mesh.triangles.empty()) return mesh;
  parallelFor(mesh.triangles.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto t = begin; t < end; ++t) {
      for (auto& corner : mesh.triangles[t].corner) {
        if (corner != ghost) corner = static_cast<std::int32_t>(order[static_cast<std::size_t>(corner)]);
      }
    }
  });
  std::vector<std::int32_t> at(order.size());
  parallelFor(order.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto k = begin; k < end; ++k) at[order[k]] = mesh.at[k];
  });
  mesh.at = std::move(at);
  return mesh;
}

}  // namespace

bool SiteMesh::isPossible() {
  if (!possible_) {
    possible_ = sites_.size() <= most_mesh_sites && isInRange(sites_) && areInRange(sites_.weight);
  }
  return *possible_;
}

const Mesh* SiteMesh::get() {
  if (!mesh_) mesh_ = isPossible() ? triangulate(sites_, threads_) : Mesh{};
  return mesh_->triangles.empty() ? nullptr : &*mesh_;
}

}  // namespace vorpipe::core

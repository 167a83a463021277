#include "cells/site_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "base/parallel.h"
#include "geometry/curve_order.h"
#include "geometry/triangulation.h"

namespace vorpipe::core {
namespace {

/// Signed 32-bit integers number the triangles, two for each site.
constexpr std::size_t most_mesh_sites = std::size_t{1} << 29;

/// Whether coordinates and their differences are in the range of predicates.h: coordinates up to 2^240 are
/// multiples of 2^-200, and two larger ones differ by at least 2^-53 of the smaller.
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

}  // namespace

bool canTriangulate(const SiteSet& sites) {
  return sites.size() <= most_mesh_sites && isInRange(sites) && areInRange(sites.weight);
}

PartMesh triangulate(const SiteSet& sites, std::vector<std::uint32_t> which, int threads) {
  constexpr std::size_t grain = std::size_t{1} << 15;
  PartMesh part;
  part.site = std::move(which);
  sortAlongCurve(sites, part.site, threads);
  part.points.resize(part.site.size());
  part.weights.resize(sites.weight.empty() ? 0 : part.site.size());
  parallelFor(part.site.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto k = begin; k < end; ++k) part.points[k] = {sites.x[part.site[k]], sites.y[part.site[k]]};
    if (part.weights.empty()) return;
    for (auto k = begin; k < end; ++k) part.weights[k] = sites.weight[part.site[k]];
  });
  part.mesh = delaunay(part.points, part.weights, threads);
  return part;
}

bool SiteMesh::isPossible() {
  if (!possible_) possible_ = canTriangulate(sites_);
  return *possible_;
}

const PartMesh* SiteMesh::get() {
  if (!mesh_) {
    mesh_.emplace();
    if (isPossible()) {
      std::vector<std::uint32_t> all(sites_.size());
      std::iota(all.begin(), all.end(), 0u);
      mesh_ = triangulate(sites_, std::move(all), threads_);
    }
  }
  return mesh_->mesh.triangles.empty() ? nullptr : &*mesh_;
}

}  // namespace vorpipe::core

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/peers/peer.h"

namespace vorpipe::test {
namespace {

struct Free {
  void operator()(qhT* run) const {
    // Large pieces first, then the buffers of all small ones.
    qh_freeqhull(run, !qh_ALL);
    int pieces = 0, bytes = 0;
    qh_memfreeshort(run, &pieces, &bytes);
    std::unique_ptr<qhT>(run).reset();
  }
};
using Run = std::unique_ptr<qhT, Free>;

/// Qhull ends its sets with a null pointer.
template <class T>
T** elements(setT* set) {
  return reinterpret_cast<T**>(&set->e[0].p);
}

/// Qbb scales the last coordinate, as its programs qdelaunay and qvoronoi do; Pp keeps warnings of narrow
/// hulls off.
Result<Run> start(std::vector<double>& points, std::string command) {
  Run run(std::make_unique<qhT>().release());
  qh_zero(run.get(), stderr);
  const int failed = qh_new_qhull(run.get(), 2, static_cast<int>(points.size() / 2), points.data(), False,
                                  command.data(), nullptr, nullptr);
  if (failed != 0)
    return tl::unexpected(Error{ErrorCode::input, "Qhull stopped with its error " + std::to_string(failed)});
  return run;
}

std::vector<double> pairs(const Sites& sites) {
  std::vector<double> points;
  points.reserve(2 * sites.size());
  for (std::size_t i = 0; i < sites.size(); ++i) points.insert(points.end(), {sites.x[i], sites.y[i]});
  return points;
}

Result<Triangulated> triangulate(const BenchInput& input) {
  auto points = pairs(input.sites);
  const JobWatch watch;
  const auto run = start(points, "qhull d Qbb Pp");
  if (!run) return tl::unexpected(run.error());
  const Taken taken = watch.taken();
  std::size_t triangles = 0;
  for (auto* facet = (*run)->facet_list; facet->next != nullptr; facet = facet->next) {
    if (!facet->upperdelaunay)
      triangles += static_cast<std::size_t>(qh_setsize(run->get(), facet->vertices)) - 2;
  }
  return Triangulated{taken, triangles};
}

/// The other end of the edge between two triangles, or polygons, that meet in `vertex`.
vertexT* across(facetT* a, facetT* b, const vertexT* vertex) {
  for (auto** of_a = elements<vertexT>(a->vertices); *of_a != nullptr; ++of_a) {
    if (*of_a == vertex) continue;
    for (auto** of_b = elements<vertexT>(b->vertices); *of_b != nullptr; ++of_b) {
      if (*of_a == *of_b) return *of_a;
    }
  }
  return nullptr;
}

class Cells {
 public:
  Cells(qhT* run, const BenchInput& input) : run_(run), domain_(input.domain), cells_(input) {}

  /// Qhull's own order of the facets around a vertex; its centers are the Voronoi vertices.
  void add(vertexT* vertex) {
    qh_order_vertexneighbors(run_, vertex);
    facetT** const facets = elements<facetT>(vertex->neighbors);
    vertices_.clear();
    neighbors_.clear();
    bool inside = true;
    for (facetT** facet = facets; *facet != nullptr && inside; ++facet) {
      facetT* const next = facet[1] != nullptr ? facet[1] : facets[0];
      auto* const neighbor = across(*facet, next, vertex);
      inside = !(*facet)->upperdelaunay && neighbor != nullptr;
      if (!inside) break;
      vertices_.push_back({(*facet)->center[0], (*facet)->center[1]});
      inside = contains(domain_, vertices_.back());
      neighbors_.push_back(indexOf(neighbor));
    }
    const auto site = static_cast<std::uint32_t>(indexOf(vertex));
    if (inside) {
      cells_.add(site, vertices_, neighbors_);
    } else {
      listNeighbors(vertex);
      cells_.addCut(site, neighbors_);
    }
  }

  PeerCells take() { return std::move(cells_); }

 private:
  std::int32_t indexOf(const vertexT* vertex) const { return qh_pointid(run_, vertex->point); }

  void listNeighbors(const vertexT* vertex) {
    neighbors_.clear();
    for (auto** facet = elements<facetT>(vertex->neighbors); *facet != nullptr; ++facet) {
      if ((*facet)->upperdelaunay) continue;
      for (auto** other = elements<vertexT>((*facet)->vertices); *other != nullptr; ++other) {
        if (*other != vertex) neighbors_.push_back(indexOf(*other));
      }
    }
    std::ranges::sort(neighbors_);
    neighbors_.erase(std::unique(neighbors_.begin(), neighbors_.end()), neighbors_.end());
  }

  qhT* run_;
  Box domain_;
  PeerCells cells_;
  std::vector<Point> vertices_;
  std::vector<std::int32_t> neighbors_;
};

Result<FullyMeasured> measure(const BenchInput& input) {
  auto points = pairs(input.sites);
  const JobWatch watch;
  const auto run = start(points, "qhull v Qbb Pp");
  if (!run) return tl::unexpected(run.error());
  qh_setvoronoi_all(run->get());
  qh_vertexneighbors(run->get());
  Cells cells(run->get(), input);
  for (auto* vertex = (*run)->vertex_list; vertex->next != nullptr; vertex = vertex->next) cells.add(vertex);
  return FullyMeasured{watch.taken(), cells.take()};
}

}  // namespace

Peer qhull() {
  const std::string version(
      qh_version, std::find(qh_version, qh_version + std::char_traits<char>::length(qh_version), ' '));
  return {"qhull", "Qhull", version, true, false, triangulate, measure};
}

}  // namespace vorpipe::test

#include "space/polyhedra.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>

#include "base/parallel.h"
#include "space/place.h"

namespace vorpipe::space {
namespace {

constexpr std::size_t cells_in_part = 512, vertices_in_part = 4096;
constexpr std::uint32_t none = 0xffffffff;

template <class T>
void atomicMin(T& value, T other) {
  std::atomic_ref<T> at(value);
  T now = at.load(std::memory_order_relaxed);
  while (other < now && !at.compare_exchange_weak(now, other, std::memory_order_relaxed)) {
  }
}

template <class T>
void atomicMax(T& value, T other) {
  std::atomic_ref<T> at(value);
  T now = at.load(std::memory_order_relaxed);
  while (now < other && !at.compare_exchange_weak(now, other, std::memory_order_relaxed)) {
  }
}

std::uint8_t wallBit(Label wall) { return static_cast<std::uint8_t>(1U << wallOf(wall)); }

}  // namespace

void FaceOrder::take(Label site, const Row& row) {
  const std::uint32_t cell = contraction_.cellOf(site);
  all_.clear();
  for (std::uint32_t f = 0; f < row.faces; ++f) all_.push_back({publicNumber(cells_, row.neighbor[f]), f});
  std::ranges::sort(all_, {}, &Face::neighbor);
  rank_.resize(row.faces);
  faces_.clear();
  for (std::uint32_t k = 0; k < all_.size(); ++k) {
    rank_[all_[k].face] = k;
    if (cell == SharedVertices::nowhere || contraction_.remaining(cell, all_[k].face) != 0)
      faces_.push_back(all_[k]);
  }
}

std::size_t FaceOrder::beginOf(const Row& row, std::size_t face) {
  const Ring ring = row.ring(face);
  std::size_t least = 0;
  for (std::size_t k = 1; k < ring.size(); ++k) {
    if (rank_[ring[k]] < rank_[ring[least]]) least = k;
  }
  return least;
}

void Polyhedra::write() {
  writeRings();
  numberVertices();
  writePlaces();
  writeSites();
}

/// Writes rings of vertices of the contraction.
void Polyhedra::writeRings() {
  const auto sites = contraction_.cells();
  auto& offsets = out_.face_vertex_offsets;
  offsets.assign(out_.neighbors.size() + 1, 0);
  const auto forFaces = [&](const auto& each) {
    parallelFor(sites.size(), cells_in_part, threads_, [&](std::size_t begin, std::size_t end) {
      FaceOrder order(cells_, contraction_);
      std::vector<RingStep> steps;
      for (std::size_t c = begin; c < end; ++c) {
        const auto site = static_cast<std::size_t>(sites[c]);
        const Row row = cells_.rows[site];
        order.take(sites[c], row);
        std::uint64_t at = out_.face_offsets[cells_.input[site]];
        for (const auto& face : order.faces()) each(c, row, face.face, order, steps, at++);
      }
    });
  };
  forFaces([&](std::size_t cell, const Row& row, std::size_t face, FaceOrder&, std::vector<RingStep>& steps,
               std::uint64_t at) {
    std::uint64_t size = contraction_.remaining(cell, face);
    if (size == Contraction::many_vertices) {
      contraction_.ring(cell, row, face, 0, steps);
      size = steps.size();
    }
    offsets[at + 1] = size;
  });
  for (std::size_t f = 0; f + 1 < offsets.size(); ++f) offsets[f + 1] += offsets[f];
  out_.face_vertices.resize(offsets.back());
  forFaces([&](std::size_t cell, const Row& row, std::size_t face, FaceOrder& order,
               std::vector<RingStep>& steps, std::uint64_t at) {
    contraction_.ring(cell, row, face, order.beginOf(row, face), steps);
    std::uint64_t to = offsets[at];
    for (const auto& step : steps) out_.face_vertices[to++] = step.to;
  });
  contraction_.vertices().forgetEnds();
}

/// Numbers vertices in the order in which the rings first name them.
void Polyhedra::numberVertices() {
  const std::size_t n = out_.size();
  auto& rings = out_.face_vertices;
  const auto forCells = [&](const auto& each) {
    parallelFor(n, cells_in_part, threads_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        each(static_cast<std::uint32_t>(i), out_.face_vertex_offsets[out_.face_offsets[i]],
             out_.face_vertex_offsets[out_.face_offsets[i + 1]]);
    });
  };
  user_.assign(contraction_.vertices().size(), none);
  number_.assign(contraction_.vertices().size(), none);
  forCells([&](std::uint32_t cell, std::uint64_t begin, std::uint64_t end) {
    for (auto k = begin; k < end; ++k) atomicMin(user_[rings[k]], cell);
  });
  std::vector<std::uint32_t> first(n + 1, 0);
  forCells([&](std::uint32_t cell, std::uint64_t begin, std::uint64_t end) {
    std::uint32_t count = 0;
    for (auto k = begin; k < end; ++k) {
      if (user_[rings[k]] == cell && number_[rings[k]] == none) number_[rings[k]] = count++;
    }
    first[cell + 1] = count;
  });
  for (std::size_t i = 0; i < n; ++i) first[i + 1] += first[i];
  parallelEach(number_.size(), vertices_in_part, threads_, [&](std::size_t v) {
    if (user_[v] != none) number_[v] += first[user_[v]];
  });
  parallelEach(rings.size(), vertices_in_part, threads_,
               [&](std::size_t k) { rings[k] = number_[rings[k]]; });
  out_.vertices.resize(first[n]);
}

/// Vertices that several have become. The best of them gives the place: one with the most walls, then the
/// best conditioned.
struct Polyhedra::Clusters {
  std::vector<std::uint64_t> best;
  std::vector<std::uint8_t> walls;

  static std::uint64_t rankOf(std::size_t on_walls, double condition, std::uint32_t vertex) {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(condition));
    return std::uint64_t{on_walls} << 62 | std::uint64_t{bits >> 1} << 32 | (none - vertex);
  }
};

/// Calls each(site, row, faces, vertex) for each vertex of the contraction, in the cell that numbered it.
template <class Each>
void Polyhedra::forOwnVertices(const Each& each) {
  const auto sites = contraction_.cells();
  const auto& shared = contraction_.vertices();
  parallelFor(sites.size(), cells_in_part, threads_, [&](std::size_t begin, std::size_t end) {
    RowVertices vertices;
    for (std::size_t c = begin; c < end; ++c) {
      const Row row = cells_.rows[static_cast<std::size_t>(sites[c])];
      vertices.number(row);
      std::uint32_t vertex = shared.ownBegin(c);
      for (const auto& faces : vertices.faces()) {
        if (shared.isOwn(sites[c], row, faces)) each(sites[c], row, faces, vertex++);
      }
    }
  });
}

void Polyhedra::writePlaces() {
  // user_ now names the cluster of a vertex that others have become.
  std::ranges::fill(user_, none);
  std::uint32_t count = 0;
  for (std::uint32_t v = 0; v < user_.size(); ++v) {
    const std::uint32_t became = contraction_.become(v);
    if (became != v && user_[became] == none) user_[became] = count++;
  }
  Clusters clusters;
  clusters.best.assign(count, 0);
  clusters.walls.assign(count, 0);
  if (count > 0) findBest(clusters);
  placeVertices(clusters);
  user_ = {};
  number_ = {};
}

void Polyhedra::findBest(Clusters& clusters) {
  forOwnVertices([&](Label site, const Row& row, const std::array<std::uint32_t, 3>& faces, std::uint32_t v) {
    const std::uint32_t cluster = user_[contraction_.become(v)];
    if (cluster == none) return;
    std::size_t on_walls = 0;
    Relative way[3];
    double sizes = 1;
    for (std::size_t e = 0; e < 3; ++e) {
      const Label label = row.neighbor[faces[e]];
      way[e] = relative(cells_.places, site, label);
      sizes *= way[e].size();
      if (!isWallLabel(label)) continue;
      ++on_walls;
      std::atomic_ref(clusters.walls[cluster]).fetch_or(wallBit(label), std::memory_order_relaxed);
    }
    const auto& [a, b, c] = way;
    const double det =
        a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
    atomicMax(clusters.best[cluster], Clusters::rankOf(on_walls, std::max(det / sizes, 0.0), v));
  });
}

void Polyhedra::placeVertices(const Clusters& clusters) {
  const Box3& box = cells_.places.box;
  forOwnVertices([&](Label site, const Row& row, const std::array<std::uint32_t, 3>& faces, std::uint32_t v) {
    const std::uint32_t became = contraction_.become(v), cluster = user_[became];
    if (number_[became] == none) return;
    std::uint8_t on = 0;
    if (cluster != none) {
      if (static_cast<std::uint32_t>(clusters.best[cluster]) != none - v) return;
      on = clusters.walls[cluster];
    }
    Point3 p = canonicalPlace(cells_.places,
                              {site, row.neighbor[faces[0]], row.neighbor[faces[1]], row.neighbor[faces[2]]});
    if ((on & 3) != 0) p.x = (on & 1) != 0 ? box.xmin : box.xmax;
    if ((on & 12) != 0) p.y = (on & 4) != 0 ? box.ymin : box.ymax;
    if ((on & 48) != 0) p.z = (on & 16) != 0 ? box.zmin : box.zmax;
    out_.vertices[number_[became]] = {p.x * cells_.unit, p.y * cells_.unit, p.z * cells_.unit};
  });
}

/// Writes the cells and walls that have faces at each vertex.
void Polyhedra::writeSites() {
  const std::size_t count = out_.vertices.size();
  auto& offsets = out_.vertex_site_offsets;
  offsets.assign(count + 1, 0);
  BigVector<std::uint8_t> walls_at(count, 0);
  const auto forVerticesOfCells = [&](const auto& each) {
    parallelFor(out_.size(), cells_in_part, threads_, [&](std::size_t begin, std::size_t end) {
      std::vector<std::uint32_t> vertices;
      for (std::size_t i = begin; i < end; ++i) {
        const auto first = out_.face_vertex_offsets[out_.face_offsets[i]],
                   last = out_.face_vertex_offsets[out_.face_offsets[i + 1]];
        vertices.assign(out_.face_vertices.begin() + static_cast<std::ptrdiff_t>(first),
                        out_.face_vertices.begin() + static_cast<std::ptrdiff_t>(last));
        std::ranges::sort(vertices);
        vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
        each(i, vertices);
      }
    });
  };
  forVerticesOfCells([&](std::size_t i, const std::vector<std::uint32_t>& vertices) {
    for (const auto v : vertices) std::atomic_ref(offsets[v + 1]).fetch_add(1, std::memory_order_relaxed);
    for (auto f = out_.face_offsets[i]; f < out_.face_offsets[i + 1]; ++f) {
      if (!isWall(out_.neighbors[f])) break;
      int wall = 0;
      while (publicNumber(cells_, labelOfWall(wall)) != out_.neighbors[f]) ++wall;
      for (auto k = out_.face_vertex_offsets[f]; k < out_.face_vertex_offsets[f + 1]; ++k)
        std::atomic_ref(walls_at[out_.face_vertices[k]])
            .fetch_or(wallBit(labelOfWall(wall)), std::memory_order_relaxed);
    }
  });
  for (std::size_t v = 0; v < count; ++v)
    offsets[v + 1] += offsets[v] + static_cast<std::uint64_t>(std::popcount(walls_at[v]));
  out_.vertex_sites.resize(offsets[count]);
  // While a vertex is filled, its offset runs on to that of the next.
  forVerticesOfCells([&](std::size_t i, const std::vector<std::uint32_t>& vertices) {
    for (const auto v : vertices) {
      const auto at = std::atomic_ref(offsets[v]).fetch_add(1, std::memory_order_relaxed);
      out_.vertex_sites[at] = static_cast<std::int64_t>(i);
    }
  });
  parallelEach(count, vertices_in_part, threads_, [&](std::size_t v) {
    for (int wall = 0; wall < walls; ++wall) {
      if ((walls_at[v] & wallBit(labelOfWall(wall))) != 0)
        out_.vertex_sites[offsets[v]++] = publicNumber(cells_, labelOfWall(wall));
    }
  });
  for (std::size_t v = count; v > 0; --v) offsets[v] = offsets[v - 1];
  offsets[0] = 0;
  parallelEach(count, vertices_in_part, threads_, [&](std::size_t v) {
    std::sort(out_.vertex_sites.begin() + static_cast<std::ptrdiff_t>(offsets[v]),
              out_.vertex_sites.begin() + static_cast<std::ptrdiff_t>(offsets[v + 1]));
  });
}

}  // namespace vorpipe::space

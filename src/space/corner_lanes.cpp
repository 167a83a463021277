// Compiled once for each set of instructions. No product is joined with a sum: the bits are the same in all.
#include "space/corner_lanes.h"

namespace vorpipe::space {
namespace {

constexpr std::size_t lanes = 8;
using Reals [[gnu::vector_size(8 * lanes)]] = double;
using Truths [[gnu::vector_size(8 * lanes)]] = std::int64_t;

/// 2^-53.
constexpr double rounding = 1.1102230246251565e-16;

inline Reals gather(const double* from, const std::int32_t* place) {
  return Reals{from[place[0]], from[place[1]], from[place[2]], from[place[3]],
               from[place[4]], from[place[5]], from[place[6]], from[place[7]]};
}
inline Reals load(const double* from) {
  Reals all;
  __builtin_memcpy(&all, from, sizeof all);
  return all;
}
inline void store(double* to, const Reals& all) { __builtin_memcpy(to, &all, sizeof all); }
inline Reals magnitude(const Reals& a) { return a < 0 ? -a : a; }
inline Reals greater(const Reals& a, const Reals& b) { return a > b ? a : b; }
inline Reals less(const Reals& a, const Reals& b) { return a < b ? a : b; }

struct Vectors {
  Reals x, y, z;
};
inline Vectors gather(const CornerJob& job, const std::int32_t* face) {
  return {gather(job.nx, face), gather(job.ny, face), gather(job.nz, face)};
}
inline Vectors cross(const Vectors& a, const Vectors& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Reals dot(const Vectors& a, const Vectors& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
/// The sum of the components' magnitudes.
inline Reals sizeOf(const Vectors& a) { return magnitude(a.x) + magnitude(a.y) + magnitude(a.z); }

/// The vertices v .. v + 7. `count` of them are in use.
template <bool weighted>
void placeVertices(CornerJob& job, std::size_t v, std::size_t count) {
  const Vectors a = gather(job, job.corner[0] + v), b = gather(job, job.corner[1] + v),
                c = gather(job, job.corner[2] + v);
  const Reals ah = gather(job.h, job.corner[0] + v), bh = gather(job.h, job.corner[1] + v),
              ch = gather(job.h, job.corner[2] + v);
  const Vectors bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
  const Reals det = dot(a, bc);
  const Reals am = sizeOf(a), bm = sizeOf(b), cm = sizeOf(c);
  const Reals product = am * bm * cm;
  const Reals inverse = 1 / det;
  const Reals x = (ah * bc.x + bh * ca.x + ch * ab.x) * inverse;
  const Reals y = (ah * bc.y + bh * ca.y + ch * ab.y) * inverse;
  const Reals z = (ah * bc.z + bh * ca.z + ch * ab.z) * inverse;
  store(job.x + v, x);
  store(job.y + v, y);
  store(job.z + v, z);
  const double* const sizes = weighted ? job.h_size : job.h;
  const Reals as = weighted ? gather(sizes, job.corner[0] + v) : magnitude(ah),
              bs = weighted ? gather(sizes, job.corner[1] + v) : magnitude(bh),
              cs = weighted ? gather(sizes, job.corner[2] + v) : magnitude(ch);
  // The determinant has the sign that is seen beyond 8 rounding errors of that product, and a place an error
  // of k (16 sum h / m + 10 R) of them, where k is the product over the determinant and R the place's length:
  // see docs/space-algorithm.md. Lengths of edges take 8 R more.
  const Reals condition = product * inverse;
  const Reals length = magnitude(x) + magnitude(y) + magnitude(z);
  const Reals error =
      rounding * (condition * (16 * (as / am + bs / bm + cs / cm) + 10 * length) + 8 * length);
  const Truths turned = ~(det > 8 * rounding * product);
  const Truths bad = turned | ~(condition <= worst_condition);
  store(job.error + v, bad ? Reals{} + __builtin_inf() : error);
  // Weights may make a plane that is near out of large numbers.
  constexpr double coarse_part = 1e-10;
  Truths coarse{};
  if constexpr (weighted) coarse = ~(error <= coarse_part * (length + less(am, less(bm, cm))));
  for (std::size_t k = 0; k < count; ++k) {
    job.turned[v + k] = turned[k] != 0 ? 1 : 0;
    job.unsure = job.unsure || (weighted ? bad[k] | coarse[k] : bad[k]) != 0;
  }
}

/// Adds 20 times the second moments about the site of tetrahedra of the site, a foot, and edges: t is six
/// times their volumes.
inline void addMoments(const Reals& t, const Vectors& foot, const Vectors& u, const Vectors& w,
                       Reals (&sum)[6]) {
  const Vectors all{foot.x + u.x + w.x, foot.y + u.y + w.y, foot.z + u.z + w.z};
  sum[0] += t * (all.x * all.x + (foot.x * foot.x + (u.x * u.x + w.x * w.x)));
  sum[1] += t * (all.y * all.y + (foot.y * foot.y + (u.y * u.y + w.y * w.y)));
  sum[2] += t * (all.z * all.z + (foot.z * foot.z + (u.z * u.z + w.z * w.z)));
  sum[3] += t * (all.y * all.z + (foot.y * foot.z + (u.y * u.z + w.y * w.z)));
  sum[4] += t * (all.x * all.z + (foot.x * foot.z + (u.x * u.z + w.x * w.z)));
  sum[5] += t * (all.x * all.y + (foot.x * foot.y + (u.x * u.y + w.x * w.y)));
}

/// What is summed over edges.
struct Sums {
  Vectors first{};
  Reals second[6]{};
};

/// A point amid the vertices, about which a cell is measured that may lie far from its site.
struct Middle {
  double x = 0, y = 0, z = 0;
  double reach[3] = {};  ///< how far vertices are from it along each axis

  /// Where the part of a moment in a volume is no further out than the vertices: rounding may put that of a
  /// cell without thickness anywhere.
  [[nodiscard]] double within(int axis, double moment, double volume) const {
    const double at = volume > 0 ? moment / volume : 0;
    return at > reach[axis] ? reach[axis] : at < -reach[axis] ? -reach[axis] : at;
  }
};
Middle middleOf(const CornerJob& job) {
  Middle middle;
  const auto between = [&](const double* at, int axis) {
    double low = at[0], high = at[0];
    for (std::size_t v = 1; v < job.vertices; ++v) {
      low = at[v] < low ? at[v] : low;
      high = at[v] > high ? at[v] : high;
    }
    middle.reach[axis] = (high - low) / 2;
    return (low + high) / 2;
  };
  middle.x = between(job.x, 0);
  middle.y = between(job.y, 1);
  middle.z = between(job.z, 2);
  return middle;
}

/// The edges e .. e + 7. Adds what the measures take, where planes are p . n = h about the middle.
template <bool weighted>
void proveEdges(CornerJob& job, std::size_t e, std::size_t count, const Middle& middle, const double* h,
                double* area_a, double* area_b, Sums& sums) {
  const Vectors a = gather(job, job.a + e), b = gather(job, job.b + e);
  Vectors u{gather(job.x, job.from + e), gather(job.y, job.from + e), gather(job.z, job.from + e)};
  Vectors w{gather(job.x, job.to + e), gather(job.y, job.to + e), gather(job.z, job.to + e)};
  const Reals error = gather(job.error, job.from + e) + gather(job.error, job.to + e);
  const Vectors along = cross(b, a);
  const Vectors way{w.x - u.x, w.y - u.y, w.z - u.z};
  const Reals length = dot(way, along);
  const Reals size = sizeOf(along);
  const Reals least = less(gather(job.distance, job.a + e), gather(job.distance, job.b + e));
  const Truths unproved = ~(length > size * error);
  const Truths tied = ~(length > size * (error + job.tie * least));
  for (std::size_t k = 0; k < count; ++k) {
    job.unproved[e + k] = unproved[k] != 0 ? 1 : 0;
    job.tied = job.tied || tied[k] != 0;
  }
  if (!job.measure) return;
  if constexpr (weighted) {
    u = {u.x - middle.x, u.y - middle.y, u.z - middle.z};
    w = {w.x - middle.x, w.y - middle.y, w.z - middle.z};
  }
  const Vectors turn = cross(u, w);
  const Reals on_a = dot(a, turn), on_b = dot(b, turn);
  store(area_a, on_a);
  store(area_b, on_b);
  // Tetrahedra of the site, the foot of each face's plane, and the edge: it runs counter-clockwise around b.
  const Reals ga = gather(h, job.a + e) / dot(a, a), gb = gather(h, job.b + e) / dot(b, b);
  Reals on_side_a = -ga * on_a, on_side_b = gb * on_b;
  for (std::size_t k = count; k < lanes; ++k) on_side_a[k] = on_side_b[k] = 0;
  const Reals both = on_side_a + on_side_b;
  sums.first.x += both * (u.x + w.x);
  sums.first.y += both * (u.y + w.y);
  sums.first.z += both * (u.z + w.z);
  if (!job.moments) return;
  addMoments(on_side_a, {ga * a.x, ga * a.y, ga * a.z}, u, w, sums.second);
  addMoments(on_side_b, {gb * b.x, gb * b.y, gb * b.z}, u, w, sums.second);
}

inline double sum(const Reals& all) {
  return ((all[0] + all[1]) + (all[2] + all[3])) + ((all[4] + all[5]) + (all[6] + all[7]));
}

template <bool weighted>
void findCornersOf(CornerJob& job) {
  job.unsure = job.tied = false;
  for (std::size_t v = 0; v < job.vertices; v += lanes) {
    placeVertices<weighted>(job, v, job.vertices - v < lanes ? job.vertices - v : lanes);
  }
  Sums sums;
  Middle middle;
  if constexpr (weighted) {
    middle = middleOf(job);
    for (std::size_t f = 0; f < job.faces; ++f) {
      job.h_around[f] = job.h[f] - (job.nx[f] * middle.x + job.ny[f] * middle.y + job.nz[f] * middle.z);
    }
  }
  const double* const h = weighted ? job.h_around : job.h;
  for (std::size_t f = 0; f < job.faces; ++f) job.twice_area[f] = 0;
  for (std::size_t e = 0; e < job.edges; e += lanes) {
    const std::size_t count = job.edges - e < lanes ? job.edges - e : lanes;
    double area_a[lanes], area_b[lanes];
    proveEdges<weighted>(job, e, count, middle, h, area_a, area_b, sums);
    if (!job.measure) continue;
    for (std::size_t k = 0; k < count; ++k) {
      job.twice_area[job.a[e + k]] -= area_a[k];
      job.twice_area[job.b[e + k]] += area_b[k];
    }
  }
  if (!job.measure) return;
  double volume = 0, surface = 0, moment[3] = {sum(sums.first.x), sum(sums.first.y), sum(sums.first.z)};
  for (std::size_t f = 0; f < job.faces; ++f) {
    const double squared = job.nx[f] * job.nx[f] + job.ny[f] * job.ny[f] + job.nz[f] * job.nz[f];
    const double foot = h[f] / squared, six_volumes = foot * job.twice_area[f];
    volume += six_volumes;
    surface += job.twice_area[f] / __builtin_sqrt(squared);
    moment[0] += six_volumes * foot * job.nx[f];
    moment[1] += six_volumes * foot * job.ny[f];
    moment[2] += six_volumes * foot * job.nz[f];
  }
  job.volume = volume / 6;
  job.surface = surface / 2;
  for (std::size_t k = 0; k < 3; ++k) {
    job.centroid[k] =
        weighted ? middle.within(static_cast<int>(k), moment[k], 4 * volume) : moment[k] / (4 * volume);
  }
  if (job.moments) {
    constexpr std::size_t first[6] = {0, 1, 2, 1, 0, 0}, second[6] = {0, 1, 2, 2, 2, 1};
    for (std::size_t k = 0; k < 6; ++k) {
      job.second_moments[k] =
          sum(sums.second[k]) / 120 - job.volume * job.centroid[first[k]] * job.centroid[second[k]];
    }
  }
  if constexpr (weighted) {
    job.centroid[0] += middle.x;
    job.centroid[1] += middle.y;
    job.centroid[2] += middle.z;
  }
}

}  // namespace

// NOLINTNEXTLINE(misc-use-internal-linkage): declared by lane_width.cpp
void VORPIPE_LANES_FUNCTION(CornerJob& job) {
  if (job.h_size == nullptr) {
    findCornersOf<false>(job);
  } else {
    findCornersOf<true>(job);
  }
}

}  // namespace vorpipe::space

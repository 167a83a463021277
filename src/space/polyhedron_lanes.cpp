// Compiled once for each set of instructions.
#include "space/polyhedron_lanes.h"

#include "space/polyhedron_words.h"

namespace vorpipe::space {
namespace {

#include "polyhedron.glsl"

/// Candidates near a site, in the order in which they cut.
struct Nearest {
  // A vector of candidates may be written behind the last.
  REAL squared[SLOTS + LANES], x[SLOTS + LANES], y[SLOTS + LANES], z[SLOTS + LANES];
  REAL lighter[SLOTS + LANES];  ///< with weights
  std::int32_t site[SLOTS + LANES], key[SLOTS];
  std::uint8_t order[SLOTS];
  int count;

  /// Sorts by distance, with weights by power, to which is added what makes all positive. Keys are distances
  /// whose last bits are indices, so that no two are equal; the rank of each is the number of keys that are
  /// less.
  template <bool weighted>
  void sort(REAL add) {
    constexpr int index_bits = SLOTS - 1;
    for (int k = 0; k < SLOTS; ++k) {
      const auto rounded = static_cast<float>(weighted ? squared[k] + (lighter[k] + add) : squared[k]);
      std::int32_t bits;
      __builtin_memcpy(&bits, &rounded, sizeof bits);
      key[k] = k < count ? (bits & ~index_bits) | k : 0x7FFFFFFF;
    }
    const int blocks = (count + LANES - 1) / LANES;
    for (int k = 0; k < count; ++k) {
      int rank = 0;
      for (int b = 0; b < blocks; ++b) rank += COUNT(less(load(key + b * LANES), lane_int{} + key[k]));
      order[rank] = static_cast<std::uint8_t>(k);
    }
  }
};

/// A vector of candidates, seen from the site.
struct Seen {
  lane_real x, y, z, squared, lighter;
};

/// Rounding of what is compared with the radius: coordinates of a bin in float, differences and squares.
constexpr REAL safety = 1.00001F;

template <bool weighted>
class Walk {
 public:
  explicit Walk(const LaneBins& bins) : bins_(bins) {}

  void find(std::uint32_t site, const int (&bin)[3], ProposedCell& proposed) {
    begin(site, bin);
    std::size_t step = cutNearest();
    if constexpr (weighted) cutHeavy();
    proposed.state = Proposed::uncertain;
    for (; step < bins_.step_count && !cell_.empty && !cell_.overflow; ++step) {
      if (steps_[step].squared_distance * side_squared_ >= reach_) {
        proposed.state = Proposed::whole;
        break;
      }
      cutBin(steps_[step]);
    }
    if (cell_.empty) {
      proposed.state = Proposed::empty;
      writeEmpty(proposed);
    }
    if (proposed.state == Proposed::whole) write(proposed);
  }

 private:
  void begin(std::uint32_t site, const int (&bin)[3]) {
    site_ = site;
    const float place[3] = {bins_.x[site], bins_.y[site], bins_.z[site]};
    REAL low[3], high[3];
    std::size_t part = 0;
    for (int axis = 2; axis >= 0; --axis) {
      bin_[axis] = bin[axis];
      place_[axis] = place[axis];
      // Bins of sites very far away are larger than float has numbers: then the part is none.
      const float along = place[axis] / bins_.side * parts_of_bin;
      const bool is_first = !(along > 0);
      part = part * parts_of_bin +
             (is_first ? 0 : static_cast<std::size_t>(along < parts_of_bin ? along : parts_of_bin - 1));
      const float from_domain = static_cast<float>(bin[axis]) * bins_.side + bins_.corner[axis];
      low[axis] = -place[axis] - from_domain;
      high[axis] = bins_.extent[axis] - from_domain - place[axis];
#ifdef VORPIPE_DOUBLES
      const double at = bins_.places[3 * std::size_t{site} + static_cast<std::size_t>(axis)];
      low[axis] = bins_.low[axis] - at;
      high[axis] = bins_.high[axis] - at;
#endif
    }
    steps_ = bins_.steps + part * bins_.step_count;
    begin_ = bins_.begin + (std::ptrdiff_t{bin[2]} * bins_.count[1] + bin[1]) * bins_.count[0] + bin[0];
    inside_ = bins_.count[0];
    for (int axis = 0; axis < 3; ++axis)
      inside_ = min(inside_, min(bin[axis], bins_.count[axis] - 1 - bin[axis]));
    side_squared_ = bins_.side * bins_.side;
    if constexpr (weighted) weight_ = static_cast<REAL>(bins_.weights[site] - bins_.least_weight);
    beginPolyhedron(cell_, low[0], low[1], low[2], high[0], high[1], high[2]);
    measure();
  }

  /// Sites farther than twice the radius R do not cut. With weights one that is lighter than the own site by
  /// e does not if it is farther than R + root(R^2 - e).
  void measure() {
    if constexpr (weighted) {
      radius_squared_ = safety * squaredRadius(cell_);
      radius_ = static_cast<REAL>(__builtin_sqrt(radius_squared_));
      reach_ = reachOf(weight_ - bins_.heaviest_around[begin_ - bins_.begin]);
    } else {
      reach_ = 4 * safety * squaredRadius(cell_);
    }
  }

  /// Squared; less than 0 if no such site cuts, wherever it is.
  [[nodiscard]] REAL reachOf(REAL lighter) const {
    const REAL left = radius_squared_ - lighter;
    if (!(left >= 0)) return -1;
    const REAL reach = radius_ + static_cast<REAL>(__builtin_sqrt(left));
    return reach * reach;
  }

  /// Those of a vector that may cut: d^2 + e < 2 R d.
  [[nodiscard]] std::uint64_t nearOf(const Seen& seen) const {
    if constexpr (!weighted) return less(seen.squared, lane_real{} + reach_);
    const lane_real power = seen.squared + seen.lighter;
    return less(power * GREATER(power, NO_REAL), seen.squared * (4 * radius_squared_));
  }

  /// Returns whether there are sites in such a bin; them, and where it lies from the site.
  bool bin(const BinStep& step, std::uint32_t& from, std::uint32_t& to, float (&offset)[3]) const {
    if (step.far > inside_) {
      const int at[3] = {bin_[0] + step.x, bin_[1] + step.y, bin_[2] + step.z};
      for (int axis = 0; axis < 3; ++axis) {
        if (at[axis] < 0 || at[axis] >= bins_.count[axis]) return false;
      }
    }
    const std::uint32_t* const begin = begin_ + step.ahead;
    from = begin[0];
    to = begin[1];
    offset[0] = static_cast<float>(step.x) * bins_.side - place_[0];
    offset[1] = static_cast<float>(step.y) * bins_.side - place_[1];
    offset[2] = static_cast<float>(step.z) * bins_.side - place_[2];
    return from < to;
  }

  /// Collects some of the first bins and cuts with their sites by ascending distance: fewer vertices come and
  /// go. Returns the step at which the walk goes on.
  std::size_t cutNearest() {
    constexpr int enough = 48;
    nearest_.count = 0;
    std::size_t step = 0;
    for (; step < bins_.step_count && nearest_.count < enough; ++step) {
      std::uint32_t from, to;
      float offset[3];
      if (!bin(steps_[step], from, to, offset)) continue;
      if (nearest_.count + static_cast<int>(to - from) > SLOTS) break;
      for (std::uint32_t j = from; j < to; j += LANES) {
        const int k = nearest_.count + static_cast<int>(j - from);
        const Seen seen = see(j, to, offset);
        store(nearest_.x + k, seen.x);
        store(nearest_.y + k, seen.y);
        store(nearest_.z + k, seen.z);
        store(nearest_.squared + k, seen.squared);
        if constexpr (weighted) store(nearest_.lighter + k, seen.lighter);
        store(nearest_.site + k, each_lane + static_cast<std::int32_t>(j));
      }
      nearest_.count += static_cast<int>(to - from);
    }
    nearest_.template sort<weighted>(weighted ? bins_.most_weight - weight_ : 0);
    int cuts = 0;
    for (int r = 0; r < nearest_.count && !cell_.empty && !cell_.overflow; ++r) {
      const int k = nearest_.order[r];
      if (nearest_.site[k] == static_cast<std::int32_t>(site_)) continue;
      REAL lift = nearest_.squared[k];
      if constexpr (weighted) {
        lift += nearest_.lighter[k];
        if (lift > 0 && lift * lift >= 4 * radius_squared_ * nearest_.squared[k]) continue;
      } else if (lift >= reach_) {
        break;
      }
      if (cut(nearest_.x[k], nearest_.y[k], nearest_.z[k], lift, nearest_.site[k])) {
        if (++cuts % 8 == 0) measure();
      }
    }
    if (!cell_.empty && !cell_.overflow) measure();
    return step;
  }

  /// The sites from j on, before `end`, in a bin at an offset.
#ifdef VORPIPE_DOUBLES
  [[nodiscard]] Seen see(std::uint32_t j, std::uint32_t end, const float (&)[3]) const {
    const int count = min(LANES, static_cast<int>(end - j));
    lane_real dx{}, dy{}, dz{};
    const double *to = bins_.places + 3 * std::size_t{j}, *from = bins_.places + 3 * std::size_t{site_};
    for (int lane = 0; lane < count; ++lane) {
      dx[lane] = to[3 * lane] - from[0];
      dy[lane] = to[3 * lane + 1] - from[1];
      dz[lane] = to[3 * lane + 2] - from[2];
    }
    return {dx, dy, dz, dx * dx + dy * dy + dz * dz, lighterOf(j, end)};
  }
#else
  [[nodiscard]] Seen see(std::uint32_t j, std::uint32_t end, const float (&offset)[3]) const {
    const lane_real dx = load(bins_.x + j) + offset[0], dy = load(bins_.y + j) + offset[1],
                    dz = load(bins_.z + j) + offset[2];
    return {dx, dy, dz, dx * dx + dy * dy + dz * dz, lighterOf(j, end)};
  }
#endif

  /// How much lighter than the own site the sites from j on are.
  [[nodiscard]] lane_real lighterOf([[maybe_unused]] std::uint32_t j,
                                    [[maybe_unused]] std::uint32_t end) const {
    if constexpr (!weighted) return NO_REAL;
#ifdef VORPIPE_DOUBLES
    lane_real lighter{};
    for (int lane = 0; lane < min(LANES, static_cast<int>(end - j)); ++lane) {
      const std::uint32_t site = j + static_cast<std::uint32_t>(lane);
      const bool heavy = bins_.weight[site] < 0;
      lighter[lane] = heavy ? __builtin_inf() : bins_.weights[site_] - bins_.weights[site];
    }
    return lighter;
#else
    return weight_ - load(bins_.weight + j);
#endif
  }

  /// Cuts with the sites that no bin names, whose weights take the digits of double.
  void cutHeavy() {
    const double* const from = bins_.places + 3 * std::size_t{site_};
    for (std::size_t k = 0; k < bins_.heavy_count && !cell_.empty && !cell_.overflow; ++k) {
      const std::uint32_t site = bins_.heavy[k];
      if (site == site_) continue;
      const double* const to = bins_.places + 3 * std::size_t{site};
      const double dx = to[0] - from[0], dy = to[1] - from[1], dz = to[2] - from[2];
      const double squared = dx * dx + dy * dy + dz * dz;
      const double lift = squared + (bins_.weights[site_] - bins_.weights[site]);
      if (lift > 0 && lift * lift >= 4 * static_cast<double>(radius_squared_) * squared) continue;
      if (cut(static_cast<REAL>(dx), static_cast<REAL>(dy), static_cast<REAL>(dz), static_cast<REAL>(lift),
              static_cast<std::int32_t>(site)) &&
          !cell_.empty && !cell_.overflow)
        measure();
    }
  }

  void cutBin(const BinStep& step) {
    std::uint32_t from, to;
    float offset[3];
    if (!bin(step, from, to, offset)) return;
    if constexpr (weighted) {
      const float heaviest = bins_.heaviest[begin_ + step.ahead - bins_.begin];
      if (step.squared_distance * side_squared_ >= reachOf(weight_ - heaviest)) return;
    }
    bool any = false;
    for (std::uint32_t j = from; j < to; j += LANES) {
      const Seen seen = see(j, to, offset);
      std::uint64_t near = nearOf(seen);
      if (to - j < LANES) near &= SLOT(to - j) - SLOT(0);
      for (; near != 0; near &= near - 1) {
        const int lane = LOWEST(near);
        const std::uint32_t site = j + static_cast<std::uint32_t>(lane);
        if (site == site_) continue;
        REAL lift = seen.squared[lane];
        if constexpr (weighted) lift += seen.lighter[lane];
        any = cut(seen.x[lane], seen.y[lane], seen.z[lane], lift, static_cast<std::int32_t>(site)) || any;
        if (cell_.empty || cell_.overflow) return;
      }
    }
    if (any) measure();
  }

  bool cut(REAL dx, REAL dy, REAL dz, REAL lift, std::int32_t name) {
    const std::uint64_t removed = verticesBeyond(cell_, dx, dy, dz, 0.5F * lift);
    if (removed == 0) return false;
    cutOff(cell_, removed, name);
    if (cell_.empty) emptied_by_ = name;
    return true;
  }

  /// The last cut, which left nothing, and the vertex that is nearest to it.
  void writeEmpty(ProposedCell& proposed) const {
    int nearest = LOWEST(cell_.live);
    for (std::uint64_t left = cell_.live; left != 0; left &= left - 1) {
      const int v = LOWEST(left);
      if (cell_.beyond[v] < cell_.beyond[nearest]) nearest = v;
    }
    proposed.emptied_by[0] = cell_.name[cell_.first[nearest]];
    proposed.emptied_by[1] = cell_.name[cell_.second[nearest]];
    proposed.emptied_by[2] = cell_.name[cell_.third[nearest]];
    proposed.emptied_by[3] = emptied_by_;
  }

  void write(ProposedCell& proposed) const {
    std::uint8_t face_of[SLOTS];
    int faces = 0;
    for (std::uint64_t left = cell_.used; left != 0; left &= left - 1) {
      const int face = LOWEST(left);
      if (cell_.on[face] == 0) continue;
      face_of[face] = static_cast<std::uint8_t>(faces);
      proposed.neighbor[faces++] = cell_.name[face];
    }
    int vertices = 0;
    for (std::uint64_t left = cell_.live; left != 0; left &= left - 1) {
      const int v = LOWEST(left);
      proposed.corner[vertices][0] = face_of[cell_.first[v]];
      proposed.corner[vertices][1] = face_of[cell_.second[v]];
      proposed.corner[vertices][2] = face_of[cell_.third[v]];
      ++vertices;
    }
    proposed.faces = faces;
    proposed.vertices = vertices;
  }

  const LaneBins& bins_;
  const BinStep* steps_ = nullptr;
  std::uint32_t site_ = 0;
  int bin_[3] = {};
  const std::uint32_t* begin_ = nullptr;  ///< of that bin
  int inside_ = 0;                        ///< how many bins around are there in all directions
  float place_[3] = {};
  REAL side_squared_ = 0, reach_ = 0;
  REAL weight_ = 0, radius_squared_ = 0, radius_ = 0;  ///< with weights
  std::int32_t emptied_by_ = 0;
  Polyhedron cell_;
  Nearest nearest_;
};

template <bool weighted>
void proposeAll(const LaneBins& bins, std::uint32_t bin, std::uint32_t first, std::uint32_t last,
                void (*take)(void*, std::uint32_t, const ProposedCell&), void* context) {
  Walk<weighted> walk(bins);
  ProposedCell proposed;
  const auto nx = static_cast<std::uint32_t>(bins.count[0]), ny = static_cast<std::uint32_t>(bins.count[1]);
  for (std::uint32_t site = first; site < last; ++site) {
    while (site >= bins.begin[bin + 1]) ++bin;
    walk.find(site,
              {static_cast<int>(bin % nx), static_cast<int>(bin / nx % ny), static_cast<int>(bin / nx / ny)},
              proposed);
    take(context, site, proposed);
  }
}

}  // namespace

// NOLINTNEXTLINE(misc-use-internal-linkage): declared by lane_width.cpp
void VORPIPE_LANES_FUNCTION(const LaneBins& bins, std::uint32_t bin, std::uint32_t first, std::uint32_t last,
                            void (*take)(void*, std::uint32_t, const ProposedCell&), void* context) {
  (bins.weight == nullptr ? proposeAll<false> : proposeAll<true>)(bins, bin, first, last, take, context);
}

}  // namespace vorpipe::space

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
  std::int32_t site[SLOTS + LANES], key[SLOTS];
  std::uint8_t order[SLOTS];
  int count;

  /// Sorts by distance. Keys are distances whose last bits are indices, so that no two are equal; the rank of
  /// each is the number of keys that are less.
  void sort() {
    constexpr int index_bits = SLOTS - 1;
    for (int k = 0; k < SLOTS; ++k) {
      const auto rounded = static_cast<float>(squared[k]);
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
  lane_real x, y, z, squared;
};

/// Rounding of what is compared with the radius: coordinates of a bin in float, differences and squares.
constexpr REAL safety = 1.00001F;

class Walk {
 public:
  explicit Walk(const LaneBins& bins) : bins_(bins) {}

  void find(std::uint32_t site, const int (&bin)[3], ProposedCell& proposed) {
    begin(site, bin);
    std::size_t step = cutNearest();
    proposed.state = Proposed::uncertain;
    for (; step < bins_.step_count && !cell_.empty && !cell_.overflow; ++step) {
      if (steps_[step].squared_distance * side_squared_ >= reach_) {
        proposed.state = Proposed::whole;
        break;
      }
      cutBin(steps_[step]);
    }
    if (cell_.empty) proposed.state = Proposed::empty;
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
      const int along = static_cast<int>(place[axis] / bins_.side * parts_of_bin);
      part = part * parts_of_bin + static_cast<std::size_t>(min(parts_of_bin - 1, max(0, along)));
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
    beginPolyhedron(cell_, low[0], low[1], low[2], high[0], high[1], high[2]);
    measure();
  }

  /// Sites farther than twice the radius do not cut.
  void measure() { reach_ = 4 * safety * squaredRadius(cell_); }

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
        store(nearest_.site + k, each_lane + static_cast<std::int32_t>(j));
      }
      nearest_.count += static_cast<int>(to - from);
    }
    nearest_.sort();
    int cuts = 0;
    for (int r = 0; r < nearest_.count && !cell_.empty && !cell_.overflow; ++r) {
      const int k = nearest_.order[r];
      if (nearest_.squared[k] >= reach_) break;
      if (nearest_.site[k] == static_cast<std::int32_t>(site_)) continue;
      if (cut(nearest_.x[k], nearest_.y[k], nearest_.z[k], nearest_.squared[k], nearest_.site[k])) {
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
    return {dx, dy, dz, dx * dx + dy * dy + dz * dz};
  }
#else
  [[nodiscard]] Seen see(std::uint32_t j, std::uint32_t, const float (&offset)[3]) const {
    const lane_real dx = load(bins_.x + j) + offset[0], dy = load(bins_.y + j) + offset[1],
                    dz = load(bins_.z + j) + offset[2];
    return {dx, dy, dz, dx * dx + dy * dy + dz * dz};
  }
#endif

  void cutBin(const BinStep& step) {
    std::uint32_t from, to;
    float offset[3];
    if (!bin(step, from, to, offset)) return;
    bool any = false;
    for (std::uint32_t j = from; j < to; j += LANES) {
      const Seen seen = see(j, to, offset);
      std::uint64_t near = less(seen.squared, lane_real{} + reach_);
      if (to - j < LANES) near &= SLOT(to - j) - SLOT(0);
      for (; near != 0; near &= near - 1) {
        const int lane = LOWEST(near);
        const std::uint32_t site = j + static_cast<std::uint32_t>(lane);
        if (site == site_) continue;
        any = cut(seen.x[lane], seen.y[lane], seen.z[lane], seen.squared[lane],
                  static_cast<std::int32_t>(site)) ||
              any;
        if (cell_.empty || cell_.overflow) return;
      }
    }
    if (any) measure();
  }

  bool cut(REAL dx, REAL dy, REAL dz, REAL squared, std::int32_t name) {
    const std::uint64_t removed = verticesBeyond(cell_, dx, dy, dz, 0.5F * squared);
    if (removed == 0) return false;
    cutOff(cell_, removed, name);
    return true;
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
  Polyhedron cell_;
  Nearest nearest_;
};

}  // namespace

// NOLINTNEXTLINE(misc-use-internal-linkage): declared by lane_width.cpp
void VORPIPE_LANES_FUNCTION(const LaneBins& bins, std::uint32_t bin, std::uint32_t first, std::uint32_t last,
                            void (*take)(void*, std::uint32_t, const ProposedCell&), void* context) {
  Walk walk(bins);
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

}  // namespace vorpipe::space

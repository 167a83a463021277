// Compiled once for each set of instructions.
#include "space/polyhedron_lanes.h"

#include "space/polyhedron_words.h"

namespace vorpipe::space {
namespace {

#include "polyhedron.glsl"

/// Candidates near a site, in the order in which they cut.
struct Nearest {
  // A vector of candidates may be written behind the last.
  float squared[SLOTS + LANES], x[SLOTS + LANES], y[SLOTS + LANES], z[SLOTS + LANES];
  std::int32_t site[SLOTS + LANES], key[SLOTS];
  std::uint8_t order[SLOTS];
  int count;

  /// Sorts by distance. Keys are distances whose last bits are indices, so that no two are equal; the rank of
  /// each is the number of keys that are less.
  void sort() {
    constexpr int index_bits = SLOTS - 1;
    for (int k = 0; k < SLOTS; ++k) {
      std::int32_t bits;
      __builtin_memcpy(&bits, squared + k, sizeof bits);
      key[k] = k < count ? (bits & ~index_bits) | k : 0x7FFFFFFF;
    }
    const int blocks = (count + LANES - 1) / LANES;
    for (int k = 0; k < count; ++k) {
      int rank = 0;
      for (int b = 0; b < blocks; ++b) rank += COUNT(less(loadInts(key + b * LANES), lane_truth{} + key[k]));
      order[rank] = static_cast<std::uint8_t>(k);
    }
  }
};

/// Rounding of what is compared with the radius: coordinates of a bin in float, differences and squares.
constexpr float safety = 1.00001F;

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
    float low[3], high[3];
    std::size_t part = 0;
    for (int axis = 2; axis >= 0; --axis) {
      bin_[axis] = bin[axis];
      place_[axis] = place[axis];
      const int along = static_cast<int>(place[axis] / bins_.side * parts_of_bin);
      part = part * parts_of_bin + static_cast<std::size_t>(min(parts_of_bin - 1, max(0, along)));
      const float from_domain = static_cast<float>(bin[axis]) * bins_.side + bins_.corner[axis];
      low[axis] = -place[axis] - from_domain;
      high[axis] = bins_.extent[axis] - from_domain - place[axis];
    }
    steps_ = bins_.steps + part * bins_.step_count;
    side_squared_ = bins_.side * bins_.side;
    beginPolyhedron(cell_, low[0], low[1], low[2], high[0], high[1], high[2]);
    measure();
  }

  /// Sites farther than twice the radius do not cut.
  void measure() { reach_ = 4 * safety * squaredRadius(cell_); }

  /// Returns whether there is such a bin; its sites, and where it lies from the site.
  bool bin(const BinStep& step, std::uint32_t& from, std::uint32_t& to, float (&offset)[3]) const {
    const int at[3] = {bin_[0] + step.x, bin_[1] + step.y, bin_[2] + step.z};
    for (int axis = 0; axis < 3; ++axis) {
      if (at[axis] < 0 || at[axis] >= bins_.count[axis]) return false;
    }
    const std::size_t index = (static_cast<std::size_t>(at[2]) * static_cast<std::size_t>(bins_.count[1]) +
                               static_cast<std::size_t>(at[1])) *
                                  static_cast<std::size_t>(bins_.count[0]) +
                              static_cast<std::size_t>(at[0]);
    from = bins_.begin[index];
    to = bins_.begin[index + 1];
    offset[0] = static_cast<float>(step.x) * bins_.side - place_[0];
    offset[1] = static_cast<float>(step.y) * bins_.side - place_[1];
    offset[2] = static_cast<float>(step.z) * bins_.side - place_[2];
    return true;
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
        const lane_real dx = load(bins_.x + j) + offset[0], dy = load(bins_.y + j) + offset[1],
                        dz = load(bins_.z + j) + offset[2];
        store(nearest_.x + k, dx);
        store(nearest_.y + k, dy);
        store(nearest_.z + k, dz);
        store(nearest_.squared + k, dx * dx + dy * dy + dz * dz);
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

  void cutBin(const BinStep& step) {
    std::uint32_t from, to;
    float offset[3];
    if (!bin(step, from, to, offset)) return;
    bool any = false;
    for (std::uint32_t j = from; j < to; j += LANES) {
      const lane_real dx = load(bins_.x + j) + offset[0], dy = load(bins_.y + j) + offset[1],
                      dz = load(bins_.z + j) + offset[2];
      const lane_real squared = dx * dx + dy * dy + dz * dz;
      std::uint64_t near = less(squared, lane_real{} + reach_);
      if (to - j < LANES) near &= SLOT(to - j) - SLOT(0);
      for (; near != 0; near &= near - 1) {
        const int lane = LOWEST(near);
        const std::uint32_t site = j + static_cast<std::uint32_t>(lane);
        if (site == site_) continue;
        any = cut(dx[lane], dy[lane], dz[lane], squared[lane], static_cast<std::int32_t>(site)) || any;
        if (cell_.empty || cell_.overflow) return;
      }
    }
    if (any) measure();
  }

  bool cut(float dx, float dy, float dz, float squared, std::int32_t name) {
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
  float place_[3] = {}, side_squared_ = 0, reach_ = 0;
  Polyhedron cell_;
  Nearest nearest_;
};

}  // namespace

// NOLINTNEXTLINE(misc-use-internal-linkage): declared by polyhedron_width.cpp
void VORPIPE_LANES_FUNCTION(const LaneBins& bins, std::uint32_t bin_begin, std::uint32_t bin_end,
                            void (*take)(void*, std::uint32_t, const ProposedCell&), void* context) {
  Walk walk(bins);
  ProposedCell proposed;
  for (std::uint32_t index = bin_begin; index < bin_end; ++index) {
    const auto nx = static_cast<std::uint32_t>(bins.count[0]), ny = static_cast<std::uint32_t>(bins.count[1]);
    const int bin[3] = {static_cast<int>(index % nx), static_cast<int>(index / nx % ny),
                        static_cast<int>(index / nx / ny)};
    for (std::uint32_t site = bins.begin[index]; site < bins.begin[index + 1]; ++site) {
      walk.find(site, bin, proposed);
      take(context, site, proposed);
    }
  }
}

}  // namespace vorpipe::space

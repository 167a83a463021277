// The walk of grid.glsl for VORPIPE_LANES cells at a time. Compiled once for each set of instructions.
#include "backend/cpu/grid_lanes.h"

#include "backend/cpu/lane_clip.h"

namespace vorpipe::cpu {
namespace {
namespace lanes {

template <int Edges>
class Group {
 public:
  explicit Group(const LaneJob& job) : job_(job) { walk_.first = job.first; }

  /// Finds the cells from `begin` on, as many as there are lanes, or up to the end.
  void find(std::size_t begin) {
    const auto left = job_.count - begin;
    const auto used = left < width ? left : width;
    for (std::size_t lane = 0; lane < width; ++lane)
      start(lane, job_.which[begin + (lane < used ? lane : 0)]);
    clip_.beginCell(cell_, walls());
    certain_ = everyBool(true);
    cutByBlock();
    tryAround();
    write(begin, used);
  }

 private:
  using Cells = Clip<Many, Edges>;
  using Bins = Walk<Single>;
  static constexpr std::size_t most_hits = 16;

  /// What differs from cell to cell and is not geometry.
  struct Lane {
    double site_x, site_y;
    int self, column, row, tried;
    Bins::Bins bins;
    bool unknown;
    Feed feed;
    std::size_t hits;
    int hit[most_hits];
  };

  void start(std::size_t l, std::uint32_t site) {
    auto& lane = lane_[l];
    const auto* domain = job_.domain;
    const double site_x = job_.x[site];
    const double site_y = job_.y[site];
    const double x = max(domain[0], min(domain[2], site_x));
    const double y = max(domain[1], min(domain[3], site_y));
    lane.site_x = site_x;
    lane.site_y = site_y;
    lane.self = static_cast<int>(site);
    lane.unknown = false;
    self_[l] = lane.self;
    shift_x_[l] = static_cast<float>(site_x - x);
    shift_y_[l] = static_cast<float>(site_y - y);
    for (std::size_t side = 0; side < 4; ++side) {
      walls_[side][l] = static_cast<float>(domain[side] - (side % 2 == 0 ? x : y));
    }
    auto& bins = lane.bins;
    bins.columns = job_.columns;
    bins.rows = job_.rows;
    bins.size = static_cast<float>(job_.size);
    bins.low = {static_cast<float>(job_.grid_xmin - x), static_cast<float>(job_.grid_ymin - y)};
    const float width_there = bins.low.x + static_cast<float>(bins.columns) * bins.size;
    const float height_there = bins.low.y + static_cast<float>(bins.rows) * bins.size;
    // Coordinates of bins are sums of floats as large as the grid.
    bins.slack =
        4.8e-7F * max(max(abs(bins.low.x), abs(width_there)), max(abs(bins.low.y), abs(height_there)));
    bins.known = {static_cast<float>(job_.known[0] - x), static_cast<float>(job_.known[1] - y),
                  static_cast<float>(job_.known[2] - x), static_cast<float>(job_.known[3] - y)};
    bins.most = job_.most;
    lane.column = walk_.binAlong(-bins.low.x / bins.size, bins.columns);
    lane.row = walk_.binAlong(-bins.low.y / bins.size, bins.rows);
  }

  static Reals load(const float (&values)[width]) {
    Reals all;
    __builtin_memcpy(&all, values, sizeof all);
    return all;
  }
  static Ints load(const int (&values)[width]) {
    Ints all;
    __builtin_memcpy(&all, values, sizeof all);
    return all;
  }

  typename Cells::vec4 walls() {
    view_.self = load(self_);
    view_.shift = {load(shift_x_), load(shift_y_)};
    view_.outset = {everyReal(job_.outset_x), everyReal(job_.outset_y)};
    return {load(walls_[0]) - view_.outset.x, load(walls_[1]) - view_.outset.y,
            load(walls_[2]) + view_.outset.x, load(walls_[3]) + view_.outset.y};
  }

  /// Turns every lane to a site.
  void turnTo(const int (&place)[width]) {
    float dx[width];
    float dy[width];
    for (std::size_t l = 0; l < width; ++l) {
      dx[l] = static_cast<float>(job_.x[place[l]] - lane_[l].site_x);
      dy[l] = static_cast<float>(job_.y[place[l]] - lane_[l].site_y);
    }
    clip_.offset = {load(dx), load(dy)};
    place_ = load(place);
  }

  void cut() {
    const auto b = clip_.bisectorWith(view_, place_);
    clip_.cutCell(cell_, b.n, b.h, place_);
    certain_ &= b.apart | (place_ == view_.self);
  }

  int longestFeed() const {
    int longest = 0;
    for (const auto& lane : lane_) longest = max(longest, lane.feed.count);
    return longest;
  }

  void cutByBlock() {
    for (auto& lane : lane_) {
      lane.feed.clear();
      for (int r = 0; r < BLOCK_RUNS; ++r) {
        const auto part = walk_.partOfBlock(lane.bins, r, lane.column, lane.row);
        const auto span = walk_.sitesOf(lane.bins, part);
        lane.feed.add(span.first, span.behind);
      }
      lane.tried = lane.feed.count;
      if (lane.tried > job_.most) lane.feed.clear();
    }
    int place[width];
    for (int i = longestFeed(); i > 0; --i) {
      for (std::size_t l = 0; l < width; ++l) place[l] = lane_[l].feed.take(lane_[l].self);
      turnTo(place);
      cut();
    }
  }

  /// Puts what a step of the search tries into the feeds; false once there is nothing left.
  bool feedStep(int step) {
    const auto box = clip_.flowerBox(cell_, view_.shift);
    const Ints over = cell_.overflow | cell_.empty;
    bool some = false;
    for (std::size_t l = 0; l < width; ++l) {
      auto& lane = lane_[l];
      lane.feed.clear();
      const auto& known = lane.bins.known;
      const Single::vec4 seen{box.x[l], box.y[l], box.z[l], box.w[l]};
      lane.unknown = seen.x < known.x || seen.y < known.y || seen.z > known.z || seen.w > known.w;
      if (over[l] != 0 || lane.tried > job_.most) continue;
      const auto range = walk_.binsOf(lane.bins, seen);
      if (step > 0 && !walk_.isLeft(range, step, lane.column, lane.row)) continue;
      for (int r = 0; r < MOST_RUNS; ++r) {
        const auto part = walk_.partOfStep(range, step, r, lane.column, lane.row);
        if (part.from > part.to) continue;
        const auto span = walk_.sitesOf(lane.bins, part);
        lane.feed.add(span.first, span.behind);
      }
      some = true;
      lane.tried += lane.feed.count + MOST_RUNS;
      if (lane.tried > job_.most) lane.feed.clear();
    }
    return some;
  }

  void tryAround() {
    for (int step = 0; feedStep(step); ++step) {
      for (auto& lane : lane_) lane.hits = 0;
      auto vertices = clip_.verticesOf(cell_);
      int place[width];
      for (int i = longestFeed(); i > 0; --i) {
        for (std::size_t l = 0; l < width; ++l) place[l] = lane_[l].feed.take(lane_[l].self);
        turnTo(place);
        const Ints hit = clip_.mayCut(vertices, view_, place_);
        bool full = false;
        for (std::size_t l = 0; l < width; ++l) {
          auto& lane = lane_[l];
          lane.hit[lane.hits] = place[l];
          lane.hits += static_cast<std::size_t>(-hit[l]);
          full = full || lane.hits == most_hits;
        }
        if (full || i == 1) {
          cutByHits();
          vertices = clip_.verticesOf(cell_);
        }
      }
    }
  }

  void cutByHits() {
    std::size_t most = 0;
    for (const auto& lane : lane_) most = lane.hits > most ? lane.hits : most;
    int place[width];
    for (std::size_t h = 0; h < most; ++h) {
      for (std::size_t l = 0; l < width; ++l) place[l] = h < lane_[l].hits ? lane_[l].hit[h] : lane_[l].self;
      turnTo(place);
      cut();
    }
    for (auto& lane : lane_) lane.hits = 0;
  }

  void write(std::size_t begin, std::size_t used) {
    int unsecured[width];
    for (std::size_t l = 0; l < width; ++l) {
      unsecured[l] = lane_[l].unknown || lane_[l].tried > job_.most ? -1 : 0;
    }
    const Ints status = clip_.outcome(cell_, load(unsecured) | ~certain_);
    for (std::size_t l = 0; l < used; ++l) job_.status[begin + l] = static_cast<std::uint8_t>(status[l]);
    if (job_.neighbors == nullptr) return;
    typename Cells::Order order;
    clip_.orderEdges(cell_, order);
    for (std::size_t l = 0; l < used; ++l) {
      const bool certified = status[l] == CELL_CERTIFIED;
      job_.neighbor_counts[begin + l] = static_cast<std::uint8_t>(certified ? order.count[l] : 0);
      if (!certified) continue;
      auto* to = job_.neighbors + (begin + l) * Edges;
      for (std::size_t k = 0; k < Edges; ++k) {
        if (order.rank[k][l] >= 0) to[order.rank[k][l]] = cell_.line[k][l];
      }
    }
  }

  const LaneJob& job_;
  Bins walk_;
  Cells clip_;
  typename Cells::Cell cell_;
  typename Cells::Viewpoint view_;
  Ints place_, certain_;
  Lane lane_[width];
  int self_[width];
  float shift_x_[width], shift_y_[width], walls_[4][width];
};

template <int Edges>
void findAll(const LaneJob& job) {
  Group<Edges> group(job);
  for (std::size_t begin = 0; begin < job.count; begin += width) group.find(begin);
}

}  // namespace lanes
}  // namespace

void VORPIPE_LANES_FUNCTION(const LaneJob& job, bool roomy) {
  if (roomy) {
    lanes::findAll<EDGES_MOST>(job);
  } else {
    lanes::findAll<EDGES_FAST>(job);
  }
}

}  // namespace vorpipe::cpu

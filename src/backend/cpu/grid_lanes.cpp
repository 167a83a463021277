// The walk of grid.glsl for VORPIPE_LANES cells at a time. Compiled once for each set of instructions.
#include "backend/cpu/grid_lanes.h"

#include "backend/cpu/lane_clip.h"
#include "backend/cpu/lane_feed.h"
#include "backend/cpu/lane_order.h"

namespace vorpipe::cpu {
namespace {
namespace lanes {

template <int Edges>
class Group {
 public:
  explicit Group(const LaneJob& job) : job_(job) {
    walk_.bin_starts = job.first;
#ifdef WEIGHTED
    walk_.heaviest = job.heaviest;
    walk_.heavy = job.heavy;
#endif
  }

  /// Finds cells of the job, at most as many as there are lanes.
  void find(const std::uint32_t* cells, std::size_t count) {
    for (std::size_t lane = 0; lane < width; ++lane) {
      start(lane, job_.which[cells[lane < count ? lane : 0]]);
    }
    clip_.beginCell(cell_, walls());
    certain_ = everyBool(true);
    cutByBlock();
    tryAround();
    write(cells, count);
  }

 private:
  using Cells = Clip<Many, Edges>;
#ifdef WEIGHTED
  static constexpr std::size_t room = Edges + 1;
#else
  static constexpr std::size_t room = Edges;
#endif

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
    lane.done = false;
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
#ifdef WEIGHTED
    bins.heavy = job_.heavy_count;
    lane.weight = walk_.weight = job_.weight[site];
    lead_[l] = walk_.leadOfAll(bins);
#endif
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
#ifdef WEIGHTED
    float against[width];
    for (std::size_t l = 0; l < width; ++l) against[l] = leadOver(lane_[l].weight, job_.weight[place[l]]);
    clip_.against_next = load(against);
#endif
    place_ = load(place);
  }

  /// again: heavy sites may have cut before. Not inline: alone, its loops have the registers to themselves.
  [[gnu::noinline]] void cut([[maybe_unused]] bool again) {
    auto b = clip_.bisectorWith(view_, place_);
#ifdef WEIGHTED
    if (again) b.h = clip_.hasEdge(cell_, place_) ? FAR : b.h;
#endif
    clip_.cutCell(cell_, b.n, b.h, place_);
    certain_ &= b.apart | (place_ == view_.self);
  }

  [[nodiscard]] int longestFeed() const {
    int longest = 0;
    for (const auto& lane : lane_) longest = max(longest, lane.feed.count);
    return longest;
  }

  void cutByBlock() {
    for (auto& lane : lane_) {
      lane.feedBlock(walk_);
      lane.tried = lane.feed.count;
      if (lane.tried > job_.most) lane.feed.clear();
    }
    int place[width];
    for (int i = longestFeed(); i > 0; --i) {
      for (std::size_t l = 0; l < width; ++l) place[l] = lane_[l].feed.take(lane_[l].self);
      turnTo(place);
      cut(false);
    }
  }

#ifdef WEIGHTED
  /// As in grid.glsl; lanes that are done keep theirs.
  typename Cells::vec4 boxLeft(int rounds) {
    view_.lead = load(lead_);
    auto box = clip_.flowerBox(cell_, view_);
    for (int round = 0; round < rounds; ++round) {
      for (std::size_t l = 0; l < width; ++l) {
        const auto& lane = lane_[l];
        if (lane.done) continue;
        walk_.weight = lane.weight;
        const auto range = walk_.binsOf(lane.bins, {box.x[l], box.y[l], box.z[l], box.w[l]});
        lead_[l] = min(lead_[l], walk_.leadIn(lane.bins, range));
      }
      view_.lead = load(lead_);
      box = clip_.flowerBox(cell_, view_);
    }
    return box;
  }

  int firstStep() { return walk_.firstStep(lane_[0].bins); }
#else
  auto boxLeft(int) { return clip_.flowerBox(cell_, view_); }
  static int firstStep() { return 0; }
#endif

  /// Puts what a step of the search tries into the feeds; false once there is nothing left.
  bool feedStep(int step) {
    const auto box = boxLeft(step == firstStep() ? 2 : 1);
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
      if (step > 0 && !walk_.isLeft(range, step, lane.column, lane.row)) {
        lane.done = true;
        continue;
      }
      lane.feedStep(walk_, range, step);
      some = true;
      lane.tried += lane.feed.count + MOST_RUNS;
      if (lane.tried > job_.most) lane.feed.clear();
    }
    return some;
  }

  void tryAround() {
    for (int step = firstStep(); feedStep(step); ++step) {
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
          full = full || lane.hits == Lane::most_hits;
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
      cut(true);
    }
    for (auto& lane : lane_) lane.hits = 0;
  }

  void write(const std::uint32_t* cells, std::size_t used) {
    int unsecured[width];
    for (std::size_t l = 0; l < width; ++l) {
      unsecured[l] = lane_[l].unknown || lane_[l].tried > job_.most ? -1 : 0;
    }
    const Ints status = clip_.outcome(cell_, load(unsecured) | ~certain_);
    for (std::size_t l = 0; l < used; ++l) job_.status[cells[l]] = static_cast<std::uint8_t>(status[l]);
    if (job_.neighbors == nullptr) return;
    typename Cells::Order order;
    clip_.orderEdges(cell_, order);
    for (std::size_t l = 0; l < used; ++l) {
      const bool certified = status[l] == CELL_CERTIFIED;
      auto& count = job_.neighbor_counts[cells[l]];
      count = static_cast<std::uint8_t>(certified ? order.count[l] : 0);
      auto* to = job_.neighbors + cells[l] * room;
      for (std::size_t k = 0; k < Edges; ++k) {
        if (certified && order.rank[k][l] >= 0) to[order.rank[k][l]] = cell_.line[k][l];
      }
#ifdef WEIGHTED
      if (status[l] != CELL_EMPTY) continue;
      count = room;
      for (std::size_t k = 0; k < Edges; ++k) to[k] = cell_.line[k][l];
      to[Edges] = cell_.last[l];
#endif
    }
  }

  const LaneJob& job_;
  Walk<Single> walk_;
  Cells clip_;
  typename Cells::Cell cell_;
  typename Cells::Viewpoint view_;
  Ints place_, certain_;
  Lane lane_[width];
  int self_[width];
  float shift_x_[width], shift_y_[width], walls_[4][width];
#ifdef WEIGHTED
  float lead_[width];
#endif
};

template <int Edges>
void findAll(const LaneJob& job) {
  Group<Edges> group(job);
  LaneOrder order;
  for (std::size_t begin = 0; begin < job.count; begin += LaneOrder::most) {
    const auto left = job.count - begin;
    const auto count = left < LaneOrder::most ? left : LaneOrder::most;
    order.sort(job, begin, count);
    for (std::size_t k = 0; k < count; k += width) {
      group.find(order.cell + k, count - k < width ? count - k : width);
    }
  }
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

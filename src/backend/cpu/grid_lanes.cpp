// The search of grid.glsl for VORPIPE_LANES cells at a time. Compiled once for each set of instructions.
#include "backend/cpu/grid_lanes.h"

#include "backend/cpu/lane_clip.h"
#include "backend/cpu/lane_order.h"

namespace vorpipe::cpu {
namespace {
namespace lanes {

/// Cells in lanes, and the state of the search for each. Cells are given as index in the job.
template <int Edges>
struct Searched {
  using Cells = Clip<Many, Edges>;

  std::uint32_t which[width] = {};
  std::size_t count = 0;
  typename Cells::Cell cell{};
  typename Cells::Search search{};

  /// Takes over a cell from a lane of `from`.
  void add(const Searched& from, std::size_t lane) {
    which[count] = from.which[lane];
    for (std::size_t k = 0; k < Edges; ++k) {
      cell.nx[k][count] = from.cell.nx[k][lane];
      cell.ny[k][count] = from.cell.ny[k][lane];
      cell.h[k][count] = from.cell.h[k][lane];
      cell.lo[k][count] = from.cell.lo[k][lane];
      cell.hi[k][count] = from.cell.hi[k][lane];
      cell.line[k][count] = from.cell.line[k][lane];
    }
    cell.empty[count] = from.cell.empty[lane];
    cell.overflow[count] = from.cell.overflow[lane];
    search.tried[count] = from.search.tried[lane];
    search.certain[count] = from.search.certain[lane];
    search.left[count] = from.search.left[lane];
    search.box.x[count] = from.search.box.x[lane];
    search.box.y[count] = from.search.box.y[lane];
    search.box.z[count] = from.search.box.z[lane];
    search.box.w[count] = from.search.box.w[lane];
#ifdef WEIGHTED
    cell.last[count] = from.cell.last[lane];
    search.view.weight_excess[count] = from.search.view.weight_excess[lane];
#endif
    ++count;
  }
};

template <int Edges>
class LaneFinder {
 public:
  explicit LaneFinder(const LaneJob& job) : job_(job) {
    clip_.sites_x = job.x;
    clip_.sites_y = job.y;
    clip_.bin_starts = job.offsets;
#ifdef WEIGHTED
    clip_.weights = job.weight;
    clip_.heaviest = job.heaviest;
    clip_.heavy = job.heavy;
#endif
  }

  /// Cuts cells of the job, at most one per lane, by the block of bins around each. Cells that must look
  /// beyond their block wait until there is one for each lane, grouped by the number of such sides.
  void find(const std::uint32_t* cells, std::size_t count) {
    for (std::size_t l = 0; l < width; ++l) near_.which[l] = cells[l < count ? l : 0];
    near_.count = count;
    const auto around = surroundingsOf(near_);
    near_.search = clip_.searchBlock(near_.cell, around.bins, around.walls, around.outset, around.self,
                                     around.origin_offset);
    write(near_, around);
    const Ints sides = sidesBeyond(around.bins, near_.search);
    for (std::size_t l = 0; l < count; ++l) {
      if (near_.search.left[l] == 0) continue;
      auto& far = far_[max(1, min(sides[l], most_sides)) - 1];
      far.add(near_, l);
      if (far.count == width) finish(far);
    }
  }

  /// Finishes the cells that wait.
  void finish() {
    for (auto& far : far_) {
      if (far.count > 0) finish(far);
    }
  }

 private:
  using Cells = Clip<Many, Edges>;
  /// Cells that look beyond more sides are rare, and wait with those of this many.
  static constexpr int most_sides = 3;

  void finish(Searched<Edges>& far) {
    for (auto l = far.count; l < width; ++l) {
      far.which[l] = far.which[0];
      far.search.left[l] = 0;
    }
    const auto around = surroundingsOf(far);
    auto search = clip_.searchFrom(around.bins, around.outset, around.self, around.origin_offset);
    search.tried = far.search.tried;
    search.certain = far.search.certain;
    search.left = far.search.left;
    search.box = far.search.box;
#ifdef WEIGHTED
    search.view.weight_excess = far.search.view.weight_excess;
#endif
    clip_.searchBeyond(far.cell, around.bins, search);
    far.search = search;
    write(far, around);
    far.count = 0;
  }

  /// Returns for each cell the number of sides of its block beyond which sites may be that can cut it.
  Ints sidesBeyond(const typename Cells::Bins& bins, const typename Cells::Search& search) {
    const auto range = clip_.binsOf(bins, search.box);
    return -((range.west < search.column - 1) + (range.east > search.column + 1) +
             (range.south < search.row - 1) + (range.north > search.row + 1));
  }

  using vec2 = typename Cells::vec2;
  using vec4 = typename Cells::vec4;
#ifdef WEIGHTED
  static constexpr std::size_t room = Edges + 1;
#else
  static constexpr std::size_t room = Edges;
#endif

  /// By lane: the cell's site, and the data it is clipped with, relative to the origin of the cell.
  struct Surroundings {
    Ints self;
    typename Cells::Bins bins;
    vec4 walls;
    vec2 outset, origin_offset;
  };

  /// Sets the clipping up for the sites of `cells`, one in each lane.
  Surroundings surroundingsOf(const Searched<Edges>& cells) {
    Surroundings around;
    for (std::size_t l = 0; l < width; ++l) around.self[l] = static_cast<int>(job_.which[cells.which[l]]);
    const Doubles site_x = clip_.site_x = gather(job_.x, around.self);
    const Doubles site_y = clip_.site_y = gather(job_.y, around.self);
#ifdef WEIGHTED
    clip_.weight = gather(job_.weight, around.self);
#endif
    const Doubles x = max(job_.domain[0] - Doubles{}, min(job_.domain[2] - Doubles{}, site_x));
    const Doubles y = max(job_.domain[1] - Doubles{}, min(job_.domain[3] - Doubles{}, site_y));
    around.bins = binsFrom(x, y);
    around.walls = boxFrom(job_.domain, x, y);
    around.outset = {everyReal(job_.outset_x), everyReal(job_.outset_y)};
    around.origin_offset = {toReals(site_x - x), toReals(site_y - y)};
    return around;
  }

  /// Returns a box relative to the origins of the cells.
  static vec4 boxFrom(const double (&box)[4], const Doubles& x, const Doubles& y) {
    return {toReals(box[0] - x), toReals(box[1] - y), toReals(box[2] - x), toReals(box[3] - y)};
  }

  typename Cells::Bins binsFrom(const Doubles& x, const Doubles& y) const {
    typename Cells::Bins bins;
    bins.columns = job_.columns;
    bins.rows = job_.rows;
    bins.size = everyReal(job_.size);
    bins.low = {toReals(job_.grid_xmin - x), toReals(job_.grid_ymin - y)};
    const Reals east = bins.low.x + everyReal(bins.columns) * bins.size;
    const Reals north = bins.low.y + everyReal(bins.rows) * bins.size;
    // Coordinates of bins are sums of floats as large as the grid.
    bins.slack = 4.8e-7F * max(max(abs(bins.low.x), abs(east)), max(abs(bins.low.y), abs(north)));
    bins.coverage = boxFrom(job_.coverage, x, y);
    bins.most = job_.most;
#ifdef WEIGHTED
    bins.heavy = job_.heavy_count;
#endif
    return bins;
  }

  /// Writes the statuses and neighbors of those cells that have nothing left to search.
  void write(const Searched<Edges>& cells, const Surroundings& around) {
    const Ints status = clip_.outcomeOf(cells.cell, around.bins, cells.search);
    for (std::size_t l = 0; l < cells.count; ++l) {
      if (cells.search.left[l] == 0) job_.status[cells.which[l]] = static_cast<std::uint8_t>(status[l]);
    }
    if (job_.neighbors == nullptr) return;
    typename Cells::Order order;
    clip_.orderEdges(cells.cell, order);
    clip_.beginAtFirst(cells.cell, order);
    for (std::size_t l = 0; l < cells.count; ++l) {
      if (cells.search.left[l] == 0) writeNeighbors(cells, order, l, status[l]);
    }
  }

  void writeNeighbors(const Searched<Edges>& cells, const typename Cells::Order& order, std::size_t l,
                      int status) {
    const auto which = cells.which[l];
    const bool certified = status == CELL_CERTIFIED;
    auto& count = job_.neighbor_counts[which];
    count = static_cast<std::uint8_t>(certified ? order.count[l] : 0);
    auto* to = job_.neighbors + which * room;
    for (std::size_t k = 0; k < Edges; ++k) {
      if (certified && order.rank[k][l] >= 0) to[order.rank[k][l]] = cells.cell.line[k][l];
    }
#ifdef WEIGHTED
    if (status != CELL_EMPTY) return;
    count = room;
    for (std::size_t k = 0; k < Edges; ++k) to[k] = cells.cell.line[k][l];
    to[Edges] = cells.cell.last[l];
#endif
  }

  const LaneJob& job_;
  Cells clip_;
  Searched<Edges> near_;
  Searched<Edges> far_[most_sides];  ///< by the number of sides beyond which they look
};

template <int Edges>
void findAll(const LaneJob& job) {
  LaneFinder<Edges> finder(job);
  LaneOrder order;
  for (std::size_t begin = 0; begin < job.count; begin += LaneOrder::most) {
    const auto left = job.count - begin;
    const auto count = left < LaneOrder::most ? left : LaneOrder::most;
    order.sort(job, begin, count);
    for (std::size_t k = 0; k < count; k += width) {
      finder.find(order.cell + k, count - k < width ? count - k : width);
    }
  }
  finder.finish();
}

}  // namespace lanes
}  // namespace

void VORPIPE_LANES_FUNCTION(const LaneJob& job, bool large) {
  if (large) {
    lanes::findAll<EDGES_MOST>(job);
  } else {
    lanes::findAll<EDGES_FAST>(job);
  }
}

}  // namespace vorpipe::cpu

// The search of grid.glsl for VORPIPE_LANES cells at a time. Compiled once for each set of instructions.
#include "backend/cpu/grid_lanes.h"

#include "backend/cpu/lane_clip.h"
#include "backend/cpu/lane_order.h"

namespace vorpipe::cpu {
namespace {
namespace lanes {

template <int Edges>
class Group {
 public:
  explicit Group(const LaneJob& job) : job_(job) {
    clip_.sites_x = job.x;
    clip_.sites_y = job.y;
    clip_.bin_starts = job.first;
#ifdef WEIGHTED
    clip_.weights = job.weight;
    clip_.heaviest = job.heaviest;
    clip_.heavy = job.heavy;
#endif
  }

  /// Finds cells of the job, at most as many as there are lanes.
  void find(const std::uint32_t* cells, std::size_t count) {
    Ints self;
    for (std::size_t l = 0; l < width; ++l) self[l] = static_cast<int>(job_.which[cells[l < count ? l : 0]]);
    const Doubles site_x = clip_.site_x = gather(job_.x, self);
    const Doubles site_y = clip_.site_y = gather(job_.y, self);
#ifdef WEIGHTED
    clip_.weight = gather(job_.weight, self);
#endif
    const Doubles x = max(job_.domain[0] - Doubles{}, min(job_.domain[2] - Doubles{}, site_x));
    const Doubles y = max(job_.domain[1] - Doubles{}, min(job_.domain[3] - Doubles{}, site_y));
    const Ints status = clip_.clipSite(cell_, binsFrom(x, y), boxFrom(job_.domain, x, y),
                                       {everyReal(job_.outset_x), everyReal(job_.outset_y)}, self,
                                       {toReals(site_x - x), toReals(site_y - y)});
    for (std::size_t l = 0; l < count; ++l) job_.status[cells[l]] = static_cast<std::uint8_t>(status[l]);
    if (job_.neighbors != nullptr) write(status, cells, count);
  }

 private:
  using Cells = Clip<Many, Edges>;
#ifdef WEIGHTED
  static constexpr std::size_t room = Edges + 1;
#else
  static constexpr std::size_t room = Edges;
#endif

  /// A box as seen from the origins of the cells.
  static typename Cells::vec4 boxFrom(const double (&box)[4], const Doubles& x, const Doubles& y) {
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
    bins.known = boxFrom(job_.known, x, y);
    bins.most = job_.most;
#ifdef WEIGHTED
    bins.heavy = job_.heavy_count;
#endif
    return bins;
  }

  void write(const Ints& status, const std::uint32_t* cells, std::size_t used) {
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
  Cells clip_;
  typename Cells::Cell cell_;
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

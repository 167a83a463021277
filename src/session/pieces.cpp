#include "vorpipe/pieces.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/try.h"
#include "domain/degrees.h"
#include "domain/rings.h"
#include "geometry/polygon_measures.h"
#include "vorpipe.h"
#include "vorpipe/cell.h"

namespace vorpipe {
namespace {

/// The boxes of cells, for queries which of them meet another box.
class CellBoxes {
 public:
  /// Those of cells on the globe are in degrees, of each part that longitude 180 cuts off.
  CellBoxes(const Sites& sites, const Diagram& cells, bool on_globe) {
    for (const Cell cell : cells) {
      if (cell.status() != Status::ok) continue;
      if (!on_globe) {
        if (cell.edges() > 0) add(boxOf(cell.vertices()), cell.index());
        continue;
      }
      const Outline parts = globePolygons(sites, cells, cell.index());
      for (std::size_t r = 0; r + 1 < parts.ring_offsets.size(); ++r)
        add(grown(boxOf(core::ringAt(parts, r)), most_off), cell.index());
    }
    std::ranges::sort(boxes_, {}, [](const SiteBox& each) { return std::pair(each.box.xmin, each.site); });
  }

  /// Returns their sites, ascending.
  [[nodiscard]] std::vector<std::uint32_t> meeting(const Box& other) const {
    std::vector<std::uint32_t> sites;
    const auto xmin = [](const SiteBox& each) { return each.box.xmin; };
    auto at = std::ranges::lower_bound(boxes_, other.xmin - widest_, {}, xmin);
    for (; at != boxes_.end() && at->box.xmin <= other.xmax; ++at) {
      const Box& box = at->box;
      if (box.xmax >= other.xmin && box.ymin <= other.ymax && box.ymax >= other.ymin)
        sites.push_back(at->site);
    }
    std::ranges::sort(sites);
    sites.erase(std::unique(sites.begin(), sites.end()), sites.end());
    return sites;
  }

 private:
  /// Degrees by which globePolygons may be off.
  static constexpr double most_off = 1e-3;

  /// A box of degrees with what may be missing on each side.
  static Box grown(const Box& box, double off) {
    const double latitude = std::max(std::abs(box.ymin), std::abs(box.ymax)) * degree;
    const double across = off / std::max(std::cos(latitude), off);
    return {box.xmin - across, box.ymin - off, box.xmax + across, box.ymax + off};
  }

  void add(const Box& box, std::size_t site) {
    widest_ = std::max(widest_, box.xmax - box.xmin);
    boxes_.push_back({box, static_cast<std::uint32_t>(site)});
  }

  struct SiteBox {
    Box box;
    std::uint32_t site;
  };
  std::vector<SiteBox> boxes_;  ///< by xmin
  double widest_ = 0;
};

/// The sites whose cells on the globe may meet a region in degrees, ascending.
std::vector<std::uint32_t> meetingOnGlobe(const CellBoxes& boxes, const Outline& region) {
  Box box = boxOf(region.points);
  for (std::size_t r = 0; r + 1 < region.ring_offsets.size(); ++r) {
    double turn = 0;
    core::eachSide(core::ringAt(region, r),
                   [&](Point a, Point b) { turn += std::remainder(b.x - a.x, whole_turn); });
    if (std::abs(turn) < whole_turn / 2) continue;
    // It goes around a pole, the nearer one.
    box = {-whole_turn, box.ymin, whole_turn, box.ymax};
    (box.ymin + box.ymax < 0 ? box.ymin : box.ymax) = std::copysign(quarter_turn, box.ymin + box.ymax);
  }
  std::vector<std::uint32_t> sites;
  for (const double turn : {-whole_turn, 0.0, whole_turn}) {
    const auto some = boxes.meeting({box.xmin + turn, box.ymin, box.xmax + turn, box.ymax});
    sites.insert(sites.end(), some.begin(), some.end());
  }
  std::ranges::sort(sites);
  sites.erase(std::unique(sites.begin(), sites.end()), sites.end());
  return sites;
}

Sites chosen(const Sites& sites, std::span<const std::uint32_t> which) {
  Sites some;
  for (const std::uint32_t i : which) {
    some.x.push_back(sites.x[i]);
    some.y.push_back(sites.y[i]);
    if (!sites.weight.empty()) some.weight.push_back(sites.weight[i]);
  }
  return some;
}

/// Adds what only the runs of regions know to the report of all.
void addRegionReport(const Report& of_region, Report& all) {
  all.retried += of_region.retried;
  all.in_double += of_region.in_double;
  all.exact += of_region.exact;
  all.time_ms.cells += std::max(of_region.time_ms.cells, 0.0);
  const auto append = [](const std::vector<std::string>& from, std::vector<std::string>& to) {
    for (const std::string& line : from) {
      if (std::ranges::find(to, line) == to.end()) to.push_back(line);
    }
  };
  append(of_region.notes, all.notes);
  append(of_region.validation_messages, all.validation_messages);
  all.pipelines.insert(all.pipelines.end(), of_region.pipelines.begin(), of_region.pipelines.end());
}

/// Appends the cells of a region; `site_of` are their sites among all.
void addPieces(const Diagram& cells, std::span<const std::uint32_t> site_of, std::uint32_t region,
               Pieces& pieces) {
  Diagram& all = pieces.cells;
  double sum = 0;
  for (const Cell cell : cells) {
    if (cell.status() != Status::ok) continue;
    pieces.region.push_back(region);
    pieces.site.push_back(site_of[cell.index()]);
    all.status.push_back(Status::ok);
    all.owner.push_back(static_cast<std::uint32_t>(all.owner.size()));
    all.area.push_back(cell.area());
    all.perimeter.push_back(cell.perimeter());
    all.centroid.push_back(cell.centroid());
    const CellRings rings = cell.rings();
    for (std::size_t r = 0; r < rings.size(); ++r)
      all.ring_starts.push_back(all.vertices.size() + rings.begin(r) - cell.begin());
    all.vertices.insert(all.vertices.end(), cell.vertices().begin(), cell.vertices().end());
    for (const std::int64_t neighbor : cell.neighbors())
      all.neighbors.push_back(isWall(neighbor) ? neighbor : site_of[static_cast<std::size_t>(neighbor)]);
    all.edge_lengths.insert(all.edge_lengths.end(), cell.edgeLengths().begin(), cell.edgeLengths().end());
    all.cell_offsets.push_back(all.vertices.size());
    sum += cell.area();
  }
  pieces.region_area.push_back(sum);
}

/// Counts the sites that have a piece.
void countSites(std::size_t sites, Pieces& pieces) {
  std::vector<bool> has(sites);
  for (const std::uint32_t site : pieces.site) has[site] = true;
  Report& report = pieces.cells.report;
  report.ok = static_cast<std::uint64_t>(std::ranges::count(has, true));
  report.empty = sites - report.ok - report.duplicate;
}

}  // namespace

Result<Pieces> piecesOf(Session& session, const Sites& sites, const CellsOptions& options,
                        std::span<const Outline> regions, const EachRegion& each) {
  CellsOptions whole_options = options;
  whole_options.detail = Detail::polygons;
  VORPIPE_VAR(whole, session.cells(sites, whole_options));
  const CellBoxes boxes(sites, whole, options.globe);
  Pieces pieces;
  pieces.cells.report = std::move(whole.report);
  pieces.cells.cell_offsets = {0};
  whole = {};
  CellsOptions of_region = options;
  of_region.detail = std::max(options.detail, Detail::polygons);
  of_region.progress = {};
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const double part = static_cast<double>(r) / static_cast<double>(regions.size());
    if (options.progress && !options.progress("pieces", part))
      return tl::unexpected(Error{ErrorCode::cancelled, "cancelled"});
    of_region.outline = regions[r];
    of_region.domain = boxOf(regions[r].points);
    // In this box no other site is the nearest one.
    const auto near = options.globe ? meetingOnGlobe(boxes, regions[r]) : boxes.meeting(of_region.domain);
    const Sites some = chosen(sites, near);
    VORPIPE_LET(cells, session.cells(some, of_region));
    if (each) VORPIPE_TRY(each(some, of_region, cells));
    addRegionReport(cells.report, pieces.cells.report);
    addPieces(cells, near, static_cast<std::uint32_t>(r), pieces);
  }
  countSites(sites.size(), pieces);
  return pieces;
}

}  // namespace vorpipe

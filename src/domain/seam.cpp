#include "domain/periodic_records.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <tuple>
#include <unordered_map>

#include "backend/tie.h"
#include "geometry/polygon_measures.h"

namespace vorpipe::core {
namespace {

/// Relative to the distance of a corner from its site: how much its copies may differ by rounding, and by
/// ties, a few of which may follow each other in a row.
constexpr double rounding = 0x1p-50, ties = 1e-4;
/// Relative to the largest coordinate.
constexpr double place_rounding = 0x1p-50;
constexpr std::uint32_t none = ~std::uint32_t{0};

using Shift = std::array<std::int32_t, 2>;

Shift operator+(Shift a, Shift b) { return {a[0] + b[0], a[1] + b[1]}; }
Shift operator-(Shift a) { return {-a[0], -a[1]}; }

/// An edge of a site's cell to an image.
struct SeamEdge {
  std::uint32_t site, other;
  Shift shift;
  std::uint64_t edge;
  std::uint32_t copy = none;  ///< the same edge in the other cell
  [[nodiscard]] auto key() const { return std::tuple(site, other, shift); }
};

/// Sets of equal corners, up to whole periods (union-find with offsets); corners at equal positions are one.
class Corners {
 public:
  std::uint32_t at(Point p) {
    const auto [entry, added] = index_.try_emplace(p, static_cast<std::uint32_t>(place_.size()));
    if (added) {
      place_.push_back(p);
      above_.push_back(entry->second);
      shift_.push_back({0, 0});
    }
    return entry->second;
  }
  [[nodiscard]] std::uint32_t find(Point p) const {
    const auto entry = index_.find(p);
    return entry == index_.end() ? none : entry->second;
  }
  struct Root {
    std::uint32_t corner;
    Shift shift;  ///< from its copy of the root to the root
    friend bool operator==(const Root&, const Root&) = default;
  };
  [[nodiscard]] Root rootOf(std::uint32_t corner) const {
    Shift shift{0, 0};
    for (; above_[corner] != corner; corner = above_[corner]) shift = shift + shift_[corner];
    return {corner, shift};
  }
  /// Notes that two corners are one: a is b moved by a shift.
  void join(std::uint32_t a, std::uint32_t b, Shift shift) {
    const Root of_a = rootOf(a), of_b = rootOf(b);
    if (of_a.corner == of_b.corner) return;
    const Shift between = -of_a.shift + shift + of_b.shift;
    if (of_a.corner > of_b.corner) {
      above_[of_a.corner] = of_b.corner;
      shift_[of_a.corner] = between;
    } else {
      above_[of_b.corner] = of_a.corner;
      shift_[of_b.corner] = -between;
    }
  }
  [[nodiscard]] std::size_t size() const { return place_.size(); }
  [[nodiscard]] Point place(std::uint32_t corner) const { return place_[corner]; }

 private:
  struct Hash {
    std::size_t operator()(Point p) const {
      const auto x = std::bit_cast<std::uint64_t>(p.x + 0.0), y = std::bit_cast<std::uint64_t>(p.y + 0.0);
      std::uint64_t bits = (x ^ std::rotl(y, 32)) * 0x9E3779B97F4A7C15u;
      return bits ^ bits >> 29;
    }
  };
  struct Same {
    bool operator()(Point a, Point b) const { return a.x == b.x && a.y == b.y; }
  };
  std::unordered_map<Point, std::uint32_t, Hash, Same> index_;
  std::vector<Point> place_;
  std::vector<std::uint32_t> above_;
  std::vector<Shift> shift_;
};

class SeamRepair {
 public:
  SeamRepair(const PeriodicSites& placed, const ImagedSites& imaged, Diagram& diagram)
      : placed_(placed), imaged_(imaged), diagram_(diagram) {
    const Box& box = imaged.box;
    largest_ = std::max({std::abs(box.xmin), std::abs(box.xmax), std::abs(box.ymin), std::abs(box.ymax)});
  }

  bool run() {
    listEdges();
    for (const SeamEdge& edge : edges_) {
      if (!look(edge)) return false;
    }
    if (rough_.empty()) return true;
    joinCorners();
    moveCorners();
    return true;
  }

 private:
  [[nodiscard]] std::uint64_t next(std::uint32_t site, std::uint64_t edge) const {
    return edge + 1 < diagram_.cell_offsets[site + std::size_t{1}] ? edge + 1 : diagram_.cell_offsets[site];
  }
  [[nodiscard]] Point begin(const SeamEdge& edge) const { return diagram_.vertices[edge.edge]; }
  [[nodiscard]] Point end(const SeamEdge& edge) const {
    return diagram_.vertices[next(edge.site, edge.edge)];
  }
  [[nodiscard]] Point moved(Point p, Shift by) const {
    return {p.x + by[0] * placed_.axis[0].length, p.y + by[1] * placed_.axis[1].length};
  }
  [[nodiscard]] Point siteAt(std::uint32_t i) const { return {imaged_.sites.x[i], imaged_.sites.y[i]}; }

  static double apart(Point a, Point b) { return std::hypot(a.x - b.x, a.y - b.y); }

  void listEdges() {
    const auto count = static_cast<std::int64_t>(imaged_.count);
    for (std::uint32_t i = 0; i < imaged_.count; ++i) {
      for (auto e = diagram_.cell_offsets[i]; e < diagram_.cell_offsets[i + std::size_t{1}]; ++e) {
        if (diagram_.neighbors[e] < count) continue;
        const auto& image = imaged_.images[static_cast<std::size_t>(diagram_.neighbors[e] - count)];
        edges_.push_back({i, image.site, {image.shift[0], image.shift[1]}, e});
      }
    }
    std::ranges::sort(edges_, {}, &SeamEdge::key);
    for (SeamEdge& edge : edges_) {
      const auto key = std::tuple(edge.other, edge.site, -edge.shift);
      const auto copy = std::ranges::lower_bound(edges_, key, {}, &SeamEdge::key);
      if (copy != edges_.end() && copy->key() == key) {
        edge.copy = static_cast<std::uint32_t>(copy - edges_.begin());
      }
    }
  }

  /// How far away the sites that determine the ends of an edge may be. With weights, corners may be nearer to
  /// a site than its neighbors are, and neighbors set the length of ties.
  [[nodiscard]] double reachOf(const SeamEdge& edge) const {
    const Point site = siteAt(edge.site);
    const double of_ends = std::max(apart(begin(edge), site), apart(end(edge), site));
    if (imaged_.sites.weight.empty()) return of_ends;
    const double of_sites = apart(site, moved(siteAt(edge.other), edge.shift));
    return std::max(of_ends, tieScale(of_sites, shorterSide(placed_.domain())));
  }

  /// Compares an edge with its copy; returns false if they differ by more than ties explain.
  bool look(const SeamEdge& edge) {
    const double reach = reachOf(edge);
    double off = 0;
    if (edge.copy == none) {
      off = apart(begin(edge), end(edge));
    } else {
      const SeamEdge& copy = edges_[edge.copy];
      off = std::max(apart(begin(edge), moved(end(copy), edge.shift)),
                     apart(end(edge), moved(begin(copy), edge.shift)));
      if (off <= rounding * reach + place_rounding * largest_) return true;
    }
    rough_.push_back(static_cast<std::uint32_t>(&edge - edges_.data()));
    return off <= ties * reach + place_rounding * largest_;
  }

  void joinCorners() {
    for (const SeamEdge& edge : edges_) {
      const auto first = corners_.at(begin(edge)), last = corners_.at(end(edge));
      if (edge.copy == none) {
        corners_.join(first, last, {0, 0});
        continue;
      }
      const SeamEdge& copy = edges_[edge.copy];
      corners_.join(first, corners_.at(end(copy)), edge.shift);
      corners_.join(last, corners_.at(begin(copy)), edge.shift);
    }
    moves_.assign(corners_.size(), 0);
    for (const auto r : rough_) {
      for (const Point p : {begin(edges_[r]), end(edges_[r])}) {
        moves_[corners_.rootOf(corners_.find(p)).corner] = 1;
      }
    }
  }

  [[nodiscard]] std::optional<Corners::Root> movingRoot(Point p) const {
    const auto corner = corners_.find(p);
    if (corner == none) return {};
    const auto root = corners_.rootOf(corner);
    return moves_[root.corner] != 0 ? std::optional(root) : std::nullopt;
  }

  /// Rewrites all cells; in those with a corner that moves it removes edges whose ends become one.
  void moveCorners() {
    Diagram& d = diagram_;
    std::uint64_t out = 0, begin = 0;
    std::vector<std::optional<Corners::Root>> roots;
    for (std::uint32_t i = 0; i < imaged_.count; ++i) {
      const auto end = d.cell_offsets[i + std::size_t{1}];
      roots.clear();
      bool moves = false;
      for (auto e = begin; e < end; ++e) {
        roots.push_back(movingRoot(d.vertices[e]));
        moves = moves || roots.back();
      }
      const auto first = out;
      for (auto e = begin; e < end; ++e) {
        const auto& here = roots[e - begin];
        const auto& after = nextOf(roots, e - begin);
        if (here && after && *here == *after) continue;
        d.vertices[out] = here ? moved(corners_.place(here->corner), here->shift) : d.vertices[e];
        d.neighbors[out] = d.neighbors[e];
        d.edge_lengths[out++] = d.edge_lengths[e];
      }
      d.cell_offsets[i] = first;
      begin = end;
      if (moves) measureEdges(i, first, out);
    }
    d.cell_offsets[imaged_.count] = out;
    d.vertices.resize(out);
    d.neighbors.resize(out);
    d.edge_lengths.resize(out);
  }

  /// Measures edges anew: area and moments do not depend on ties, but the lengths of the other edges do.
  void measureEdges(std::uint32_t i, std::uint64_t first, std::uint64_t end) {
    Diagram& d = diagram_;
    d.perimeter[i] = 0;
    for (auto e = first; e < end; ++e) {
      const Point a = d.vertices[e], b = d.vertices[e + 1 < end ? e + 1 : first];
      d.edge_lengths[e] = lengthOf({b.x - a.x, b.y - a.y});
      d.perimeter[i] += d.edge_lengths[e];
    }
  }

  const PeriodicSites& placed_;
  const ImagedSites& imaged_;
  Diagram& diagram_;
  double largest_ = 0;
  std::vector<SeamEdge> edges_;
  std::vector<std::uint32_t> rough_;
  Corners corners_;
  std::vector<std::uint8_t> moves_;
};

}  // namespace

bool settleSeam(const PeriodicSites& placed, const ImagedSites& imaged, Diagram& diagram) {
  return SeamRepair(placed, imaged, diagram).run();
}

}  // namespace vorpipe::core

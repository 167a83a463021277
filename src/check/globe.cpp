// The promises of cells on the globe.
#include <nanoflann.hpp>

#include <numbers>
#include <unordered_map>

#include "check/checks.h"

namespace vorpipe::core::checks {
namespace {

constexpr double pi = std::numbers::pi, half_turn = 180;
constexpr double earth_area =
    510065621.7240887;  ///< km2, of WGS 84: 2 pi a^2 + pi b^2 / e ln((1 + e) / (1 - e))
constexpr double sphere_slack = 1e-12, outline_slack = 1e-5;

/// A place in space, and a fourth coordinate: of sites with weights, what makes the nearest of them in four
/// dimensions the one whose cell has a place of the sphere, x . v largest: |x - v|^2 + |v'|^2 - |v|^2 least,
/// where v' is the longest.
using SpaceVector = std::array<double, 4>;

SpaceVector toward(Point degrees) {
  const double x = degrees.x / half_turn * pi, y = degrees.y / half_turn * pi;
  return {std::cos(y) * std::cos(x), std::cos(y) * std::sin(x), std::sin(y), 0};
}

double chordOf(const SpaceVector& a, const SpaceVector& b) {
  return std::hypot(std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]), a[3] - b[3]);
}

/// The sites in space.
struct SphereVectors {
  std::vector<SpaceVector> at;
  [[nodiscard]] std::size_t kdtree_get_point_count() const { return at.size(); }
  [[nodiscard]] double kdtree_get_pt(std::uint32_t k, std::size_t axis) const { return at[k][axis]; }
  template <class Bounds>
  bool kdtree_get_bbox(Bounds&) const {
    return false;
  }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<
    nanoflann::L2_Simple_Adaptor<double, SphereVectors, double, std::uint32_t>, SphereVectors, 4,
    std::uint32_t>;

class GlobeCheck {
 public:
  GlobeCheck(const Sites& sites, const CellsOptions& options, const Diagram& diagram, int threads)
      : diagram_(diagram),
        outline_(options.outline),
        detail_(options.detail),
        threads_(threadCount(threads)),
        tree_(4, placed(sites), {16}) {
    tree_.buildIndex();
  }

  std::vector<std::string> run() {
    if (!checkArrays()) return broken_.take();
    checkOwners();
    checkSums();
    if (detail_ != Detail::measures && checkTwins()) {
      checkVertices();
      if (outline_.empty()) {
        checkPartition();
        checkPlaces();
      }
    }
    return broken_.take();
  }

 private:
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  const SphereVectors& placed(const Sites& sites) {
    has_weights_ = !sites.weight.empty();
    std::vector<double> longer(sites.size());
    for (std::size_t i = 0; i < sites.size(); ++i) {
      SpaceVector at = toward({sites.x[i], sites.y[i]});
      if (has_weights_) {
        // Of a cap of angular radius r: 1 / cos(r).
        const double weight = sites.weight[i], radius = std::sqrt(std::abs(weight) * 4 * pi / earth_area);
        const double length = weight < 0 ? 1 / std::cosh(radius) : 1 / std::cos(radius);
        for (double& coordinate : at) coordinate *= length;
        longer[i] = length * length;
      }
      sites_.at.push_back(at);
    }
    const double longest = has_weights_ ? *std::ranges::max_element(longer) : 0;
    for (std::size_t i = 0; i < sites.size(); ++i) sites_.at[i][3] = std::sqrt(longest - longer[i]);
    return sites_;
  }

  [[nodiscard]] std::size_t size() const { return sites_.at.size(); }
  [[nodiscard]] std::size_t begin(std::size_t i) const { return diagram_.cell_offsets[i]; }
  [[nodiscard]] std::size_t end(std::size_t i) const { return diagram_.cell_offsets[i + 1]; }
  /// The edge after one of a cell, around its ring.
  [[nodiscard]] std::size_t next(std::size_t i, std::size_t e) const {
    if (outline_.empty()) return e + 1 < end(i) ? e + 1 : begin(i);
    const auto& starts = diagram_.ring_starts;
    const auto after = std::ranges::upper_bound(starts, e);
    const auto ring_end = after == starts.end() ? end(i) : std::min<std::size_t>(*after, end(i));
    return e + 1 < ring_end ? e + 1 : *(after - 1);
  }
  /// Whether an edge is one of the outline.
  [[nodiscard]] bool isOutline(std::size_t e) const {
    return !outline_.empty() && diagram_.neighbors[e] == static_cast<std::int64_t>(Wall::outline);
  }

  bool checkArrays() {
    const Diagram& d = diagram_;
    const bool by_site = d.status.size() == size() && d.owner.size() == size() && d.area.size() == size() &&
                         d.solid_angle.size() == size() && d.centroid.size() == size() &&
                         d.cell_offsets.size() == size() + 1 && d.cell_offsets.front() == 0 &&
                         std::ranges::is_sorted(d.cell_offsets);
    const auto edges = by_site ? d.cell_offsets.back() : 0;
    const bool by_edge =
        d.neighbors.size() == edges &&
        (detail_ == Detail::measures || (d.vertices.size() == edges && d.edge_lengths.size() == edges));
    if (!by_site || !by_edge) {
      broken_.add("arrays", "their lengths do not fit the sites");
      return false;
    }
    return broken_.expect("neighbors", edges, threads_, [&](std::size_t e) -> std::string {
      const auto other = d.neighbors[e];
      if (isOutline(e)) return {};
      const bool is_cell = other >= 0 && static_cast<std::size_t>(other) < size() &&
                           d.status[static_cast<std::size_t>(other)] == Status::ok;
      return is_cell ? "" : fmt::format("{} has no cell", other);
    });
  }

  /// The distance of two sites' directions.
  [[nodiscard]] double angleBetween(std::size_t i, std::size_t j) const {
    const auto &a = sites_.at[i], &b = sites_.at[j];
    const double of_a = std::hypot(a[0], a[1], a[2]), of_b = std::hypot(b[0], b[1], b[2]);
    return std::hypot(a[0] / of_a - b[0] / of_b, a[1] / of_a - b[1] / of_b, a[2] / of_a - b[2] / of_b);
  }

  /// A duplicate is where its owner is, and owners are where no earlier site is. Weights may hide a site.
  void checkOwners() {
    constexpr double same = 4 * epsilon;
    broken_.expect("owners", size(), threads_, [&](std::size_t i) -> std::string {
      const auto owner = diagram_.owner[i];
      const bool is_own = owner == i;
      const bool is_hidden =
          (has_weights_ || !outline_.empty()) && is_own && diagram_.status[i] == Status::empty;
      if ((owner > i && !has_weights_) || is_own != (diagram_.status[i] == Status::ok || is_hidden) ||
          (!is_own && diagram_.status[i] != Status::duplicate)) {
        return fmt::format("site {} is owned by site {}", i, owner);
      }
      return angleBetween(i, owner) <= same
                 ? ""
                 : fmt::format("site {} is owned by site {}, which is elsewhere", i, owner);
    });
  }

  /// Integrates the authalic q (Snyder 1987, 3-12) along the outline's sides, which are straight in degrees.
  [[nodiscard]] double areaOfOutline() const {
    constexpr double a = 6378.137, f = 1 / 298.257223563, e2 = f * (2 - f);
    const double e = std::sqrt(e2);
    const auto q = [&](double latitude) {
      const double s = std::sin(latitude / half_turn * pi);
      return (1 - e2) * (s / (1 - e2 * s * s) + std::atanh(e * s) / e);
    };
    double sum = 0;
    for (std::size_t p = 0; p + 1 < outline_.polygon_offsets.size(); ++p) {
      for (auto r = outline_.polygon_offsets[p]; r < outline_.polygon_offsets[p + 1]; ++r) {
        const auto ring =
            std::span(outline_.points)
                .subspan(outline_.ring_offsets[r], outline_.ring_offsets[r + 1] - outline_.ring_offsets[r]);
        double of_ring = 0, turn = 0;
        for (std::size_t k = 0; k < ring.size(); ++k) {
          const Point from = ring[k], to = ring[k + 1 < ring.size() ? k + 1 : 0];
          const double way = std::remainder(to.x - from.x, 2 * half_turn);
          turn += way;
          constexpr int steps = 16;
          for (int step = 0; step < steps; ++step) {
            const double part = (step + 0.5) / steps;
            of_ring += q(from.y + part * (to.y - from.y)) * way / steps;
          }
        }
        // Around a pole, what is between the ring and the nearer one.
        if (std::abs(turn) > half_turn) of_ring = 2 * half_turn * q(half_turn / 2) - std::abs(of_ring);
        const bool is_hole = r > outline_.polygon_offsets[p];
        sum += is_hole ? -std::abs(of_ring) : std::abs(of_ring);
      }
    }
    return sum * a * a / 2 * pi / half_turn;
  }

  void checkSums() {
    double solid = 0, area = 0;
    for (std::size_t i = 0; i < size(); ++i) {
      solid += diagram_.solid_angle[i];
      area += diagram_.area[i];
    }
    if (!outline_.empty()) {
      const double whole = areaOfOutline();
      if (!(std::abs(area / whole - 1) <= outline_slack)) {
        broken_.add("areas", fmt::format("they add up to {} km2, the outline has {}", area, whole));
      }
      return;
    }
    const double slack = sphere_slack * std::max(1.0, std::sqrt(static_cast<double>(size())) / 1000);
    if (!(std::abs(solid / (4 * pi) - 1) <= slack)) {
      broken_.add("areas", fmt::format("solid angles add up to {}, not 4 pi", solid));
    }
    if (!(std::abs(area / earth_area - 1) <= slack)) {
      broken_.add("areas", fmt::format("they add up to {} km2, the Earth has {}", area, earth_area));
    }
  }

  /// Each edge is in both cells, with the same ends to the last bit.
  bool checkTwins() {
    return broken_.expect("symmetry", size(), threads_, [&](std::size_t i) -> std::string {
      for (auto e = begin(i); e < end(i); ++e) {
        if (isOutline(e)) continue;
        const auto j = static_cast<std::size_t>(diagram_.neighbors[e]);
        bool found = false;
        for (auto f = begin(j); f < end(j) && !found; ++f) {
          found = diagram_.neighbors[f] == static_cast<std::int64_t>(i) &&
                  diagram_.vertices[f] == diagram_.vertices[next(i, e)] &&
                  diagram_.vertices[next(j, f)] == diagram_.vertices[e] &&
                  diagram_.edge_lengths[e] == diagram_.edge_lengths[f];
        }
        if (!found) return fmt::format("the edge of sites {} and {} is not the same in both cells", i, j);
      }
      return {};
    });
  }

  /// Euler's formula on a sphere: vertices - edges + cells = 2.
  void checkPartition() {
    struct Hash {
      std::size_t operator()(Point p) const {
        return std::hash<double>()(p.x) * 31 + std::hash<double>()(p.y);
      }
    };
    std::unordered_map<Point, std::size_t, Hash> vertices;
    for (const Point p : diagram_.vertices) vertices.try_emplace(p, 0);
    const auto cells = static_cast<std::int64_t>(std::ranges::count(diagram_.status, Status::ok));
    const auto edges = static_cast<std::int64_t>(diagram_.vertices.size() / 2);
    const auto points = static_cast<std::int64_t>(vertices.size());
    if (cells > 1 && points - edges + cells != 2) {
      broken_.add("partition", fmt::format("{} vertices, {} edges and {} cells do not cover a sphere once",
                                           points, edges, cells));
    }
  }

  /// How far ties may move the vertices of a cell.
  [[nodiscard]] double slackOf(std::size_t i) const {
    double nearest = 2;
    double farthest = 0;
    for (auto e = begin(i); e < end(i); ++e) {
      if (isOutline(e)) continue;
      const double away = chordOf(sites_.at[i], sites_.at[static_cast<std::size_t>(diagram_.neighbors[e])]);
      nearest = std::min(nearest, away);
      farthest = std::max(farthest, away);
    }
    constexpr double steps = 64;
    return tie_slack * farthest + steps * epsilon / nearest;
  }

  [[nodiscard]] std::uint32_t nearestTo(const SpaceVector& place) const {
    std::uint32_t site = none;
    double squared = 0;
    nanoflann::KNNResultSet<double, std::uint32_t> found(1);
    found.init(&site, &squared);
    tree_.findNeighbors(found, place.data(), {});
    return diagram_.owner[site];
  }

  /// How much farther a distance in four dimensions is, in terms of distances on the sphere.
  [[nodiscard]] double farther(double far, double near) const {
    return has_weights_ ? (far - near) * (far + near) / 2 : far - near;
  }

  /// No site is nearer to a vertex than those whose cells meet there.
  void checkVertices() {
    broken_.expect("nearest", size(), threads_, [&](std::size_t i) -> std::string {
      const double slack = slackOf(i);
      for (auto e = begin(i); e < end(i); ++e) {
        const SpaceVector vertex = toward(diagram_.vertices[e]);
        const double own = chordOf(vertex, sites_.at[i]);
        const auto j = isOutline(e) ? i : static_cast<std::size_t>(diagram_.neighbors[e]);
        if (std::abs(farther(chordOf(vertex, sites_.at[j]), own)) > slack) {
          return fmt::format("a vertex of sites {} and {} is not as far from both", i, j);
        }
        const auto nearest = nearestTo(vertex);
        if (farther(own, chordOf(vertex, sites_.at[nearest])) > slack) {
          return fmt::format("site {} is nearer to a vertex of site {}", nearest, i);
        }
      }
      return {};
    });
  }

  /// Places anywhere lie in the cell of their nearest site: none of its neighbors is nearer, and from every
  /// other cell some neighbor is.
  void checkPlaces() {
    constexpr std::size_t most = 20000, each = 256;
    const std::size_t count = std::min(most, each * size());
    Random random(1);
    std::vector<SpaceVector> places(count);
    for (SpaceVector& place : places) {
      std::normal_distribution<double> normal;
      for (std::size_t k = 0; k < 3; ++k) place[k] = normal(random);
      const double length = std::hypot(place[0], place[1], place[2]);
      for (double& x : place) x /= length;
    }
    broken_.expect("nearest", count, threads_, [&](std::size_t k) -> std::string {
      const auto nearest = nearestTo(places[k]);
      // From any cell, neighbors that are nearer lead to the nearest site.
      std::size_t at = diagram_.owner[k % size()];
      if (begin(at) == end(at)) at = nearest;
      for (std::size_t steps = 0; steps <= size(); ++steps) {
        std::size_t best = at;
        for (auto e = begin(at); e < end(at); ++e) {
          const auto j = static_cast<std::size_t>(diagram_.neighbors[e]);
          if (chordOf(places[k], sites_.at[j]) < chordOf(places[k], sites_.at[best])) best = j;
        }
        if (best == at) break;
        at = best;
      }
      const double off = farther(chordOf(places[k], sites_.at[at]), chordOf(places[k], sites_.at[nearest]));
      return off <= slackOf(at) ? ""
                                : fmt::format("a place near site {} is in the cell of site {}", nearest, at);
    });
  }

  bool has_weights_ = false;
  SphereVectors sites_;
  const Diagram& diagram_;
  const Outline& outline_;
  Detail detail_;
  int threads_;
  Broken broken_;
  Tree tree_;
};

}  // namespace

std::vector<std::string> brokenOnGlobe(const Sites& sites, const CellsOptions& options,
                                       const Diagram& diagram, int threads) {
  return GlobeCheck(sites, options, diagram, threads).run();
}

}  // namespace vorpipe::core::checks

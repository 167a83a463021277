#include "check/nearest_site.h"
#include "base/try.h"

#include <nanoflann.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace vorpipe::core::checks {
namespace {

/// The sites in `index`, lifted if they have weights. For a place in the plane, the squared distance in space
/// is then the power, |p - site|^2 - weight, plus a constant that is the same for all sites.
struct Cloud {
  const CheckedSites& run;
  std::vector<std::uint32_t> index;
  std::vector<double> height;  ///< empty without weights
  std::uint32_t heaviest = 0;  ///< of the run
  [[nodiscard]] std::size_t kdtree_get_point_count() const { return index.size(); }
  [[nodiscard]] double kdtree_get_pt(std::uint32_t k, std::size_t axis) const {
    if (axis == 2) return height[k];
    const Point p = run.site(index[k]);
    return axis == 0 ? p.x : p.y;
  }
  template <class Bounds>
  bool kdtree_get_bbox(Bounds&) const {
    return false;
  }
};

using Metric = nanoflann::L2_Simple_Adaptor<double, Cloud, double, std::uint32_t>;
template <int dimensions>
using KdTree = nanoflann::KDTreeSingleIndexAdaptor<Metric, Cloud, dimensions, std::uint32_t>;
constexpr std::size_t leaf_size = 16;
/// A search that visits this many nodes is long. Only long ones are counted: threads would wait for each
/// other's sums.
constexpr std::uint64_t long_search = 256;

/// The result of a search: the nearest point, and those that double cannot distinguish from it. This is a
/// nanoflann result set, so one descent finds both.
class NearestAndEqual {
 public:
  using DistanceType = double;

  NearestAndEqual() {
    constexpr std::size_t few = 8;
    found_.reserve(few);
  }

  /// nanoflann calls it at each node.
  [[nodiscard]] double worstDist() const {
    ++visited_;
    return bound_;
  }
  [[nodiscard]] bool full() const { return !found_.empty(); }
  bool addPoint(double squared, std::uint32_t point) {
    if (squared >= bound_) return true;
    found_.push_back({squared, point});
    // Points as far as the bound are left out; the least distance is 0 at a site.
    const double bound = squared * (1 + squared_rounding) + std::numeric_limits<double>::min();
    if (bound < bound_) {
      bound_ = bound;
      std::erase_if(found_, [&](const Found& other) { return other.squared >= bound_; });
    }
    return true;
  }
  void sort() {}  // newer nanoflann calls it at the end of each search; few callers need an order

  [[nodiscard]] std::uint64_t visited() const { return visited_; }

  struct Found {
    double squared;
    std::uint32_t point;  ///< of the cloud
    auto operator<=>(const Found&) const = default;
  };

  [[nodiscard]] const std::vector<Found>& found() const { return found_; }
  [[nodiscard]] const std::vector<Found>& nearestFirst() {
    std::ranges::sort(found_);
    return found_;
  }

 private:
  double bound_ = std::numeric_limits<double>::infinity();
  mutable std::uint64_t visited_ = 0;
  std::vector<Found> found_;
};

double square(double a) { return a * a; }

/// The least and the largest power of site i over all query points, with its weight relative to that of
/// site 0.
struct Powers {
  double least, most;
};

Powers powersIn(const CheckedSites& run, std::size_t i) {
  const Point p = run.site(i);
  // Queries in a periodic domain reach one period beyond it.
  const Point low =
      run.moved({run.domain.xmin, run.domain.ymin}, {run.repeats_x ? -1 : 0, run.repeats_y ? -1 : 0});
  const Point high =
      run.moved({run.domain.xmax, run.domain.ymax}, {run.repeats_x ? 1 : 0, run.repeats_y ? 1 : 0});
  const auto away = [](double at, double from, double to) {
    return Powers{std::max({from - at, 0.0, at - to}), std::max(at - from, to - at)};
  };
  const Powers x = away(p.x, low.x, high.x), y = away(p.y, low.y, high.y);
  const double weight = run.weightDifference(i, 0);
  return {square(x.least) + square(y.least) - weight, square(x.most) + square(y.most) - weight};
}

/// Whether another site at the position of site i is no lighter, and is kept.
bool standsWithOwner(const CheckedSites& run, std::span<const std::uint32_t> owner, std::uint32_t i) {
  if (owner.size() != run.size() || owner[i] == i || owner[i] >= run.size()) return false;
  const std::uint32_t other = owner[i];
  return owner[other] == other && run.site(other) == run.site(i) &&
         (!run.weighted || run.weightDifference(other, i) >= 0);
}

/// Lifts the sites that may be nearest to a point of the domain. The others may be so much lighter that
/// heights would lose all digits.
Cloud liftedCloud(const CheckedSites& run, std::span<const std::uint32_t> owner) {
  double bound = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < run.size(); ++i) bound = std::min(bound, powersIn(run, i).most);
  Cloud cloud{run, {}, {}};
  for (std::uint32_t i = 0; i < run.size(); ++i) {
    if (standsWithOwner(run, owner, i)) continue;
    const Powers powers = powersIn(run, i);
    if (powers.least > bound + 64 * epsilon * (std::abs(bound) + std::abs(powers.least))) continue;
    if (cloud.index.empty() || run.weightDifference(i, cloud.heaviest) > 0) cloud.heaviest = i;
    cloud.index.push_back(i);
  }
  for (const auto i : cloud.index) cloud.height.push_back(std::sqrt(run.weightDifference(cloud.heaviest, i)));
  return cloud;
}

Cloud flatCloud(const CheckedSites& run, std::span<const std::uint32_t> owner) {
  Cloud cloud{run, std::vector<std::uint32_t>(run.size()), {}};
  std::iota(cloud.index.begin(), cloud.index.end(), 0u);
  std::erase_if(cloud.index, [&](std::uint32_t i) { return standsWithOwner(run, owner, i); });
  return cloud;
}

/// A place at which to search instead of p: p minus `shift` periods. The result's image, moved by `shift`, is
/// equally far from p.
struct Frame {
  Point from;
  Shift shift;
};

/// A whole number of periods; 0 for NaN and for a place so far away that it is wrong.
std::int32_t whole(double periods) {
  constexpr double most = 0x1p30;
  return std::abs(periods) < most ? static_cast<std::int32_t>(periods) : 0;
}

/// The frames in which an image nearest to p may appear as a site; the one in the domain comes first.
std::vector<Frame> framesOf(const CheckedSites& run, Point p) {
  const auto periods = [](bool repeats, double from_low, double period) {
    return repeats ? whole(std::floor(from_low / period)) : 0;
  };
  const Shift of_p{periods(run.repeats_x, p.x - run.domain.xmin, run.period.x),
                   periods(run.repeats_y, p.y - run.domain.ymin, run.period.y)};
  const int most_x = run.repeats_x ? 1 : 0, most_y = run.repeats_y ? 1 : 0;
  std::vector<Frame> frames;
  for (int y = -most_y; y <= most_y; ++y) {
    for (int x = -most_x; x <= most_x; ++x) {
      const Shift shift{of_p[0] - x, of_p[1] - y};
      frames.push_back({run.moved(p, {-shift[0], -shift[1]}), shift});
    }
  }
  std::swap(frames.front(), frames[frames.size() / 2]);
  return frames;
}

NearImage imageOf(const CheckedSites& run, std::uint32_t site, Shift shift) {
  return {site, shift, run.moved(run.site(site), shift)};
}

double squaredTo(const NearImage& image, Point p) { return dot(p - image.place, p - image.place); }

/// How much nearer image a is to p than b, in squared distance.
double nearerBy(const CheckedSites& run, const NearImage& a, const NearImage& b, Point p) {
  return squaredTo(b, p) - squaredTo(a, p) + run.weightDifference(a.site, b.site);
}

/// The rounding error of nearerBy(), also for places a period away.
double nearerRounding(const CheckedSites& run, const NearImage& a, const NearImage& b, Point p) {
  const double of_squares =
      squaredTo(a, p) + squaredTo(b, p) + std::abs(run.weightDifference(a.site, b.site));
  const double of_places = run.largest * (length(p - a.place) + length(p - b.place));
  return squared_rounding * (of_squares + of_places);
}

/// Whether a frame may contain an image as near to p as `near`: all sites are in the domain, and most frames
/// are farther from it.
bool maySeeAsNear(const CheckedSites& run, const NearestSite& nearest, const Frame& frame,
                  const NearImage& near, Point p) {
  const auto outside = [](double at, double low, double high) {
    return std::max({low - at, 0.0, at - high});
  };
  const Point to_domain{run.repeats_x ? outside(frame.from.x, run.domain.xmin, run.domain.xmax) : 0,
                        run.repeats_y ? outside(frame.from.y, run.domain.ymin, run.domain.ymax) : 0};
  const double farther = dot(to_domain, to_domain), squared = squaredTo(near, p);
  const double heavier = run.weightDifference(nearest.heaviest(), near.site);
  const double rounding =
      farther + squared + std::abs(heavier) + run.largest * (length(to_domain) + std::sqrt(squared));
  return !(farther - squared - heavier > 4 * squared_rounding * rounding);
}

}  // namespace

struct NearestSite::Tree {
  Tree(const CheckedSites& run, std::span<const std::uint32_t> owner)
      : cloud(run.weighted ? liftedCloud(run, owner) : flatCloud(run, owner)) {
    if (run.weighted) {
      lifted = std::make_unique<KdTree<3>>(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(leaf_size));
    } else {
      flat = std::make_unique<KdTree<2>>(2, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(leaf_size));
    }
  }

  [[nodiscard]] NearestAndEqual search(Point p) const {
    const double place[3] = {p.x, p.y, 0};
    NearestAndEqual near;
    if (flat) {
      flat->findNeighbors(near, place, {});
    } else {
      lifted->findNeighbors(near, place, {});
    }
    if (near.visited() > long_search) visited.fetch_add(near.visited(), std::memory_order_relaxed);
    return near;
  }

  Cloud cloud;
  std::unique_ptr<KdTree<2>> flat;  ///< one of these two
  std::unique_ptr<KdTree<3>> lifted;
  mutable std::atomic<std::uint64_t> visited = 0;
};

NearestSite::NearestSite(const CheckedSites& run, std::span<const std::uint32_t> owner)
    : tree_(std::make_unique<Tree>(run, owner)) {}
NearestSite::NearestSite(NearestSite&&) noexcept = default;
NearestSite::~NearestSite() = default;

std::uint32_t NearestSite::at(Point p) const {
  const NearestAndEqual near = tree_->search(p);
  const auto& index = tree_->cloud.index;
  // NaN is not nearer to any site than to another.
  if (near.found().empty()) return index.front();
  std::uint32_t best = index[std::ranges::min(near.found()).point];
  // For sites near each other the squares are inaccurate; the side of their bisector on which p lies is not.
  const CheckedSites& run = tree_->cloud.run;
  for (const auto& other : near.found()) {
    const std::uint32_t site = index[other.point];
    if (run.way(best, site) != Point{0, 0} && run.beyond(best, site, p) > 0) best = site;
  }
  return best;
}

std::vector<std::uint32_t> NearestSite::allAt(Point p) const {
  NearestAndEqual near = tree_->search(p);
  std::vector<std::uint32_t> sites;
  sites.reserve(near.found().size());
  for (const auto& found : near.nearestFirst()) sites.push_back(tree_->cloud.index[found.point]);
  return sites;
}

std::uint32_t NearestSite::heaviest() const { return tree_->cloud.heaviest; }

std::uint64_t NearestSite::visited() const { return tree_->visited.load(std::memory_order_relaxed); }

Result<std::optional<Sites>> wrappedIfPeriodic(const Sites& sites, const Box& domain, Periodic periodic,
                                               int threads) {
  if (periodic == Periodic::none) return std::nullopt;
  return wrapped(sites, domain, periodic, threads);
}

Result<std::array<Point, 2>> placedCorners(const Box& domain, Periodic periodic) {
  VORPIPE_LET(corners,
              wrapped({{domain.xmin, domain.xmax}, {domain.ymin, domain.ymax}, {}}, domain, periodic));
  return std::array{Point{corners.x[0], corners.y[0]}, Point{corners.x[1], corners.y[1]}};
}

NearImage nearestImage(const CheckedSites& run, const NearestSite& nearest, Point p) {
  if (!run.repeats()) {
    const std::uint32_t site = nearest.at(p);
    return imageOf(run, site, {0, 0});
  }
  NearImage best{no_site, {}, {}};
  for (const Frame& frame : framesOf(run, p)) {
    if (best.site != no_site && !maySeeAsNear(run, nearest, frame, best, p)) continue;
    const NearImage image = imageOf(run, nearest.at(frame.from), frame.shift);
    if (best.site == no_site || nearerBy(run, image, best, p) > 0) best = image;
  }
  return best;
}

std::vector<NearImage> nearestImages(const CheckedSites& run, const NearestSite& nearest, Point p) {
  std::vector<NearImage> images;
  for (const Frame& frame : framesOf(run, p)) {
    if (!images.empty() && !maySeeAsNear(run, nearest, frame, images.front(), p)) continue;
    for (const auto site : nearest.allAt(frame.from)) images.push_back(imageOf(run, site, frame.shift));
  }
  if (!run.repeats()) return images;
  const auto best = std::ranges::max_element(
      images, [&](const NearImage& a, const NearImage& b) { return nearerBy(run, b, a, p) > 0; });
  std::iter_swap(images.begin(), best);
  std::erase_if(images, [&, first = images.front()](const NearImage& image) {
    return nearerBy(run, first, image, p) > nearerRounding(run, first, image, p);
  });
  return images;
}

NearImage imageNear(const CheckedSites& run, std::uint32_t i, Point p) {
  const auto periods = [](bool repeats, double way, double period) {
    return repeats ? whole(std::round(way / period)) : 0;
  };
  const Point way = p - run.site(i);
  return imageOf(run, i,
                 {periods(run.repeats_x, way.x, run.period.x), periods(run.repeats_y, way.y, run.period.y)});
}

}  // namespace vorpipe::core::checks

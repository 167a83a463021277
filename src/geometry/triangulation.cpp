/// Incremental insertion (Bowyer 1981, Watson 1981; with weights Edelsbrunner and Shah 1996) in a biased
/// randomized order of rounds (Amenta, Choi, Rote 2003). In large rounds the parts of the order are inserted
/// in parallel; points whose cavity leaves their part follow.
#include "geometry/triangulation.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <functional>
#include <iterator>
#include <mutex>
#include <numeric>
#include <utility>

#include "base/parallel.h"
#include "geometry/insertion.h"

namespace vorpipe::core {
namespace {

constexpr auto none = GrowingMesh::none;

/// A number's bits, well mixed (splitmix64).
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15u;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

/// The rounds in which points are inserted, counted from the last one.
class Rounds {
 public:
  explicit Rounds(const std::vector<double>& weights) : weights_(weights) {
    constexpr std::size_t sample = 1024;
    if (weights.empty()) return;
    std::vector<double> some;
    for (std::size_t k = 0; k < sample; ++k) some.push_back(weights[k * weights.size() / sample]);
    std::sort(some.begin(), some.end(), std::greater<>());
    std::size_t heavier = sample;
    for (auto& least : heavy_) least = some[heavier /= 4];
  }

  /// 0 with probability 15/16, 1 with 15/256, and so on. A point among the heaviest quarter comes one round
  /// earlier, among the heaviest sixteenth two, and so on. These hide most hidden points, which are then
  /// never inserted.
  [[nodiscard]] std::size_t of(std::size_t point) const {
    constexpr int bits = 4;
    auto round = static_cast<std::size_t>(std::countr_zero(mixed(point)) / bits);
    if (weights_.empty()) return round;
    for (const auto least : heavy_) round += weights_[point] > least ? 1u : 0u;
    return round;
  }

  static constexpr std::size_t most = 20;

 private:
  const std::vector<double>& weights_;
  std::array<double, 3>
      heavy_{};  ///< the weights that a quarter, a sixteenth and a 64th of the points exceed
};

struct InsertionOrder {
  std::vector<std::int32_t> points;
  std::vector<std::size_t> round_ends;  ///< ascending
};

/// Rounds keep cavities small whatever the points; inside a round the points ascend, so that walks are short.
/// With few rounds most of them are in the processor's cache.
InsertionOrder insertionOrder(std::size_t count, const std::vector<double>& weights) {
  const Rounds rounds(weights);
  std::array<std::size_t, Rounds::most> end{};
  for (std::size_t i = 0; i < count; ++i) ++end[rounds.of(i)];
  for (auto r = end.size() - 1; r > 0; --r) end[r - 1] += end[r];
  InsertionOrder order{std::vector<std::int32_t>(count), {end.rbegin(), end.rend()}};
  for (auto i = count; i-- > 0;) order.points[--end[rounds.of(i)]] = static_cast<std::int32_t>(i);
  return order;
}

/// How points are cut into parts: by their order, or by columns or rows of the plane. Most cavities may cross
/// borders in one cut, as by order for curves side by side, but not in another.
enum class Cut : std::uint8_t { order, columns, rows };

/// Points cut into parts of about the same size, or with borders half a part further on: then most cavities
/// that crossed a border of the first cut lie inside one part.
class Parts {
 public:
  Parts(const std::vector<Point>& points, Cut cut, std::size_t count, bool further)
      : points_(points),
        cut_(cut),
        count_(further ? count + 1 : count),
        size_((points.size() + count - 1) / count),
        shift_(further ? size_ / 2 : 0) {
    if (cut != Cut::order) findBorders();
  }

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] Region of(std::size_t point) const {
    if (cut_ == Cut::order) return static_cast<Region>((point + shift_) / size_);
    return static_cast<Region>(std::upper_bound(borders_.begin(), borders_.end(), placeOf(point)) -
                               borders_.begin());
  }

 private:
  [[nodiscard]] double placeOf(std::size_t point) const {
    return cut_ == Cut::columns ? points_[point].x : points_[point].y;
  }

  void findBorders() {
    constexpr std::size_t sample = 1024;
    std::vector<double> places;
    for (std::size_t k = 0; k < sample; ++k) places.push_back(placeOf(k * points_.size() / sample));
    std::sort(places.begin(), places.end());
    for (std::size_t part = 1; part < count_; ++part) {
      borders_.push_back(places[std::min(sample - 1, (part * size_ - shift_) * sample / points_.size())]);
    }
  }

  const std::vector<Point>& points_;
  Cut cut_;
  std::size_t count_, size_, shift_;
  std::vector<double> borders_;  ///< between columns or rows
};

class Triangulation {
 public:
  Triangulation(const std::vector<Point>& points, const std::vector<double>& weights, int threads)
      : mesh_{points, weights, {}, {}, {}, {}, {}}, threads_(threadCount(threads)) {}

  Mesh build() {
    order_ = insertionOrder(mesh_.points.size(), mesh_.weights);
    if (!begin()) return {};
    std::size_t done = 3;
    for (const auto end : order_.round_ends) {
      if (end <= done) continue;
      insertRound(done, end);
      done = end;
    }
    return finish();
  }

 private:
  static constexpr std::size_t triangulation_grain = std::size_t{1} << 15;

  [[nodiscard]] Point at(std::size_t k) const {
    return mesh_.points[static_cast<std::size_t>(order_.points[k])];
  }

  /// Makes the first triangle from the first two points and the next one not on their line, which becomes the
  /// third.
  bool begin() {
    auto& order = order_.points;
    const auto count = order.size();
    std::size_t third = 2;
    while (third < count && orientation(at(0), at(1), at(third)) == 0) ++third;
    if (third >= count) return false;
    std::rotate(order.begin() + 2, order.begin() + static_cast<std::ptrdiff_t>(third),
                order.begin() + static_cast<std::ptrdiff_t>(third) + 1);
    for (auto& end : order_.round_ends) end += end > 2 && end <= third ? 1u : 0u;
    mesh_.triangles.resize(2 * count - 2);
    if (!mesh_.weights.empty()) mesh_.is_in_cavity.resize(mesh_.triangles.size());
    mesh_.near.assign(count, none);
    auto a = order[0], b = order[1];
    const auto c = order[2];
    if (orientation(at(0), at(1), at(2)) < 0) std::swap(a, b);
    mesh_.triangles[0] = {{a, b, c}, {2, 3, 1}};
    mesh_.triangles[1] = {{b, a, ghost}, {3, 2, 0}};
    mesh_.triangles[2] = {{c, b, ghost}, {1, 3, 0}};
    mesh_.triangles[3] = {{a, c, ghost}, {2, 1, 0}};
    for (const auto corner : {a, b, c}) mesh_.near[static_cast<std::size_t>(corner)] = 0;
    return true;
  }

  /// The slots of the triangles that the k-th insertion adds.
  static std::int32_t roomOf(std::size_t k) { return static_cast<std::int32_t>(2 * k - 2); }

  [[nodiscard]] std::int32_t anyTriangle() const {
    return *std::find_if(mesh_.near.begin(), mesh_.near.end(), [&](auto t) {
      return t != none && !GrowingMesh::isUnused(mesh_.triangles[static_cast<std::size_t>(t)]);
    });
  }

  /// Performs insertions begin to end - 1: in parallel by parts; then, if that went well, again by parts with
  /// shifted borders; finally one by one those left, whose cavities cross borders.
  void insertRound(std::size_t begin, std::size_t end) {
    constexpr std::size_t worth_sharing = 4096;
    std::vector<std::uint32_t> left(end - begin);
    std::iota(left.begin(), left.end(), static_cast<std::uint32_t>(begin));
    startWalksNear(roomOf(begin));
    if (threads_ > 1 && left.size() >= worth_sharing) {
      mesh_.region.resize(mesh_.triangles.size());
      mesh_.region_of_point.resize(mesh_.points.size());
      const auto [cut, count] = bestCut(roomOf(begin));
      share(roomOf(begin), Parts(mesh_.points, cut, count, false));
      insertSideBySide(left, count);
      if (2 * left.size() < end - begin) {
        startWalksNear(roomOf(end));
        share(roomOf(end), Parts(mesh_.points, cut, count, true));
        insertSideBySide(left, count + 1);
      }
    }
    Insertion insertion(mesh_, everywhere, anyTriangle());
    for (const auto k : left) insertion.insert(order_.points[k], roomOf(k));
    takeHidden(insertion);
  }

  /// Chooses the cut and the number of parts such that few of the triangles so far cross borders. With
  /// several parts for each thread, all threads have work until the end; if too many triangles would cross,
  /// uses one part for each.
  std::pair<Cut, std::size_t> bestCut(std::int32_t used) {
    constexpr std::size_t sample = 4096, few = 32, most_parts = 16;
    const auto threads = std::min<std::size_t>(static_cast<std::size_t>(threads_), most_parts);
    std::pair<Cut, std::size_t> best;
    std::size_t least = 0;
    for (const auto count : {std::min(2 * threads, most_parts), threads}) {
      least = sample + 1;
      for (const auto cut : {Cut::order, Cut::columns, Cut::rows}) {
        const Parts parts(mesh_.points, cut, count, false);
        std::size_t across = 0;
        for (std::size_t k = 0; k < sample; ++k) {
          const auto& t = mesh_.triangles[k * static_cast<std::size_t>(used) / sample];
          across += regionOf(t, [&](std::size_t p) { return parts.of(p); }) == of_several ? 1u : 0u;
        }
        if (across >= least) continue;
        least = across;
        best = {cut, count};
      }
      if (few * least < sample) break;
    }
    return best;
  }

  /// Performs those of `insertions` whose cavity stays in one part; leaves the others, ascending by part.
  void insertSideBySide(std::vector<std::uint32_t>& insertions, std::size_t parts) {
    std::vector<std::vector<std::uint32_t>> of_part(parts);
    for (const auto k : insertions) {
      of_part[mesh_.region_of_point[static_cast<std::size_t>(order_.points[k])]].push_back(k);
    }
    parallelFor(parts, 1, threads_, [&](std::size_t part, std::size_t) {
      Insertion insertion(mesh_, static_cast<Region>(part), none);
      std::erase_if(of_part[part],
                    [&](std::size_t k) { return insertion.insert(order_.points[k], roomOf(k)); });
      takeHidden(insertion);
    });
    insertions.clear();
    for (const auto& left : of_part) insertions.insert(insertions.end(), left.begin(), left.end());
  }

  /// The region of a triangle, from those of its points.
  template <class RegionOfPoint>
  static Region regionOf(const MeshTriangle& t, const RegionOfPoint& regionOfPoint) {
    Region region = everywhere;
    for (const auto corner : t.corner) {
      if (corner == ghost) continue;
      const Region here = regionOfPoint(static_cast<std::size_t>(corner));
      if (region != everywhere && region != here) return of_several;
      region = here;
    }
    return region == everywhere ? of_several : region;
  }

  /// Makes walks begin at triangles that are at their points now. Triangles that were there at insertion may
  /// have moved far along a curve of points. The triangles are in slots 0 to used - 1.
  void startWalksNear(std::int32_t used) {
    parallelFor(static_cast<std::size_t>(used), triangulation_grain, threads_,
                [&](std::size_t begin, std::size_t end) {
                  for (auto t = begin; t < end; ++t) {
                    for (const auto corner : mesh_.triangles[t].corner) {
                      if (corner == ghost) continue;
                      std::atomic_ref(mesh_.near[static_cast<std::size_t>(corner)])
                          .store(static_cast<std::int32_t>(t), std::memory_order_relaxed);
                    }
                  }
                });
  }

  /// Assigns regions to the points, and to the triangles in slots 0 to used - 1.
  void share(std::int32_t used, const Parts& parts) {
    parallelEach(mesh_.points.size(), triangulation_grain, threads_,
                 [&](std::size_t p) { mesh_.region_of_point[p] = parts.of(p); });
    parallelFor(static_cast<std::size_t>(used), triangulation_grain, threads_,
                [&](std::size_t begin, std::size_t end) {
                  for (auto t = begin; t < end; ++t) {
                    mesh_.region[t] =
                        regionOf(mesh_.triangles[t], [&](std::size_t p) { return mesh_.region_of_point[p]; });
                  }
                });
  }

  void takeHidden(Insertion& insertion) {
    const std::scoped_lock lock(hiding_);
    hidden_.insert(hidden_.end(), insertion.hidden.begin(), insertion.hidden.end());
  }

  /// By point: a triangle at it; for a hidden point, one that contains it.
  std::vector<std::int32_t> triangleOfEach() {
    std::vector<std::int32_t> at(mesh_.points.size(), none);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      for (const auto corner : mesh_.triangles[t].corner) {
        if (corner != ghost) at[static_cast<std::size_t>(corner)] = static_cast<std::int32_t>(t);
      }
    }
    if (hidden_.empty()) return at;
    // Threads appended in any order.
    std::sort(hidden_.begin(), hidden_.end());
    mesh_.near = std::move(at);
    Insertion insertion(mesh_, everywhere, anyTriangle());
    for (const auto i : hidden_) mesh_.near[static_cast<std::size_t>(i)] = insertion.locate(i);
    return std::move(mesh_.near);
  }

  /// Closes the gaps that hidden points left between the triangles.
  void closeGaps() {
    auto& triangles = mesh_.triangles;
    std::vector<std::int32_t> moved(triangles.size());
    std::int32_t count = 0;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      moved[t] = count;
      count += GrowingMesh::isUnused(triangles[t]) ? 0 : 1;
    }
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      auto here = triangles[t];
      if (GrowingMesh::isUnused(here)) continue;
      for (auto& neighbor : here.neighbor) neighbor = moved[static_cast<std::size_t>(neighbor)];
      triangles[static_cast<std::size_t>(moved[t])] = here;
    }
    triangles.resize(static_cast<std::size_t>(count));
  }

  Mesh finish() {
    if (!hidden_.empty()) closeGaps();
    auto at = triangleOfEach();
    return {std::move(mesh_.triangles), std::move(at)};
  }

  GrowingMesh mesh_;
  InsertionOrder order_;
  int threads_;
  std::mutex hiding_;
  std::vector<std::int32_t> hidden_;
};

}  // namespace

Mesh delaunay(const std::vector<Point>& points, const std::vector<double>& weights, int threads) {
  double largest = 0;
  for (const auto& p : points) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  // The decisions multiply four coordinates.
  constexpr double most = 0x1p240;
  if (largest <= most) return Triangulation(points, weights, threads).build();
  auto smaller = points;
  auto lighter = weights;
  for (auto& p : smaller) p = {std::ldexp(p.x, -64), std::ldexp(p.y, -64)};
  for (auto& weight : lighter) weight = std::ldexp(weight, -128);
  return Triangulation(smaller, lighter, threads).build();
}

}  // namespace vorpipe::core

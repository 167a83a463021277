/// Incremental insertion (Bowyer 1981, Watson 1981; with weights Edelsbrunner and Shah 1996) in a biased
/// randomized order of rounds (Amenta, Choi, Rote 2003). In large rounds the parts of the order are inserted
/// in parallel; points whose cavity leaves their part follow.
#include "core/delaunay/triangulation.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <mutex>
#include <numeric>
#include <span>
#include <utility>

#include "base/parallel.h"
#include "core/delaunay/insertion.h"

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

/// The round from the end in which a point is inserted: 0 with probability 1/2, 1 with 1/4, and so on.
std::size_t roundOf(std::size_t point) { return static_cast<std::size_t>(std::countr_zero(mixed(point))); }

struct InsertionOrder {
  std::vector<std::int32_t> points;
  std::vector<std::size_t> round_ends;  ///< ascending
};

/// Rounds keep cavities small whatever the points; inside a round they keep their order, so that walks are
/// short.
InsertionOrder insertionOrder(std::size_t count) {
  std::array<std::size_t, 66> end{};
  for (std::size_t i = 0; i < count; ++i) ++end[roundOf(i)];
  for (auto r = end.size() - 1; r > 0; --r) end[r - 1] += end[r];
  InsertionOrder order{std::vector<std::int32_t>(count), {end.rbegin(), end.rend()}};
  for (auto i = count; i-- > 0;) order.points[--end[roundOf(i)]] = static_cast<std::int32_t>(i);
  return order;
}

/// The points cut into parts of equal size; or cut half a part further on, cyclically: then most cavities
/// that crossed a border of the first cut lie inside one part.
class Parts {
 public:
  Parts(std::size_t points, std::size_t count, bool further)
      : points_(points),
        count_(count),
        size_((points + count - 1) / count),
        shift_(further ? size_ / 2 : 0) {}

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::size_t of(std::int32_t point) const {
    const auto i = static_cast<std::size_t>(point);
    return (i < shift_ ? i + points_ - shift_ : i - shift_) / size_;
  }
  [[nodiscard]] std::int32_t firstPoint(std::size_t part) const {
    return static_cast<std::int32_t>(part * size_ + shift_);
  }

 private:
  std::size_t points_, count_, size_, shift_;
};

class Triangulation {
 public:
  Triangulation(const std::vector<Point>& points, const std::vector<double>& weights, int threads)
      : mesh_{points, weights, {}, {}, {}, {}}, threads_(threads) {}

  Mesh build() {
    order_ = insertionOrder(mesh_.points.size());
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
  static constexpr std::size_t most_parts = 16;
  static_assert(most_parts < of_several);

  [[nodiscard]] Point at(std::size_t k) const {
    return mesh_.points[static_cast<std::size_t>(order_.points[k])];
  }

  /// Makes the first triangle, of the first two points and the next that is not on their line, which becomes
  /// the third.
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
    mesh_.region.resize(mesh_.triangles.size());
    mesh_.is_in_cavity.resize(mesh_.triangles.size());
    mesh_.incident.assign(count, none);
    auto a = order[0], b = order[1];
    const auto c = order[2];
    if (orientation(at(0), at(1), at(2)) < 0) std::swap(a, b);
    mesh_.triangles[0] = {{a, b, c}, {2, 3, 1}};
    mesh_.triangles[1] = {{b, a, ghost}, {3, 2, 0}};
    mesh_.triangles[2] = {{c, b, ghost}, {1, 3, 0}};
    mesh_.triangles[3] = {{a, c, ghost}, {2, 1, 0}};
    for (const auto corner : {a, b, c}) mesh_.incident[static_cast<std::size_t>(corner)] = 0;
    return true;
  }

  /// The slots of the triangles that the k-th insertion adds.
  static std::int32_t roomOf(std::size_t k) { return static_cast<std::int32_t>(2 * k - 2); }

  [[nodiscard]] std::int32_t anyTriangle() const {
    return *std::find_if(mesh_.incident.begin(), mesh_.incident.end(), [](auto t) { return t != none; });
  }

  /// Does the insertions begin to end - 1. Where many cavities leave their part, as across the wide gaps
  /// between curves, the next round has fewer parts.
  void insertRound(std::size_t begin, std::size_t end) {
    constexpr std::size_t worth_sharing = 1024;
    std::vector<std::size_t> left(end - begin);
    std::iota(left.begin(), left.end(), begin);
    if (left.size() >= worth_sharing) {
      const Parts parts(mesh_.points.size(), parts_, false), further(mesh_.points.size(), parts_, true);
      shareTriangles(roomOf(begin), parts);
      left = insertSideBySide(left, parts);
      shareTriangles(roomOf(end), further);
      left = insertSideBySide(left, further);
      if (8 * left.size() > end - begin) parts_ = std::max<std::size_t>(2, parts_ / 2);
    }
    Insertion insertion(mesh_, anyTriangle());
    for (const auto k : left) insertion.insert(order_.points[k], roomOf(k));
    takeHidden(insertion);
  }

  /// Does those of `insertions` whose cavity stays in one part; returns the others.
  std::vector<std::size_t> insertSideBySide(std::span<const std::size_t> insertions, const Parts& parts) {
    std::vector<std::vector<std::size_t>> left(parts.count());
    parallelFor(parts.count(), 1, threads_, [&](std::size_t part, std::size_t) {
      Insertion insertion(mesh_, static_cast<Region>(part), parts.firstPoint(part));
      for (const auto k : insertions) {
        const auto point = order_.points[k];
        if (parts.of(point) != part || insertion.insert(point, roomOf(k))) continue;
        left[part].push_back(k);
      }
      takeHidden(insertion);
    });
    std::vector<std::size_t> all;
    for (const auto& some : left) all.insert(all.end(), some.begin(), some.end());
    return all;
  }

  /// Assigns regions to the triangles in slots 0 to end_place - 1.
  void shareTriangles(std::int32_t end_place, const Parts& parts) {
    constexpr std::size_t grain = std::size_t{1} << 15;
    parallelFor(static_cast<std::size_t>(end_place), grain, threads_,
                [&](std::size_t begin, std::size_t end) {
                  for (auto t = begin; t < end; ++t) {
                    const auto& corner = mesh_.triangles[t].corner;
                    const auto part = parts.of(*std::max_element(corner.begin(), corner.end()));
                    const bool one = std::all_of(corner.begin(), corner.end(),
                                                 [&](auto c) { return c == ghost || parts.of(c) == part; });
                    mesh_.region[t] = one ? static_cast<Region>(part) : of_several;
                  }
                });
  }

  void takeHidden(Insertion& insertion) {
    const std::scoped_lock lock(hiding_);
    hidden_.insert(hidden_.end(), insertion.hidden.begin(), insertion.hidden.end());
  }

  /// Hidden points lie in triangles of others.
  void placeHidden() {
    // Threads appended in any order.
    std::sort(hidden_.begin(), hidden_.end());
    Insertion insertion(mesh_, anyTriangle());
    for (const auto i : hidden_) mesh_.incident[static_cast<std::size_t>(i)] = insertion.locate(i);
  }

  /// Closes the gaps between the triangles.
  void closeGaps() {
    auto& triangles = mesh_.triangles;
    std::vector<std::int32_t> moved(triangles.size());
    std::int32_t count = 0;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const auto& corner = triangles[t].corner;
      moved[t] = count;
      count += *std::max_element(corner.begin(), corner.end()) != ghost ? 1 : 0;
    }
    const auto now = [&](std::int32_t t) { return moved[static_cast<std::size_t>(t)]; };
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      auto here = triangles[t];
      if (*std::max_element(here.corner.begin(), here.corner.end()) == ghost) continue;
      for (auto& neighbor : here.neighbor) neighbor = now(neighbor);
      triangles[static_cast<std::size_t>(moved[t])] = here;
    }
    triangles.resize(static_cast<std::size_t>(count));
    for (auto& t : mesh_.incident) t = now(t);
  }

  Mesh finish() {
    if (!hidden_.empty()) {
      placeHidden();
      closeGaps();
    }
    return {std::move(mesh_.triangles), std::move(mesh_.incident)};
  }

  GrowingMesh mesh_;
  InsertionOrder order_;
  int threads_;
  std::size_t parts_ = most_parts;
  std::mutex hiding_;
  std::vector<std::int32_t> hidden_;
};

}  // namespace

Mesh delaunay(std::vector<Point> points, std::vector<double> weights, int threads) {
  double largest = 0;
  for (const auto& p : points) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  // The decisions multiply four coordinates.
  constexpr double most = 0x1p240;
  if (largest > most) {
    for (auto& p : points) p = {std::ldexp(p.x, -64), std::ldexp(p.y, -64)};
    for (auto& weight : weights) weight = std::ldexp(weight, -128);
  }
  return Triangulation(points, weights, threads).build();
}

}  // namespace vorpipe::core

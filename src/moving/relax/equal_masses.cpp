#include "moving/relax/equal_masses.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/block_sums.h"
#include "moving/relax/allowed_places.h"

namespace vorpipe::moving {
namespace {

/// How masses change with places, to first order: D takes ways of sites to changes of masses (the header of
/// MovingCells has the formula), and its transpose takes numbers of cells to ways of sites. Both gather from
/// the edges of one cell, since an edge has the same coupling and middle seen from either side.
class MassSlopes {
 public:
  MassSlopes(const Sites& sites, const MovingCells& cells, const Box& domain, int threads)
      : sites_(sites),
        meet_(cells.neighbors()),
        edges_(cells.edges()),
        width_(domain.xmax - domain.xmin),
        height_(domain.ymax - domain.ymin),
        threads_(threads) {}

  /// way = transpose of D times `numbers`.
  void spreadOut(const std::vector<double>& numbers, std::vector<Point>& way) const {
    way.resize(sites_.size());
    forAll(sites_.size(), threads_, [&](std::size_t i) {
      Point sum{0, 0};
      eachEdge(i, [&](std::size_t j, double twice, Point from, Point) {
        const double difference = twice * (numbers[j] - numbers[i]);
        sum.x += difference * from.x;
        sum.y += difference * from.y;
      });
      way[i] = sum;
    });
  }

  /// change = D times `way`.
  void gather(const std::vector<Point>& way, std::vector<double>& change) const {
    change.resize(sites_.size());
    forAll(sites_.size(), threads_, [&](std::size_t i) {
      double sum = 0;
      eachEdge(i, [&](std::size_t j, double twice, Point from, Point to) {
        sum += twice * ((to.x * way[j].x + to.y * way[j].y) - (from.x * way[i].x + from.y * way[i].y));
      });
      change[i] = sum;
    });
  }

 private:
  /// Calls each(neighbor, twice the coupling, site less middle, neighbor less middle) for the edges of cell
  /// i.
  template <class Each>
  void eachEdge(std::size_t i, const Each& each) const {
    for (auto k = meet_.offsets[i]; k < meet_.offsets[i + 1]; ++k) {
      if (isWall(meet_.neighbors[k])) continue;
      const auto j = static_cast<std::size_t>(meet_.neighbors[k]);
      const Point middle = edges_.middle[k];
      Point to{sites_.x[j] - middle.x, sites_.y[j] - middle.y};
      if (!meet_.shifts.empty()) {
        to.x += meet_.shifts[k][0] * width_;
        to.y += meet_.shifts[k][1] * height_;
      }
      each(j, 2 * edges_.coupling[k], Point{sites_.x[i] - middle.x, sites_.y[i] - middle.y}, to);
    }
  }

  const Sites& sites_;
  const CellsThatMeet& meet_;
  const EdgesOfCells& edges_;
  double width_, height_;
  int threads_;
};

/// The shortest ways, by the sum of their squares, that change masses by `missing`: D' p with D D' p =
/// missing, by conjugate gradients.
std::vector<Point> shortestWays(const MassSlopes& slopes, const std::vector<double>& missing, int threads) {
  const std::size_t count = missing.size();
  constexpr double enough = 1e-3;
  constexpr int most = 2000;
  const auto product = [&](const std::vector<double>& a, const std::vector<double>& b) {
    return carefulSum(count, threads, [&](std::size_t i) { return a[i] * b[i]; });
  };
  std::vector<double> p(count), rest = missing, direction = rest, image;
  std::vector<Point> way;
  double squared = product(rest, rest);
  const double goal = enough * enough * squared;
  for (int k = 0; k < most && squared > goal; ++k) {
    slopes.spreadOut(direction, way);
    slopes.gather(way, image);
    const double slope = product(direction, image);
    if (!(slope > 0)) break;
    const double length = squared / slope;
    forAll(count, threads, [&](std::size_t i) {
      p[i] += length * direction[i];
      rest[i] -= length * image[i];
    });
    const double before = std::exchange(squared, product(rest, rest));
    forAll(count, threads, [&](std::size_t i) { direction[i] = rest[i] + squared / before * direction[i]; });
  }
  slopes.spreadOut(p, way);
  return way;
}

/// One attempt after the other.
class Equalizer {
 public:
  Equalizer(Session& session, Sites sites, const CellsOptions& options)
      : options_(options),
        cells_(session, options),
        allowed_(options.domain, options.outline, options.periodic),
        threads_(session.threads()),
        sites_(std::move(sites)) {}

  Result<void> run(double tolerance, std::uint64_t most) {
    auto measured = measure(sites_);
    if (!measured) return tl::unexpected(std::move(measured.error()));
    worst_ = *measured;
    while (worst_ > tolerance && diagrams_ < most) {
      const auto ways = shortestWays({sites_, cells_, options_.domain, threads_}, missing_, threads_);
      const auto better = search(ways, most);
      if (!better) return tl::unexpected(better.error());
      if (!*better) break;
    }
    return {};
  }

  [[nodiscard]] const Sites& sites() const { return sites_; }
  [[nodiscard]] std::uint64_t diagrams() const { return diagrams_; }
  [[nodiscard]] double worst() const { return worst_; }

 private:
  /// The worst part by which a mass differs from the mean of all that have one; what each misses is noted.
  Result<double> measure(const Sites& at) {
    if (auto done = cells_.update(at); !done) return tl::unexpected(std::move(done.error()));
    ++diagrams_;
    const auto& mass = cells_.moments().mass;
    const double sum = carefulSum(mass.size(), threads_, [&](std::size_t i) { return mass[i]; });
    const double cells =
        carefulSum(mass.size(), threads_, [&](std::size_t i) { return mass[i] > 0 ? 1.0 : 0.0; });
    const double mean = sum / cells;
    now_missing_.resize(mass.size());
    double worst = 0;
    for (std::size_t i = 0; i < mass.size(); ++i) {
      now_missing_[i] = mass[i] > 0 ? mean - mass[i] : 0;
      worst = std::max(worst, std::abs(now_missing_[i]) / mean);
    }
    missing_.swap(now_missing_);
    return worst;
  }

  /// Takes the longest part of the ways, half as long each time, that makes the worst cell better.
  Result<bool> search(const std::vector<Point>& ways, std::uint64_t most) {
    constexpr double least = 0x1p-6;
    for (double length = 1; length >= least && diagrams_ < most; length /= 2) {
      Sites at = sites_;
      forAll(at.size(), threads_, [&](std::size_t i) {
        const Point to = allowed_.nearestTo({at.x[i] + length * ways[i].x, at.y[i] + length * ways[i].y});
        at.x[i] = to.x;
        at.y[i] = to.y;
      });
      if (options_.periodic != Periodic::none) {
        auto placed = wrapped(at, options_.domain, options_.periodic, threads_);
        if (!placed) return tl::unexpected(std::move(placed.error()));
        at = std::move(*placed);
      }
      const auto measured = measure(at);
      if (!measured) return tl::unexpected(measured.error());
      if (!(*measured < worst_)) continue;
      worst_ = *measured;
      sites_ = std::move(at);
      return true;
    }
    return false;
  }

  const CellsOptions& options_;
  MovingCells cells_;
  AllowedPlaces allowed_;
  int threads_;
  Sites sites_;
  std::vector<double> missing_{}, now_missing_{};
  double worst_ = 0;
  std::uint64_t diagrams_ = 0;
};

}  // namespace

Result<EqualMasses> equalizeMasses(Session& session, Sites sites, const CellsOptions& options,
                                   double tolerance, std::uint64_t most) {
  Equalizer equalizer(session, std::move(sites), options);
  if (auto done = equalizer.run(tolerance, most); !done) return tl::unexpected(std::move(done.error()));
  return EqualMasses{equalizer.sites(), equalizer.diagrams(), equalizer.worst()};
}

}  // namespace vorpipe::moving

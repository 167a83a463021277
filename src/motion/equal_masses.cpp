#include "motion/equal_masses.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/block_sums.h"
#include "base/try.h"
#include "motion/linear/laplacian.h"
#include "motion/linear/mass_change.h"
#include "motion/movable.h"

namespace vorpipe::moving {
namespace {

/// Returns the shortest moves, by the sum of their squares, that change masses by `missing`, to first order.
std::vector<Point> shortestWays(const MassChange& change, const std::vector<double>& missing, int threads) {
  constexpr double enough = 1e-3;
  const std::vector<double> alike(missing.size(), 1.0);
  std::vector<double> pressure;
  solvePressure(change, alike, missing, enough * normOf(missing, threads), threads, pressure);
  std::vector<Point> way;
  change.push(pressure, alike, way);
  return way;
}

/// Makes one attempt after another.
class Equalizer {
 public:
  Equalizer(Session& session, Sites sites, const CellsOptions& options)
      : options_(options),
        cells_(session, options),
        allowed_(options.domain, options.outline, options.periodic),
        threads_(session.threads()),
        result_{std::move(sites)} {}

  Result<EqualMasses> run(double tolerance, std::uint64_t most) {
    VORPIPE_LET(measured, measure(result_.sites));
    result_.worst = measured;
    while (result_.worst > tolerance && result_.diagrams < most) {
      const auto ways = shortestWays({cells_, result_.sites, options_.domain, threads_}, missing_, threads_);
      VORPIPE_LET(better, search(ways, most));
      if (!better) break;
    }
    return std::move(result_);
  }

 private:
  /// Returns the largest relative difference of a mass from the mean of all that have one; stores what each
  /// misses.
  Result<double> measure(const Sites& at) {
    VORPIPE_TRY(cells_.update(at));
    ++result_.diagrams;
    const auto& mass = cells_.moments().mass;
    const double sum = carefulSum(mass.size(), threads_, [&](std::size_t i) { return mass[i]; });
    const double cells =
        carefulSum(mass.size(), threads_, [&](std::size_t i) { return mass[i] > 0 ? 1.0 : 0.0; });
    const double mean = sum / cells;
    missing_.resize(mass.size());
    double worst = 0;
    for (std::size_t i = 0; i < mass.size(); ++i) {
      missing_[i] = mass[i] > 0 ? mean - mass[i] : 0;
      worst = std::max(worst, std::abs(missing_[i]) / mean);
    }
    return worst;
  }

  /// Takes the longest part of the moves, halved each time, that improves the worst cell.
  Result<bool> search(const std::vector<Point>& ways, std::uint64_t most) {
    constexpr double least = 0x1p-6;
    for (double length = 1; length >= least && result_.diagrams < most; length /= 2) {
      Sites at = result_.sites;
      forAll(at.size(), threads_, [&](std::size_t i) {
        const Point to = allowed_.nearestTo({at.x[i] + length * ways[i].x, at.y[i] + length * ways[i].y});
        at.x[i] = to.x;
        at.y[i] = to.y;
      });
      if (options_.periodic != Periodic::none) {
        VORPIPE_VAR(placed, wrapped(at, options_.domain, options_.periodic, threads_));
        at = std::move(placed);
      }
      VORPIPE_LET(measured, measure(at));
      if (!(measured < result_.worst)) continue;
      result_.worst = measured;
      result_.sites = std::move(at);
      return true;
    }
    return false;
  }

  const CellsOptions& options_;
  MovingCells cells_;
  AllowedPlaces allowed_;
  int threads_;
  EqualMasses result_;
  std::vector<double> missing_{};
};

}  // namespace

Result<EqualMasses> equalizeMasses(Session& session, Sites sites, const CellsOptions& options,
                                   double tolerance, std::uint64_t most) {
  return Equalizer(session, std::move(sites), options).run(tolerance, most);
}

}  // namespace vorpipe::moving

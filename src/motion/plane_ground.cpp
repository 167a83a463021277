#include <algorithm>
#include <cmath>
#include <utility>

#include "base/block_sums.h"
#include "base/try.h"
#include "motion/ground.h"
#include "motion/movable.h"

namespace vorpipe::moving {
namespace {

class PlaneGround final : public Ground {
 public:
  PlaneGround(Session& session, CellsOptions options)
      : session_(session),
        options_(std::move(options)),
        cells_(session, options_),
        allowed_(options_.domain, options_.outline, options_.periodic) {}

  Result<void> prepare(const Sites& sites) override {
    if (options_.density.values.empty()) return {};
    Density density = std::exchange(options_.density, {});
    CellsOptions weighed = options_;
    weighed.density = std::move(density);
    VORPIPE_LET(lattice, latticeEnergy(session_, sites, std::move(weighed)));
    lattice_ = lattice;
    return {};
  }

  Result<MeasuredSites> measure(const Sites& sites) override {
    VORPIPE_TRY(cells_.update(sites));
    MeasuredSites measured = measureSites(sites, cells_.moments(), allowed_, session_.threads());
    if (lattice_ == 0) lattice_ = latticeEnergy(measured.area);
    // The energy of a lattice depends on the weights.
    measured.hexagonal = sites.weight.empty()
                             ? measured.energy * static_cast<double>(measured.cells) / lattice_
                             : std::nan("");
    return measured;
  }

  [[nodiscard]] Result<Sites> moved(const Sites& sites, const MeasuredSites& at,
                                    const std::vector<double>& direction, double length) const override {
    const std::size_t count = sites.size();
    Sites where = sites;
    forAll(count, session_.threads(), [&](std::size_t i) {
      const Point to{sites.x[i] + length * direction[i], sites.y[i] + length * direction[count + i]};
      const Point place = at.inverse[i] > 0 ? allowed_.nearestTo(to) : Point{sites.x[i], sites.y[i]};
      where.x[i] = place.x;
      where.y[i] = place.y;
    });
    return placed(std::move(where));
  }

  [[nodiscard]] Result<Sites> placed(Sites sites) const override {
    if (options_.periodic == Periodic::none) return sites;
    return wrapped(sites, options_.domain, options_.periodic, session_.threads());
  }

  /// A site that it would move out of the domain takes Lloyd's step instead.
  void bend(const Sites& sites, const MeasuredSites& at, std::vector<double>& direction) const override {
    const std::size_t count = sites.size();
    forAll(count, session_.threads(), [&](std::size_t i) {
      const Point to{sites.x[i] + direction[i], sites.y[i] + direction[count + i]};
      if (allowed_.contain(to) && at.inverse[i] > 0) return;
      direction[i] = at.way[i];
      direction[count + i] = at.way[count + i];
    });
  }

  [[nodiscard]] LostSites placeLost(const Sites& sites, Sites& places) const override {
    return placeLostSites(sites, cells_.moments(), *this, places);
  }

  [[nodiscard]] bool contain(Point place) const override { return allowed_.contain(place); }
  [[nodiscard]] Point nearestTo(Point place) const override { return allowed_.nearestTo(place); }
  [[nodiscard]] Point beside(Point place, double right, double up) const override {
    return allowed_.nearestTo({place.x + right, place.y + up});
  }
  [[nodiscard]] double energyOf(const Sites& sites, std::size_t i) const override {
    return moving::energyOf(sites, cells_.moments(), i);
  }

  [[nodiscard]] Box box() const override { return options_.domain; }
  [[nodiscard]] double reach() const override {
    const Box& box = options_.domain;
    return std::max({std::abs(box.xmin), std::abs(box.xmax), std::abs(box.ymin), std::abs(box.ymax)});
  }
  [[nodiscard]] const Report& report() const override { return cells_.report(); }

 private:
  Session& session_;
  CellsOptions options_;  ///< without the density once it is prepared
  MovingCells cells_;
  AllowedPlaces allowed_;
  double lattice_ = 0;  ///< energy of the hexagonal lattice, times its number of cells
};

}  // namespace

std::unique_ptr<Ground> planeGround(Session& session, CellsOptions cells) {
  return std::make_unique<PlaneGround>(session, std::move(cells));
}

}  // namespace vorpipe::moving

#include <algorithm>
#include <cmath>
#include <new>
#include <numbers>
#include <utility>

#include "base/block_sums.h"
#include "base/parallel.h"
#include "base/progress_steps.h"
#include "base/refusal.h"
#include "base/try.h"
#include "domain/cell_mass.h"
#include "domain/degrees.h"
#include "globe/sphere_mesh.h"
#include "globe/sphere_moments.h"
#include "motion/ground.h"
#include "motion/movable.h"

namespace vorpipe::moving {
namespace {

using core::Direction;

constexpr double sphere_area = 4 * std::numbers::pi;

Direction takenFrom(const std::vector<double>& vectors, std::size_t i) {
  const std::size_t count = vectors.size() / 3;
  return {vectors[i], vectors[count + i], vectors[2 * count + i]};
}

void putInto(std::vector<double>& vectors, std::size_t i, const Direction& vector) {
  const std::size_t count = vectors.size() / 3;
  vectors[i] = vector.x;
  vectors[count + i] = vector.y;
  vectors[2 * count + i] = vector.z;
}

/// The part of a vector at right angles to a direction.
Direction tangent(const Direction& vector, const Direction& at) { return vector - dot(vector, at) * at; }

Direction directionAt(const Sites& sites, std::size_t i) {
  return core::directionOf({sites.x[i], sites.y[i]});
}

class GlobeGround final : public Ground {
 public:
  GlobeGround(const Session& session, const RelaxOptions& options)
      : options_(options), threads_(threadCount(session.threads())) {
    if (!options_.density.values.empty()) density_ = std::make_unique<core::GlobeDensity>(options_.density);
    const DeviceInfo& device = session.device();
    report_.backend = device.backend;
    report_.device = device.name;
    report_.driver = device.driver;
  }

  /// Integrates the root of the density, which is as large as relaxed cells are many.
  Result<void> prepare(const Sites& /*sites*/) override {
    if (density_ == nullptr) return {};
    Density roots = options_.density;
    for (double& value : roots.values) value = std::sqrt(value);
    const core::GlobeDensity root(roots);
    const core::SphereSites one{{{0, 0, 1}}, {}, {}};
    root_mass_ = momentsOf(one, {0, one.direction[0], {}, {}, {}}, &root).mass;
    return {};
  }

  /// Also: progress says stop (cancelled).
  Result<MeasuredSites> measure(const Sites& sites) override;

  [[nodiscard]] Result<Sites> moved(const Sites& sites, const MeasuredSites& at,
                                    const std::vector<double>& direction, double length) const override {
    Sites where = sites;
    forAll(sites.size(), threads_, [&](std::size_t i) {
      const Direction step = takenFrom(direction, i);
      if (!(at.inverse[i] > 0) || step == Direction{0, 0, 0}) return;
      put(where, i, directionAt(sites, i) + length * step);
    });
    return where;
  }

  [[nodiscard]] Result<Sites> placed(Sites sites) const override { return sites; }

  /// Sites move in the plane that touches the globe.
  void bend(const Sites& sites, const MeasuredSites& at, std::vector<double>& direction) const override {
    forAll(sites.size(), threads_, [&](std::size_t i) {
      const Direction step =
          at.inverse[i] > 0 ? tangent(takenFrom(direction, i), directionAt(sites, i)) : Direction{0, 0, 0};
      putInto(direction, i, step);
    });
  }

  [[nodiscard]] LostSites placeLost(const Sites& sites, Sites& places) const override {
    return placeLostSites(sites, moments_, *this, places);
  }

  [[nodiscard]] bool contain(Point /*place*/) const override { return true; }
  [[nodiscard]] Point nearestTo(Point place) const override { return place; }
  [[nodiscard]] Point beside(Point place, double right, double up) const override {
    const Direction at = core::directionOf(place), across = core::perpendicular(at);
    return core::placeOf(at + right * across + up * cross(at, across));
  }
  [[nodiscard]] double energyOf(const Sites& /*sites*/, std::size_t i) const override {
    return moments_.spread[i];
  }

  [[nodiscard]] Box box() const override {
    return {-whole_turn / 2, -quarter_turn, whole_turn / 2, quarter_turn};
  }
  [[nodiscard]] double reach() const override { return 1; }
  [[nodiscard]] const Report& report() const override { return report_; }

 private:
  static void put(Sites& sites, std::size_t i, const Direction& at) {
    const Point place = core::placeOf(at);
    sites.x[i] = place.x;
    sites.y[i] = place.y;
  }

  Result<MeasuredSites> measured(const Sites& sites);

  /// Sums over a block of sites.
  struct Part {
    CarefulSum energy, scale;
    double farthest = 0;
    std::uint64_t cells = 0, duplicates = 0, lost = 0;
  };

  void findCells(const core::SphereSites& sites, const core::SphereMesh& mesh,
                 const core::SphereCells& cells);
  void measureSite(const core::SphereSites& sites, std::size_t i, MeasuredSites& measured, Part& part) const;

  const RelaxOptions& options_;
  int threads_;
  std::unique_ptr<core::GlobeDensity> density_;
  double root_mass_ = 0;  ///< the integral of the density's root
  std::vector<core::SphereMoments> cells_{};
  CellMoments moments_{};  ///< in steradians; `spread` is the energy about the site
  Report report_{};
};

void GlobeGround::findCells(const core::SphereSites& sites, const core::SphereMesh& mesh,
                            const core::SphereCells& cells) {
  constexpr std::size_t grain = 64;
  const std::size_t count = sites.direction.size();
  cells_.assign(count, {});
  moments_.status.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    moments_.status[i] = mesh.owner[i] != i ? Status::duplicate : Status::empty;
  }
  for (auto* numbers : {&moments_.area, &moments_.mass, &moments_.spread}) numbers->assign(count, 0);
  parallelFor(cells.steps(), grain, threads_, [&](std::size_t begin, std::size_t end) {
    cells.visit(begin, end, [&](const core::SphereCell& cell) {
      const auto i = cell.site;
      cells_[i] = momentsOf(sites, cell, density_.get());
      moments_.status[i] = Status::ok;
      moments_.area[i] = cells_[i].area;
      moments_.mass[i] = cells_[i].mass;
      moments_.spread[i] = cells_[i].energy;
    });
  });
}

/// With v = p / cos(r) the energy is the integral of 2 - 2 x . v by mass, which is |x - p|^2 without a
/// weight, and a cell is where it is less than with any other v. So its gradient is that of fixed cells.
void GlobeGround::measureSite(const core::SphereSites& sites, std::size_t i, MeasuredSites& measured,
                              Part& part) const {
  const core::SphereMoments& of_cell = cells_[i];
  const double mass = of_cell.mass;
  part.cells += moments_.status[i] == Status::ok ? 1U : 0U;
  part.duplicates += moments_.status[i] == Status::duplicate ? 1U : 0U;
  if (!(mass > 0)) {
    ++part.lost;
    return;
  }
  const Direction& own = sites.direction[i];
  const double excess = sites.excessOf(i);
  const double weighted = excess * (2 * mass - of_cell.energy);
  part.energy.add(of_cell.energy);
  part.energy.add(-weighted);
  part.scale.add(of_cell.energy + std::abs(weighted));
  const double curvature = 2 * (1 + excess) * mass;
  putInto(measured.gradient, i, -2 * (1 + excess) * tangent(of_cell.lean, own));
  putInto(measured.inverse, i, {1 / curvature, 1 / curvature, 1 / curvature});
  // The center of mass is below the surface; of the whole sphere it has no direction.
  const Direction center = own + 1 / mass * of_cell.lean;
  constexpr double nowhere = 1e-9;
  if (lengthOf(center) < nowhere) return;
  const Direction way = normalized(center) - own;
  putInto(measured.way, i, way);
  part.farthest = std::max(part.farthest, lengthOf(way));
}

Result<MeasuredSites> GlobeGround::measure(const Sites& sites) {
  VORPIPE_TRY(reportProgress(options_.progress, "cells", 0, 1));
  try {
    return measured(sites);
  } catch (const std::bad_alloc&) {
    return tl::unexpected(Error{ErrorCode::device, "out of memory; fewer sites would fit"});
  }
}

Result<MeasuredSites> GlobeGround::measured(const Sites& sites) {
  const std::size_t count = sites.size();
  const core::SphereSites placed = core::placedOn(sites, threads_);
  VORPIPE_LET(mesh, triangulateSphere(placed, threads_));
  VORPIPE_LET(cells, cellsOfSphere(placed, mesh, /*has_places=*/false, threads_));
  findCells(placed, mesh, cells);
  MeasuredSites measures;
  for (auto* vectors : {&measures.gradient, &measures.inverse, &measures.way}) vectors->resize(3 * count);
  const auto parts = byBlocks<Part>(count, threads_, [&](std::size_t begin, std::size_t end) {
    Part part;
    for (auto i = begin; i < end; ++i) measureSite(placed, i, measures, part);
    return part;
  });
  CarefulSum energy, scale;
  std::uint64_t lost = 0;
  report_.duplicate = 0;
  for (const Part& part : parts) {
    energy.add(part.energy.value());
    scale.add(part.scale.value());
    measures.farthest = std::max(measures.farthest, part.farthest);
    measures.cells += part.cells;
    report_.duplicate += part.duplicates;
    lost += part.lost;
  }
  measures.energy = energy.value();
  measures.scale = scale.value();
  measures.area = sphere_area;
  measures.has_lost = lost > 0;
  report_.ok = measures.cells;
  report_.hidden = report_.empty = count - measures.cells - report_.duplicate;
  const double part_of_area = density_ != nullptr ? root_mass_ / sphere_area : 1;
  measures.hexagonal =
      sites.weight.empty()
          ? measures.energy / (part_of_area * part_of_area * core::leastEnergyOnSphere(measures.cells))
          : std::nan("");
  return measures;
}

}  // namespace

std::unique_ptr<Ground> globeGround(const Session& session, const RelaxOptions& options) {
  return std::make_unique<GlobeGround>(session, options);
}

Result<void> checkMovableOnGlobe(const Sites& sites, const RelaxOptions& options, int threads) {
  if (!options.outline.empty()) {
    return tl::unexpected(refusalOf(Subject::domain, "with globe sites relax on the whole Earth"));
  }
  if (options.equal_masses) {
    return tl::unexpected(Error{ErrorCode::input, "equal_masses: are of a plane, and not of the globe"});
  }
  CellsOptions cells{};
  cells.globe = true;
  cells.search = options.search;
  VORPIPE_TRY(checkInput(sites, cells, threads));
  if (options.equal_masses) {
    return tl::unexpected(refusalOf(Subject::density, "equal masses are for a plane, not for the globe"));
  }
  if (options.density.values.empty()) return {};
  VORPIPE_TRY(core::checkDensity(options.density));
  VORPIPE_TRY(core::checkOnGlobe(options.density));
  return checkRange(options.density);
}

}  // namespace vorpipe::moving

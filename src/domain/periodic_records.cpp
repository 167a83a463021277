#include "domain/periodic_records.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/parallel.h"
#include "cells/cell_record.h"
#include "cells/diagram_writer.h"
#include "sites/images.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t band_proof_grain = 1 << 14;
/// Bounds of the rounding of a distance, relative to it, and of a coordinate, relative to the period.
constexpr double distance_rounding = 1e-9, coordinate_rounding = 1e-12;

/// How much wider the bands should be for some cells.
using Deficit = std::array<double, 2>;

class Proof {
 public:
  Proof(const PeriodicSites& placed, const ImagedSites& imaged, const Diagram& diagram, const Band& band)
      : placed_(placed), imaged_(imaged), diagram_(diagram), band_(band) {
    low_ = {imaged.covered.xmin, imaged.covered.ymin};
    high_ = {imaged.covered.xmax, imaged.covered.ymax};
    for (const std::size_t a : {0u, 1u}) {
      open_[a] = !isWhole(band, placed, a);
      slack_[a] = coordinate_rounding * placed.axis[a].length;
    }
  }

  [[nodiscard]] bool isNeeded() const { return open_[0] || open_[1]; }

  void widen(std::size_t begin, std::size_t end, Deficit& deficit) const {
    for (auto i = begin; i < end; ++i) {
      for (auto e = diagram_.cell_offsets[i]; e < diagram_.cell_offsets[i + 1]; ++e) widenFor(i, e, deficit);
    }
  }

 private:
  void widenFor(std::size_t i, std::size_t e, Deficit& deficit) const {
    const Point v = diagram_.vertices[e];
    const std::array<double, 2> place{v.x, v.y};
    const double dx = v.x - imaged_.sites.x[i], dy = v.y - imaged_.sites.y[i];
    const auto& weight = imaged_.sites.weight;
    const double squared = dx * dx + dy * dy + (weight.empty() ? 0 : band_.heaviest - weight[i]);
    if (squared <= 0) return;  // Of a heavy site: no image of another site matters there.
    for (const std::size_t a : {0u, 1u}) {
      if (!open_[a]) continue;
      const double room = std::min(place[a] - low_[a], high_[a] - place[a]) - slack_[a];
      if (room > 0 && squared * (1 + distance_rounding) <= room * room) continue;
      const double reach =
          std::min((1 + distance_rounding) * std::sqrt(squared), 0.5 * placed_.axis[a].length);
      // A vertex beyond may not be one of the whole cell, which may reach arbitrarily far.
      deficit[a] = std::max(deficit[a], room > 0 ? reach - room : band_.width[a] + reach);
    }
  }

  const PeriodicSites& placed_;
  const ImagedSites& imaged_;
  const Diagram& diagram_;
  const Band& band_;
  std::array<double, 2> low_{}, high_{}, slack_{};
  std::array<bool, 2> open_{};
};

constexpr std::size_t unwrap_grain = 1 << 14;

class CellUnwrapper {
 public:
  CellUnwrapper(const PeriodicSites& placed, const ImagedSites& imaged, Diagram& diagram)
      : placed_(placed), imaged_(imaged), diagram_(diagram), unscale_(placed.exponent) {}

  void cells(std::size_t begin, std::size_t end) {
    for (auto i = begin; i < end; ++i) {
      nameNeighbors(i);
      moveCell(i);
    }
  }

 private:
  void nameNeighbors(std::size_t i) {
    Diagram& d = diagram_;
    const auto begin = d.cell_offsets[i], end = d.cell_offsets[i + 1];
    const auto count = static_cast<std::int64_t>(imaged_.count);
    const auto& home = placed_.home[i];
    bool renamed = false;
    for (auto e = begin; e < end; ++e) {
      const auto entry = d.neighbors[e];
      if (entry < 0) continue;
      std::array<std::int8_t, 2> shift{0, 0};
      if (entry >= count) {
        const SiteImage& image = imaged_.images[static_cast<std::size_t>(entry - count)];
        d.neighbors[e] = image.site;
        shift = image.shift;
        renamed = true;
      }
      const auto& other_home = placed_.home[static_cast<std::size_t>(d.neighbors[e])];
      for (const std::size_t a : {0u, 1u}) d.neighbor_shifts[e][a] = shift[a] + home[a] - other_home[a];
    }
    if (renamed) beginAtLowest(begin, end);
  }

  /// Rotates a list so that it begins at its lowest neighbor, as in any diagram.
  void beginAtLowest(std::uint64_t begin, std::uint64_t end) {
    Diagram& d = diagram_;
    auto lowest = begin;
    for (auto e = begin; e < end; ++e) {
      if (std::tuple(d.neighbors[e], d.neighbor_shifts[e]) <
          std::tuple(d.neighbors[lowest], d.neighbor_shifts[lowest])) {
        lowest = e;
      }
    }
    const auto rotate = [&](auto& list) {
      const auto at = [&](std::uint64_t e) { return list.begin() + static_cast<std::ptrdiff_t>(e); };
      std::rotate(at(begin), at(lowest), at(end));
    };
    rotate(d.neighbors);
    rotate(d.neighbor_shifts);
    rotate(d.vertices);
    rotate(d.edge_lengths);
  }

  void moveCell(std::size_t i) {
    Diagram& d = diagram_;
    const auto [x, y] = placed_.home[i];
    const auto moved = [&, x = x, y = y](Point p) {
      return unscale_(Point{placed_.axis[0].number(p.x, x), placed_.axis[1].number(p.y, y)});
    };
    // The caller's site may be elsewhere; the run's own is exact.
    const Sites& sites = imaged_.sites;
    d.centroid[i] = moved(d.status[i] == Status::ok ? d.centroid[i] : Point{sites.x[i], sites.y[i]});
    d.area[i] = unscale_(d.area[i], 2);
    d.perimeter[i] = unscale_(d.perimeter[i]);
    for (double& moment : d.second_moments[i]) moment = unscale_(moment, 4);
    for (auto e = d.cell_offsets[i]; e < d.cell_offsets[i + 1]; ++e) {
      d.vertices[e] = moved(d.vertices[e]);
      d.edge_lengths[e] = unscale_(d.edge_lengths[e]);
    }
  }

  const PeriodicSites& placed_;
  const ImagedSites& imaged_;
  Diagram& diagram_;
  Unscale unscale_;
};

}  // namespace

Band bandThatProves(const PeriodicSites& placed, const ImagedSites& imaged, const Diagram& diagram,
                    const Band& band, int threads) {
  const Proof proof(placed, imaged, diagram, band);
  if (!proof.isNeeded()) return band;
  std::vector<Deficit> deficits((imaged.count + band_proof_grain - 1) / band_proof_grain, Deficit{0, 0});
  parallelFor(imaged.count, band_proof_grain, threads, [&](std::size_t begin, std::size_t end) {
    proof.widen(begin, end, deficits[begin / band_proof_grain]);
  });
  Band wider = band;
  for (const std::size_t a : {0u, 1u}) {
    double deficit = 0;
    for (const Deficit& part : deficits) deficit = std::max(deficit, part[a]);
    if (deficit > 0) wider.width[a] = cappedBand(placed.axis[a], 1.001 * (band.width[a] + deficit));
  }
  return wider;
}

bool isClosed(const ImagedSites& imaged, const Diagram& diagram) {
  const auto edges = diagram.cell_offsets[imaged.count];
  for (std::uint64_t e = 0; e < edges; ++e) {
    const std::int64_t neighbor = diagram.neighbors[e];
    if (neighbor < static_cast<std::int64_t>(imaged.count)) continue;
    if (diagram.status[imaged.siteOf(static_cast<std::uint32_t>(neighbor))] != Status::ok) return false;
  }
  return true;
}

void keepSites(const ImagedSites& imaged, Diagram& diagram) {
  const auto count = imaged.count;
  diagram.status.resize(count);
  diagram.owner.resize(count);
  diagram.area.resize(count);
  diagram.perimeter.resize(count);
  diagram.centroid.resize(count);
  diagram.second_moments.resize(count);
  diagram.cell_offsets.resize(count + 1);
  const auto edges = diagram.cell_offsets.back();
  diagram.vertices.resize(edges);
  diagram.neighbors.resize(edges);
  diagram.edge_lengths.resize(edges);
  auto& report = diagram.report;
  report.ok = static_cast<std::uint64_t>(std::ranges::count(diagram.status, Status::ok));
  report.empty = static_cast<std::uint64_t>(std::ranges::count(diagram.status, Status::empty));
  report.duplicate = count - report.ok - report.empty;
  // Either no site is hidden, or weights differ and all empty sites are hidden.
  report.hidden = std::min(report.hidden, report.empty);
}

void finishRecords(const PeriodicSites& placed, const ImagedSites& imaged, Detail detail, int threads,
                   Diagram& diagram) {
  diagram.neighbor_shifts.resize(diagram.neighbors.size());
  CellUnwrapper unwrapper(placed, imaged, diagram);
  parallelFor(imaged.count, unwrap_grain, threads,
              [&](std::size_t begin, std::size_t end) { unwrapper.cells(begin, end); });
  if (detail == Detail::measures) dropPolygons(diagram);
}

}  // namespace vorpipe::core

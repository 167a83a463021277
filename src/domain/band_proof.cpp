#include "domain/band_proof.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "sites/band.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t band_proof_grain = 1 << 14;
/// Bounds of the rounding of a distance, relative to it, and of a coordinate, relative to the period.
constexpr double distance_rounding = 1e-9, place_rounding = 1e-12;

/// How much wider the bands should be for some cells.
using Lack = std::array<double, 2>;

class Proof {
 public:
  Proof(const PeriodicSites& placed, const ImagedSites& imaged, const Diagram& diagram, const Band& band)
      : placed_(placed), imaged_(imaged), diagram_(diagram), band_(band) {
    low_ = {imaged.covered.xmin, imaged.covered.ymin};
    high_ = {imaged.covered.xmax, imaged.covered.ymax};
    for (const std::size_t a : {0u, 1u}) {
      open_[a] = !isWhole(band, placed, a);
      slack_[a] = place_rounding * placed.axis[a].length;
    }
  }

  [[nodiscard]] bool isNeeded() const { return open_[0] || open_[1]; }

  void widen(std::size_t begin, std::size_t end, Lack& lack) const {
    for (auto i = begin; i < end; ++i) {
      for (auto e = diagram_.cell_offsets[i]; e < diagram_.cell_offsets[i + 1]; ++e) widenFor(i, e, lack);
    }
  }

 private:
  void widenFor(std::size_t i, std::size_t e, Lack& lack) const {
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
      lack[a] = std::max(lack[a], room > 0 ? reach - room : band_.width[a] + reach);
    }
  }

  const PeriodicSites& placed_;
  const ImagedSites& imaged_;
  const Diagram& diagram_;
  const Band& band_;
  std::array<double, 2> low_{}, high_{}, slack_{};
  std::array<bool, 2> open_{};
};

}  // namespace

Band bandThatProves(const PeriodicSites& placed, const ImagedSites& imaged, const Diagram& diagram,
                    const Band& band, int threads) {
  const Proof proof(placed, imaged, diagram, band);
  if (!proof.isNeeded()) return band;
  std::vector<Lack> lacks((imaged.count + band_proof_grain - 1) / band_proof_grain, Lack{0, 0});
  parallelFor(imaged.count, band_proof_grain, threads, [&](std::size_t begin, std::size_t end) {
    proof.widen(begin, end, lacks[begin / band_proof_grain]);
  });
  Band wider = band;
  for (const std::size_t a : {0u, 1u}) {
    double lack = 0;
    for (const Lack& part : lacks) lack = std::max(lack, part[a]);
    if (lack > 0) wider.width[a] = cappedBand(placed.axis[a], 1.001 * (band.width[a] + lack));
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

}  // namespace vorpipe::core

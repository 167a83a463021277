#include "core/cells/cell_mass.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/refusal.h"
#include "core/cells/cell_rings.h"
#include "core/cells/polygon_mass.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t grain = 256;

tl::unexpected<Error> refuse(const std::string& what) {
  return tl::unexpected(refusalOf(Subject::density, what));
}

class Masses {
 public:
  Masses(const DensityPixels& pixels, Diagram& diagram) : diagram_(diagram), scale_(pixels) {}

  void cell(std::size_t i) {
    diagram_.mass[i] = 0;
    diagram_.mass_centroid[i] = diagram_.centroid[i];
    if (diagram_.status[i] != Status::ok) return;
    const auto begin = diagram_.cell_offsets[i], end = diagram_.cell_offsets[i + 1];
    if (const auto value = scale_.begin({0, 0}, boxAround(begin, end, diagram_.centroid[i]))) {
      diagram_.mass[i] = *value * diagram_.area[i];
      return;
    }
    eachEdge(diagram_.ring_starts, begin, end, [&](std::uint64_t v, std::uint64_t next) {
      scale_.add(diagram_.vertices[v], diagram_.vertices[next]);
    });
    const PolygonMass weighed = scale_.weigh();
    if (!(weighed.mass > 0)) return;
    diagram_.mass[i] = weighed.mass;
    diagram_.mass_centroid[i] = weighed.center;
  }

 private:
  /// Of its vertices; of its centroid if it has none, because all its edges are ties.
  [[nodiscard]] Box boxAround(std::uint64_t begin, std::uint64_t end, Point centroid) const {
    const auto vertices = std::span(diagram_.vertices).subspan(begin, end - begin);
    return boxOf(vertices.empty() ? std::span<const Point>(&centroid, 1) : vertices);
  }

  Diagram& diagram_;
  PolygonScale scale_;
};

}  // namespace

Result<void> checkDensity(const Density& density) {
  if (density.width < 1 || density.height < 1) {
    return refuse(fmt::format("{}x{} pixels; each side must be 1 or more", density.width, density.height));
  }
  const auto width = static_cast<std::size_t>(density.width);
  const std::size_t pixels = width * static_cast<std::size_t>(density.height);
  if (density.values.size() != pixels) {
    return refuse(
        fmt::format("{} values for {}x{} pixels", density.values.size(), density.width, density.height));
  }
  const auto wrong =
      std::ranges::find_if_not(density.values, [](double v) { return std::isfinite(v) && v >= 0; });
  if (wrong == density.values.end()) return {};
  const auto pixel = static_cast<std::size_t>(wrong - density.values.begin());
  return refuse(fmt::format("row {}, column {} (counted from 0) is {}, not a finite number of 0 or more",
                            pixel / width, pixel % width, *wrong));
}

void measureMass(const Density& density, const Box& domain, Periodic periodic, int threads,
                 Diagram& diagram) {
  const DensityPixels pixels(density, domain, periodic);
  diagram.mass.resize(diagram.status.size());
  diagram.mass_centroid.resize(diagram.status.size());
  parallelFor(diagram.status.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
    Masses masses(pixels, diagram);
    for (auto i = begin; i < end; ++i) masses.cell(i);
  });
}

}  // namespace vorpipe::core

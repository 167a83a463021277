#include "core/cells/cell_mass.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/refusal.h"
#include "core/cells/cell_rings.h"
#include "core/cells/density_pixels.h"
#include "core/cells/pixel_rows.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t grain = 256;

tl::unexpected<Error> refuse(const std::string& what) {
  return tl::unexpected(refusalOf(Subject::density, what));
}

class Masses {
 public:
  Masses(const Density& density, const Box& domain, Periodic periodic, Diagram& diagram,
         std::vector<double>* spread)
      : pixels_(density, domain, periodic), diagram_(diagram), spread_(spread) {}

  void cell(std::size_t i) {
    diagram_.mass[i] = 0;
    diagram_.mass_centroid[i] = diagram_.centroid[i];
    if (diagram_.status[i] != Status::ok) return;
    const auto begin = diagram_.cell_offsets[i], end = diagram_.cell_offsets[i + 1];
    const Box box = boxAround(begin, end, diagram_.centroid[i]);
    const Point offset{pixels_.x.pixelsTo(box.xmin), pixels_.y.pixelsTo(box.ymin)};
    const PixelRows::Range columns{pixels_.x.at(offset.x), pixels_.x.at(pixels_.x.pixelsTo(box.xmax))};
    const PixelRows::Range rows{pixels_.y.at(offset.y), pixels_.y.at(pixels_.y.pixelsTo(box.ymax))};
    if (columns.first == columns.last && rows.first == rows.last) {
      const double value = pixels_.at(rows.first, columns.first);
      diagram_.mass[i] = value * diagram_.area[i];
      if (spread_ != nullptr) {
        (*spread_)[i] = value * (diagram_.second_moments[i][0] + diagram_.second_moments[i][2]);
      }
      return;
    }
    rows_.begin(offset, (box.ymax - box.ymin) / pixels_.y.size, columns, rows);
    eachEdge(diagram_.ring_starts, begin, end, [&](std::uint64_t v, std::uint64_t next) {
      rows_.add(inPixels(diagram_.vertices[v], box), inPixels(diagram_.vertices[next], box));
    });
    PixelIntegrals sum;
    rows_.integrate([&](std::int64_t row, std::int64_t column, const PixelIntegrals& pixel) {
      const double value = pixels_.at(row, column);
      sum.area += value * pixel.area;
      sum.x += value * pixel.x;
      sum.y += value * pixel.y;
      sum.xx += value * pixel.xx;
      sum.yy += value * pixel.yy;
    });
    if (!(sum.area > 0)) return;
    diagram_.mass[i] = sum.area * pixels_.x.size * pixels_.y.size;
    diagram_.mass_centroid[i] = {box.xmin + sum.x / sum.area * pixels_.x.size,
                                 box.ymin + sum.y / sum.area * pixels_.y.size};
    if (spread_ != nullptr) (*spread_)[i] = spreadOf(sum);
  }

 private:
  /// About the center of mass, in the caller's units.
  [[nodiscard]] double spreadOf(const PixelIntegrals& sum) const {
    const double across = (sum.xx - sum.x * (sum.x / sum.area)) * pixels_.x.size * pixels_.x.size;
    const double along = (sum.yy - sum.y * (sum.y / sum.area)) * pixels_.y.size * pixels_.y.size;
    return std::max(0.0, across + along) * pixels_.x.size * pixels_.y.size;
  }
  /// Of its vertices; of its centroid if it has none, because all its edges are ties.
  [[nodiscard]] Box boxAround(std::uint64_t begin, std::uint64_t end, Point centroid) const {
    const auto vertices = std::span(diagram_.vertices).subspan(begin, end - begin);
    return boxOf(vertices.empty() ? std::span<const Point>(&centroid, 1) : vertices);
  }
  [[nodiscard]] Point inPixels(Point p, const Box& box) const {
    return {(p.x - box.xmin) / pixels_.x.size, (p.y - box.ymin) / pixels_.y.size};
  }

  DensityPixels pixels_;
  Diagram& diagram_;
  std::vector<double>* spread_;  ///< may be null
  PixelRows rows_;
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

void measureMass(const Density& density, const Box& domain, Periodic periodic, int threads, Diagram& diagram,
                 std::vector<double>* spread) {
  if (spread != nullptr) spread->assign(diagram.status.size(), 0);
  diagram.mass.resize(diagram.status.size());
  diagram.mass_centroid.resize(diagram.status.size());
  parallelFor(diagram.status.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
    Masses masses(density, domain, periodic, diagram, spread);
    for (auto i = begin; i < end; ++i) masses.cell(i);
  });
}

}  // namespace vorpipe::core

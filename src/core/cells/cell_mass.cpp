#include "core/cells/cell_mass.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/refusal.h"
#include "core/cells/pixel_rows.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t grain = 256;

tl::unexpected<Error> refuse(const std::string& what) {
  return tl::unexpected(refusalOf(Subject::density, what));
}

/// The rings of a cell, as ranges of a diagram's vertices.
class CellRings {
 public:
  CellRings(const Diagram& diagram, std::size_t cell)
      : diagram_(diagram), begin_(diagram.cell_offsets[cell]), end_(diagram.cell_offsets[cell + 1]) {}

  [[nodiscard]] std::uint64_t begin() const { return begin_; }
  [[nodiscard]] std::uint64_t end() const { return end_; }

  /// Calls take(a, b) for each edge.
  template <class Take>
  void eachEdge(const Take& take) const {
    const auto& starts = diagram_.ring_starts;
    auto start = std::ranges::upper_bound(starts, begin_);
    for (auto ring = begin_; ring < end_;) {
      const auto next = start != starts.end() ? std::min(*start++, end_) : end_;
      for (auto v = ring; v < next; ++v) {
        take(diagram_.vertices[v], diagram_.vertices[v + 1 < next ? v + 1 : ring]);
      }
      ring = next;
    }
  }

 private:
  const Diagram& diagram_;
  std::uint64_t begin_, end_;
};

/// The pixels along one axis.
struct PixelAxis {
  double low, size;  ///< of the first pixel, in the caller's units
  std::int64_t count;
  bool periodic;

  [[nodiscard]] double pixelsTo(double place) const { return (place - low) / size; }
  [[nodiscard]] std::int64_t at(double pixels) const {
    const auto pixel = static_cast<std::int64_t>(std::floor(pixels));
    return periodic ? pixel : std::clamp<std::int64_t>(pixel, 0, count - 1);
  }
  [[nodiscard]] std::size_t wrapped(std::int64_t pixel) const {
    const std::int64_t rest = pixel % count;
    return static_cast<std::size_t>(rest < 0 ? rest + count : rest);
  }
};

class Masses {
 public:
  Masses(const Density& density, const Box& domain, Periodic periodic, Diagram& diagram,
         std::vector<double>* spread)
      : density_(density),
        x_{domain.xmin, (domain.xmax - domain.xmin) / density.width, density.width,
           periodic == Periodic::x || periodic == Periodic::xy},
        y_{domain.ymin, (domain.ymax - domain.ymin) / density.height, density.height,
           periodic == Periodic::y || periodic == Periodic::xy},
        diagram_(diagram),
        spread_(spread) {}

  void cell(std::size_t i) {
    diagram_.mass[i] = 0;
    diagram_.mass_centroid[i] = diagram_.centroid[i];
    if (diagram_.status[i] != Status::ok) return;
    const CellRings rings(diagram_, i);
    const Box box = boxAround(rings, diagram_.centroid[i]);
    const Point offset{x_.pixelsTo(box.xmin), y_.pixelsTo(box.ymin)};
    const PixelRows::Range columns{x_.at(offset.x), x_.at(x_.pixelsTo(box.xmax))};
    const PixelRows::Range rows{y_.at(offset.y), y_.at(y_.pixelsTo(box.ymax))};
    if (columns.first == columns.last && rows.first == rows.last) {
      const double value = valueAt(rows.first, columns.first);
      diagram_.mass[i] = value * diagram_.area[i];
      if (spread_ != nullptr) {
        (*spread_)[i] = value * (diagram_.second_moments[i][0] + diagram_.second_moments[i][2]);
      }
      return;
    }
    rows_.begin(offset, (box.ymax - box.ymin) / y_.size, columns, rows);
    rings.eachEdge([&](Point a, Point b) { rows_.add(inPixels(a, box), inPixels(b, box)); });
    PixelIntegrals sum;
    rows_.integrate([&](std::int64_t row, std::int64_t column, const PixelIntegrals& pixel) {
      const double value = valueAt(row, column);
      sum.area += value * pixel.area;
      sum.x += value * pixel.x;
      sum.y += value * pixel.y;
      sum.xx += value * pixel.xx;
      sum.yy += value * pixel.yy;
    });
    if (!(sum.area > 0)) return;
    diagram_.mass[i] = sum.area * x_.size * y_.size;
    diagram_.mass_centroid[i] = {box.xmin + sum.x / sum.area * x_.size,
                                 box.ymin + sum.y / sum.area * y_.size};
    if (spread_ != nullptr) (*spread_)[i] = spreadOf(sum);
  }

 private:
  /// About the center of mass, in the caller's units.
  [[nodiscard]] double spreadOf(const PixelIntegrals& sum) const {
    const double across = (sum.xx - sum.x * (sum.x / sum.area)) * x_.size * x_.size;
    const double along = (sum.yy - sum.y * (sum.y / sum.area)) * y_.size * y_.size;
    return std::max(0.0, across + along) * x_.size * y_.size;
  }
  /// Of its vertices; of its centroid if it has none, because all its edges are ties.
  [[nodiscard]] Box boxAround(const CellRings& rings, Point centroid) const {
    const auto vertices = std::span(diagram_.vertices).subspan(rings.begin(), rings.end() - rings.begin());
    return boxOf(vertices.empty() ? std::span<const Point>(&centroid, 1) : vertices);
  }
  [[nodiscard]] Point inPixels(Point p, const Box& box) const {
    return {(p.x - box.xmin) / x_.size, (p.y - box.ymin) / y_.size};
  }
  /// Rows of the density count from the top.
  [[nodiscard]] double valueAt(std::int64_t row, std::int64_t column) const {
    const std::size_t from_top = static_cast<std::size_t>(y_.count) - 1 - y_.wrapped(row);
    return density_.values[from_top * static_cast<std::size_t>(x_.count) + x_.wrapped(column)];
  }

  const Density& density_;
  PixelAxis x_, y_;
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

#include "io/cells/fluid_series.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <string_view>
#include <utility>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/input_file.h"
#include "io/base/number.h"
#include "io/cells/cells_mesh.h"
#include "io/cells/vtk_xml.h"

namespace vorpipe {
namespace {

using std::numbers::pi;

/// Corners of a whole circle.
constexpr double corners_of_circle = 48;

/// The part of a segment inside the disc around the origin: from and to in [0, 1]; from > to if there is
/// none.
struct Inside {
  double from = 1, to = 0;
};

Inside insideDisc(Point begin, Point end, double radius) {
  const double wx = end.x - begin.x, wy = end.y - begin.y;
  const double a = wx * wx + wy * wy, b = begin.x * wx + begin.y * wy;
  const double c = begin.x * begin.x + begin.y * begin.y - radius * radius;
  const double square = b * b - a * c;
  if (!(a > 0) || !(square > 0)) return {};
  const double root = std::sqrt(square);
  return {std::max(0.0, (-b - root) / a), std::min(1.0, (-b + root) / a)};
}

/// The part of a convex polygon around the origin inside the disc, counter-clockwise.
class DiscPart {
 public:
  explicit DiscPart(double radius) : radius_(radius) {}

  void cut(std::span<const Point> polygon, bool holds_center) {
    points.clear();
    bool any = false;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Point begin = polygon[k], end = polygon[k + 1 < polygon.size() ? k + 1 : 0];
      const auto [from, to] = insideDisc(begin, end, radius_);
      if (!(from < to)) continue;
      const auto at = [&](double part) {
        return Point{begin.x + part * (end.x - begin.x), begin.y + part * (end.y - begin.y)};
      };
      if (any && from > 0) arc(points.back(), at(from));
      points.push_back(at(from));
      if (to < 1) points.push_back(at(to));
      any = true;
    }
    if (any) {
      arc(points.back(), points.front());
    } else if (holds_center) {
      for (double k = 0; k < corners_of_circle; ++k) onCircle(2 * pi * k / corners_of_circle);
    }
  }

  std::vector<Point> points{};

 private:
  void onCircle(double angle) { points.push_back({radius_ * std::cos(angle), radius_ * std::sin(angle)}); }
  /// Adds the corners between two points, if both are on the circle and differ.
  void arc(Point from, Point to) {
    const double first = std::atan2(from.y, from.x);
    double turn = std::atan2(to.y, to.x) - first;
    if (turn < 0) turn += 2 * pi;
    const double gap = std::hypot(from.x - to.x, from.y - to.y);
    const bool on_circle = std::abs(std::hypot(from.x, from.y) - radius_) < 1e-9 * radius_ &&
                           std::abs(std::hypot(to.x, to.y) - radius_) < 1e-9 * radius_;
    if (!on_circle || gap < 1e-12 * radius_) return;
    const double parts = std::ceil(turn / (2 * pi) * corners_of_circle);
    for (double k = 1; k < parts; ++k) onCircle(first + turn * k / parts);
  }

  double radius_;
};

bool holdsOrigin(std::span<const Point> polygon) {
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point a = polygon[k], b = polygon[k + 1 < polygon.size() ? k + 1 : 0];
    if (a.x * b.y - a.y * b.x < 0) return false;
  }
  return true;
}

/// Returns the parts of cells inside the discs around their sites as faces of a mesh; each face has points of
/// its own. Radii are the square roots of the weights. Polygons with corners on the circle replace arcs, so
/// faces are a little smaller than the cells.
CellsMesh freeSurfaceCells(const Sites& sites, const Diagram& diagram) {
  CellsMesh mesh;
  mesh.offsets.push_back(0);
  std::vector<Point> polygon;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const double weight = sites.weight.empty() ? 0 : sites.weight[i];
    polygon.clear();
    for (auto k = diagram.cell_offsets[i]; k < diagram.cell_offsets[i + 1]; ++k) {
      polygon.push_back({diagram.vertices[k].x - sites.x[i], diagram.vertices[k].y - sites.y[i]});
    }
    if (polygon.empty() || !(weight > 0)) continue;
    DiscPart part(std::sqrt(weight));
    part.cut(polygon, holdsOrigin(polygon));
    if (part.points.size() < 3) continue;
    for (const Point& point : part.points) {
      mesh.corners.push_back(static_cast<std::int32_t>(mesh.points.size()));
      mesh.points.push_back({point.x + sites.x[i], point.y + sites.y[i]});
    }
    mesh.offsets.push_back(mesh.corners.size());
    mesh.sites.push_back(static_cast<std::uint32_t>(i));
  }
  return mesh;
}

std::vector<VtkArray> fluidData(const CellsMesh& mesh, const FluidState& state) {
  std::vector<VtkArray> data{
      vtkNumbers<std::uint32_t>("site", mesh.size(), [&](std::size_t face) { return mesh.sites[face]; }),
      vtkPoints("velocity", mesh.size(), [&](std::size_t face) { return state.velocity[mesh.sites[face]]; })};
  const auto add = [&](std::string_view name, const std::vector<double>& by_site) {
    if (by_site.empty()) return;
    data.push_back(
        vtkNumbers<double>(name, mesh.size(), [&](std::size_t face) { return by_site[mesh.sites[face]]; }));
  };
  add("pressure", state.pressure);
  add("volume", state.volume);
  add("density", state.density);
  return data;
}

constexpr std::string_view series_head =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
constexpr std::string_view before_time = "    <DataSet timestep=\"", before_file = "\" part=\"0\" file=\"";
constexpr std::string_view after_file = "\"/>\n", series_tail = "  </Collection>\n</VTKFile>\n";

}  // namespace

Result<void> writeFluidStep(ByteSink& sink, const FluidState& state, const FluidOptions& options,
                            const Diagram& diagram) {
  const auto cells = options.surface == Surface::free
                         ? Result<CellsMesh>(freeSurfaceCells(state.sites, diagram))
                         : cellsMesh(sink, diagram);
  return cells.and_then(
      [&](const CellsMesh& mesh) { return writeMeshVtp(sink, mesh, fluidData(mesh, state)); });
}

Result<void> writeSeries(ByteSink& sink, const std::vector<SeriesStep>& steps) {
  std::string text(series_head);
  for (const SeriesStep& step : steps) {
    text += fmt::format("{}{}{}{}{}", before_time, step.time, before_file, step.file, after_file);
  }
  return sink.write(text + std::string(series_tail));
}

Result<std::vector<SeriesStep>> readSeries(const std::string& path) {
  VORPIPE_VAR(file, InputFile::open(path));
  VORPIPE_LET(text, readText(file));
  std::string_view left = text;
  const auto skip = [&](std::string_view expected) {
    const bool is_there = left.starts_with(expected);
    if (is_there) left.remove_prefix(expected.size());
    return is_there;
  };
  const auto until = [&](std::string_view end) {
    const std::string_view field = left.substr(0, left.find(end));
    left.remove_prefix(field.size());
    return std::string(field);
  };
  std::vector<SeriesStep> steps;
  bool is_good = skip(series_head);
  while (is_good && !skip(series_tail)) {
    is_good = skip(before_time);
    const auto time = parseNumber(until(before_file));
    is_good = is_good && time && skip(before_file);
    std::string name = until(after_file);
    is_good = is_good && skip(after_file);
    if (is_good) steps.push_back({*time, std::move(name)});
  }
  if (is_good && left.empty()) return steps;
  const auto lines = std::count(text.begin(), text.end() - static_cast<std::ptrdiff_t>(left.size()), '\n');
  return inputError(fmt::format("{}:{}: expected a line as in a series of `vorpipe fluid`", path, lines + 1));
}

}  // namespace vorpipe

#include <cmath>
#include <functional>

#include "domain/degrees.h"
#include "globe/sphere_map.h"
#include "vorpipe/globe.h"

namespace vorpipe {
namespace {

using namespace core;

/// Lines of places in degrees, as far as a map has them.
class GraticuleLines {
 public:
  explicit GraticuleLines(const SphereMap& map) : map_(map) {}

  /// A curve by its part, from 0 to 1.
  using Curve = std::function<Point(double part)>;

  void add(const Curve& placeAt) {
    constexpr int steps = 360;
    std::optional<Point> last;
    for (int k = 0; k <= steps; ++k) {
      const double part = static_cast<double>(k) / steps, before = static_cast<double>(k - 1) / steps;
      const auto at = onMap(placeAt(part));
      if (k > 0 && at.has_value() != last.has_value()) {
        lines_.points.push_back(last ? rim(placeAt, before, part) : rim(placeAt, part, before));
      }
      if (at) lines_.points.push_back(*at);
      if (!at && last) end();
      last = at;
    }
    end();
  }
  void addClosed(const std::vector<Point>& ring) {
    lines_.points.insert(lines_.points.end(), ring.begin(), ring.end());
    lines_.points.push_back(ring.front());
    end();
  }
  MapLines take() { return std::move(lines_); }

 private:
  [[nodiscard]] std::optional<Point> onMap(Point degrees) const {
    return map_.isFlat() ? map_.flat(degrees) : map_.at(directionOf(degrees));
  }
  /// Where a curve leaves the map, on its way from a part that the map has.
  [[nodiscard]] Point rim(const Curve& placeAt, double from, double to) const {
    constexpr int halvings = 30;
    for (int k = 0; k < halvings; ++k) {
      const double middle = (from + to) / 2;
      (onMap(placeAt(middle)) ? from : to) = middle;
    }
    return *onMap(placeAt(from));
  }
  void end() {
    const auto begin = lines_.ends.empty() ? 0 : lines_.ends.back();
    if (lines_.points.size() > begin) lines_.ends.push_back(lines_.points.size());
  }

  const SphereMap& map_;
  MapLines lines_;
};

}  // namespace

MapLines graticuleOnMap(const RenderOptions& options) {
  const SphereMap map(options);
  GraticuleLines lines(map);
  const double step = options.graticule;
  for (double k = std::ceil(-antimeridian / step); k * step < antimeridian; ++k) {
    const double longitude = k * step;
    // That of 180 degrees is the border of flat maps.
    if (map.isFlat() && longitude == -antimeridian) continue;
    lines.add([=](double part) { return Point{longitude, quarter_turn * (2 * part - 1)}; });
  }
  for (double k = std::floor(-quarter_turn / step) + 1; k * step < quarter_turn; ++k) {
    const double latitude = k * step;
    lines.add([=](double part) { return Point{antimeridian * (2 * part - 1), latitude}; });
  }
  const Box& box = map.box();
  const auto border = map.border();
  lines.addClosed(border.empty() ? std::vector<Point>{{box.xmin, box.ymin},
                                                      {box.xmax, box.ymin},
                                                      {box.xmax, box.ymax},
                                                      {box.xmin, box.ymax}}
                                 : border);
  return lines.take();
}

}  // namespace vorpipe

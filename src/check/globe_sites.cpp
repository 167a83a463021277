#include "check/globe_sites.h"

#include <nanoflann.hpp>

#include <algorithm>

namespace vorpipe::core::checks {
namespace {

/// A row of Equal Earth: y and half of its width, of a sphere of radius 1 (Savric, Patterson and Jenny 2018,
/// equations 8 to 10; the latitude is authalic, as in Snyder 1987, 3-11 and 3-12).
struct EqualEarthRow {
  double y, half_width;

  explicit EqualEarthRow(double degrees) {
    constexpr double e2 = 0.0066943799901413165;  // of WGS 84
    const double e = std::sqrt(e2);
    const auto q = [&](double sine) {
      return (1 - e2) * (sine / (1 - e2 * sine * sine) + std::atanh(e * sine) / e);
    };
    const double sine = std::clamp(q(std::sin(degrees / half_turn * pi)) / q(1), -1.0, 1.0);
    const double root = std::sqrt(3.0), t = std::asin(root / 2 * sine);
    constexpr std::array<double, 4> a{1.340264, -0.081106, 0.000893, 0.003796};
    y = a[3] * std::pow(t, 9) + a[2] * std::pow(t, 7) + a[1] * std::pow(t, 3) + a[0] * t;
    half_width = 2 * root * pi * std::cos(t) /
                 (3 * (9 * a[3] * std::pow(t, 8) + 7 * a[2] * std::pow(t, 6) + 3 * a[1] * t * t + a[0]));
  }
};

/// The latitude of a row of Equal Earth, by halving.
double latitudeOf(double y) {
  constexpr int steps = 60;
  double low = -half_turn / 2, high = half_turn / 2;
  for (int k = 0; k < steps; ++k) {
    const double middle = (low + high) / 2;
    (EqualEarthRow(middle).y < y ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace

struct GlobeSites::Tree {
  struct Vectors {
    const std::vector<SpaceVector>& at;
    [[nodiscard]] std::size_t kdtree_get_point_count() const { return at.size(); }
    [[nodiscard]] double kdtree_get_pt(std::uint32_t k, std::size_t axis) const { return at[k][axis]; }
    template <class Bounds>
    bool kdtree_get_bbox(Bounds&) const {
      return false;
    }
  };

  explicit Tree(const std::vector<SpaceVector>& at) : vectors{at}, tree(4, vectors, {16}) {}
  Vectors vectors;
  nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Vectors, double, std::uint32_t>,
                                      Vectors, 4, std::uint32_t>
      tree;
};

GlobeSites::GlobeSites(const Sites& sites) : has_weights_(!sites.weight.empty()) {
  std::vector<double> longer(sites.size());
  for (std::size_t i = 0; i < sites.size(); ++i) {
    SpaceVector at = toward({sites.x[i], sites.y[i]});
    if (has_weights_) {
      // Of a cap of angular radius r: 1 / cos(r).
      const double weight = sites.weight[i], radius = std::sqrt(std::abs(weight) * 4 * pi / earth_area);
      const double length = weight < 0 ? 1 / std::cosh(radius) : 1 / std::cos(radius);
      for (double& coordinate : at) coordinate *= length;
      longer[i] = length * length;
    }
    at_.push_back(at);
  }
  const double longest = has_weights_ ? *std::ranges::max_element(longer) : 0;
  for (std::size_t i = 0; i < sites.size(); ++i) at_[i][3] = std::sqrt(longest - longer[i]);
  tree_ = std::make_unique<Tree>(at_);
}

GlobeSites::~GlobeSites() = default;

std::uint32_t GlobeSites::nearestTo(const SpaceVector& place) const {
  std::uint32_t site = no_site;
  double squared = 0;
  nanoflann::KNNResultSet<double, std::uint32_t> found(1);
  found.init(&site, &squared);
  tree_->tree.findNeighbors(found, place.data(), {});
  return site;
}

double GlobeSites::beyond(std::size_t i, std::size_t j, const SpaceVector& place) const {
  const SpaceVector &a = at_[i], &b = at_[j];
  const double of_a = chordOf(place, a), of_b = chordOf(place, b);
  const double apart = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  return apart == 0 ? 0 : (of_a - of_b) * (of_a + of_b) / 2 / apart;
}

GlobeOutline::GlobeOutline(const Outline& outline) : by_degree_(2 * static_cast<std::size_t>(half_turn)) {
  for (std::size_t r = 0; r + 1 < outline.ring_offsets.size(); ++r) {
    const auto begin = outline.ring_offsets[r], end = outline.ring_offsets[r + 1];
    addRing(std::span(outline.points).subspan(begin, end - begin));
  }
}

void GlobeOutline::addRing(std::span<const Point> ring) {
  double turns = 0, height = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point from = ring[k];
    Point to = ring[k + 1 < ring.size() ? k + 1 : 0];
    // The longitude of a pole is any.
    const bool to_pole = std::abs(to.y) == half_turn / 2, from_pole = std::abs(from.y) == half_turn / 2;
    const double way = to_pole || from_pole ? 0 : std::remainder(to.x - from.x, 2 * half_turn);
    to.x = from.x + way;
    turns += way;
    height += std::sin(from.y / half_turn * pi);
    const double west = std::floor(std::min(from.x, to.x)) - 1, east = std::floor(std::max(from.x, to.x)) + 1;
    for (double column = west; column <= east; ++column) {
      const double first = column - 2 * half_turn * std::floor(column / (2 * half_turn));
      by_degree_[static_cast<std::size_t>(first)].push_back({from, to});
    }
  }
  // A ring around a pole has that in whose half it lies.
  if (std::abs(turns) > half_turn && height > 0) has_pole_ = !has_pole_;
}

GlobeOutline::Side GlobeOutline::at(const SpaceVector& place) const {
  constexpr double slack = 1e-3;  // degrees
  const double longitude = std::atan2(place[1], place[0]) / pi * half_turn;
  const double latitude = std::atan2(place[2], std::hypot(place[0], place[1])) / pi * half_turn;
  const double column = std::floor(longitude) + (longitude < 0 ? 2 * half_turn : 0);
  const double shrinks = std::cos(latitude / half_turn * pi);
  bool is_inside = has_pole_;
  for (const auto& [from, to] : by_degree_[static_cast<std::size_t>(column) % by_degree_.size()]) {
    const double turn = 2 * half_turn * std::round((from.x - longitude) / (2 * half_turn));
    const Point a{from.x - turn - longitude, from.y - latitude}, b{to.x - turn - longitude, to.y - latitude};
    const Point way{(b.x - a.x) * shrinks, b.y - a.y};
    const double squared = way.x * way.x + way.y * way.y;
    const double part =
        squared > 0 ? std::clamp(-(a.x * shrinks * way.x + a.y * way.y) / squared, 0.0, 1.0) : 0;
    if (std::hypot(a.x * shrinks + part * way.x, a.y + part * way.y) < slack) return Side::edge;
    if ((a.x > 0) != (b.x > 0) && a.y - a.x / (b.x - a.x) * (b.y - a.y) > 0) is_inside = !is_inside;
  }
  return is_inside ? Side::inside : Side::outside;
}

GlobePixels::GlobePixels(const RenderOptions& options) : options_(options), frame_(shownFrame(options)) {
  const EqualEarthRow equator(0), pole(half_turn / 2);
  if (options.view) {
    constexpr double meters = 1000;
    const double radius = meters * std::sqrt(earth_area / (4 * pi));
    const bool equal_earth = options.map == GlobeMap::equal_earth;
    const Point half = options.view_from ? Point{1, 1}
                       : equal_earth     ? Point{radius * equator.half_width, radius * pole.y}
                                         : Point{half_turn, half_turn / 2};
    const Box& view = *options.view;
    shown_ = {view.xmin / half.x, view.ymin / half.y, view.xmax / half.x, view.ymax / half.y};
  }
  if (options.view_from) return;
  for (int row = 0; row < frame_.height; ++row) {
    const double up = partOf(row, 0).y;
    const bool equal_earth = options.map == GlobeMap::equal_earth;
    latitude_.push_back(equal_earth ? latitudeOf(up * pole.y) : up * half_turn / 2);
    width_.push_back(equal_earth ? EqualEarthRow(latitude_.back()).half_width / equator.half_width : 1);
  }
}

Point GlobePixels::partOf(int row, int column) const {
  return {shown_.xmin + (column + 0.5) / frame_.width * (shown_.xmax - shown_.xmin),
          shown_.ymax - (row + 0.5) / frame_.height * (shown_.ymax - shown_.ymin)};
}

double GlobePixels::reachOf(int row, int column) const {
  const Point part = partOf(row, column);
  if (options_.view_from) return std::hypot(part.x, part.y);
  return std::max(std::abs(part.x) / width_[static_cast<std::size_t>(row)], std::abs(part.y));
}

bool GlobePixels::isOnBorder(int row, int column) const {
  constexpr double rounding = 1e-9;
  return std::abs(reachOf(row, column) - 1) < rounding;
}

std::optional<SpaceVector> GlobePixels::at(int row, int column) const {
  if (reachOf(row, column) > 1) return std::nullopt;
  const Point part = partOf(row, column);
  if (!options_.view_from) {
    const auto r = static_cast<std::size_t>(row);
    return toward({half_turn * part.x / width_[r], latitude_[r]});
  }
  // Snyder 1987, 20-14 to 20-18.
  const double sine = std::hypot(part.x, part.y), cosine = std::sqrt(std::max(0.0, 1 - sine * sine));
  const double from = options_.view_from->y / half_turn * pi;
  if (sine == 0) return toward(*options_.view_from);
  const double latitude =
      std::asin(std::clamp(cosine * std::sin(from) + part.y * sine * std::cos(from) / sine, -1.0, 1.0));
  const double east =
      std::atan2(part.x * sine, sine * std::cos(from) * cosine - part.y * std::sin(from) * sine);
  return toward({options_.view_from->x + east / pi * half_turn, latitude / pi * half_turn});
}

double GlobePixels::pixelsOfRadian() const {
  const double half_map = frame_.width / (shown_.xmax - shown_.xmin);
  return options_.view_from ? half_map : half_map / pi;
}

}  // namespace vorpipe::core::checks

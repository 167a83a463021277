/// Cells in space by integers alone: what predicates, rows and diagrams of src/space are judged by. It takes
/// some 2 ms a site for 60 sites, and quadratically more for more.
#pragma once

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "space/label.h"
#include "space/rows.h"
#include "vorpipe/space.h"

namespace vorpipe::test {

using space::isWallLabel;
using space::Label;
using Triple = std::array<Label, 3>;
using Integer = boost::multiprecision::cpp_int;
/// Numbers with a relative error of 2^-800.
using Wide = boost::multiprecision::number<
    boost::multiprecision::cpp_bin_float<800, boost::multiprecision::digit_base_2>,
    boost::multiprecision::et_off>;

template <class T>
using Vector3 = std::array<T, 3>;
template <class T>
T dot(const Vector3<T>& a, const Vector3<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class T>
Vector3<T> cross(const Vector3<T>& a, const Vector3<T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class T>
T det(const Vector3<T>& a, const Vector3<T>& b, const Vector3<T>& c) {
  return dot(a, cross(b, c));
}
template <class T>
Vector3<T> operator-(const Vector3<T>& a, const Vector3<T>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// The sites and the box, as integers of one quantum, and weights of its square.
class ExactSpace {
 public:
  ExactSpace(std::span<const Point3> sites, const Box3& box, std::span<const double> weights = {})
      : rank_(sites.size()) {
    int least = std::numeric_limits<int>::max();
    const auto see = [&](double value) {
      int exponent = 0;
      if (value != 0) {
        std::frexp(value, &exponent);
        least = std::min(least, exponent - 53);
      }
    };
    const double sides[6] = {box.xmin, box.xmax, box.ymin, box.ymax, box.zmin, box.zmax};
    for (const auto& p : sites) {
      for (const double value : {p.x, p.y, p.z}) see(value);
    }
    for (const double side : sides) see(side);
    for (const double weight : weights) {
      int exponent = 0;
      if (std::frexp(weight, &exponent) != 0) least = std::min(least, (exponent - 53) / 2 - 1);
    }
    quantum_ = least;
    for (const double weight : weights) weight_.push_back(integer(weight, 2 * quantum_));
    for (const auto& p : sites) at_.push_back({integer(p.x), integer(p.y), integer(p.z)});
    for (int w = 0; w < space::walls; ++w) offset_[static_cast<std::size_t>(w)] = integer(sides[w]);
    std::vector<std::size_t> order(sites.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return sites[a] < sites[b]; });
    for (std::size_t r = 0; r < order.size(); ++r) rank_[order[r]] = static_cast<int>(r);
  }

  [[nodiscard]] std::size_t size() const { return at_.size(); }

  /// Of a site its place less that of site i, of a wall its outward normal.
  [[nodiscard]] Vector3<Integer> way(Label i, Label j) const {
    if (!isWallLabel(j)) return at_[index(j)] - at_[index(i)];
    Vector3<Integer> normal{0, 0, 0};
    const int wall = space::wallOf(j);
    normal[static_cast<std::size_t>(space::axisOf(wall))] = space::isUpper(wall) ? 1 : -1;
    return normal;
  }

  /// Twice its plane's offset: p . way = reach / 2 on the face of j. Of a site its squared distance, and what
  /// it is lighter by.
  [[nodiscard]] Integer reach(Label i, Label j) const {
    const auto d = way(i, j);
    if (!isWallLabel(j) && weight_.empty()) return dot(d, d);
    if (!isWallLabel(j)) return dot(d, d) + weight_[index(i)] - weight_[index(j)];
    const int wall = space::wallOf(j);
    const auto axis = static_cast<std::size_t>(space::axisOf(wall));
    const Integer far = offset_[static_cast<std::size_t>(wall)] - at_[index(i)][axis];
    return 2 * (space::isUpper(wall) ? far : Integer(-far));
  }

  /// Its sign is that of orientation() of src/space/predicates.h.
  [[nodiscard]] Integer volume(Label i, Label j, Label k, Label l) const {
    return det(way(i, j), way(i, k), way(i, l));
  }
  [[nodiscard]] int orientation(Label i, Label j, Label k, Label l) const {
    return volume(i, j, k, l).sign();
  }

  /// The power of m less that of i at the vertex (i; t), times the vertex' volume(), in quanta. For a wall:
  /// twice the way from the vertex to the wall.
  [[nodiscard]] Integer power(Label i, const Triple& t, Label m) const {
    const auto minors = minorsOf(i, t, m);
    Integer sum = 0;
    const Label labels[4] = {t[0], t[1], t[2], m};
    for (std::size_t e = 0; e < 4; ++e) sum += minors[e] * reach(i, labels[e]);
    return sum;
  }

  /// The sign of power(); where that is 0, and `heights`, ties are broken as predicates.h says.
  [[nodiscard]] int side(Label i, const Triple& t, Label m, bool heights = true) const {
    if (const int sign = power(i, t, m).sign(); sign != 0 || !heights) return sign;
    const auto minors = minorsOf(i, t, m);
    const Label labels[4] = {t[0], t[1], t[2], m};
    std::array<Label, 5> order{t[0], t[1], t[2], m, i};
    std::sort(order.begin(), order.end(), [&](Label a, Label b) { return rank(a) < rank(b); });
    for (const Label x : order) {
      Integer factor = 0;
      for (std::size_t e = 0; e < 4; ++e) {
        if (x == i && !isWallLabel(labels[e])) factor += minors[e];
        if (x == labels[e]) factor = -minors[e];
      }
      if (factor != 0) return factor.sign();
    }
    return 0;
  }

  [[nodiscard]] bool cuts(Label i, Label j, Label k, Label l, Label m) const {
    return side(i, {j, k, l}, m) * orientation(i, j, k, l) < 0;
  }

  /// The vertices of the cell of i, each turning counter-clockwise; none if it has no cell.
  [[nodiscard]] std::vector<Triple> cell(Label i) const {
    std::vector<Triple> vertices;
    for (const Label x : {-1, -2}) {
      for (const Label y : {-3, -4}) {
        for (const Label z : {-5, -6}) {
          const bool turns = det(way(i, x), way(i, y), way(i, z)) > 0;
          vertices.push_back(turns ? Triple{x, y, z} : Triple{y, x, z});
        }
      }
    }
    std::vector<std::pair<Integer, Label>> others;
    for (std::size_t j = 0; j < size(); ++j) {
      const auto label = static_cast<Label>(j);
      if (label != i) others.emplace_back(reach(i, label), label);
    }
    std::sort(others.begin(), others.end());
    for (const auto& [far, m] : others) {
      if (!cut(i, m, vertices)) return {};
    }
    return vertices;
  }

  /// The place of a vertex relative to site i, in the unit of the sites.
  [[nodiscard]] Vector3<Wide> place(Label i, Label j, Label k, Label l) const {
    const auto a = way(i, j), b = way(i, k), c = way(i, l);
    const auto bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
    const Wide unit = ldexp(Wide(0.5), quantum_) / Wide(dot(a, bc));
    Vector3<Wide> p;
    for (std::size_t e = 0; e < 3; ++e) {
      const Integer sum = reach(i, j) * bc[e] + reach(i, k) * ca[e] + reach(i, l) * ab[e];
      p[e] = Wide(sum) * unit;
    }
    return p;
  }

  /// The square of the distance of two sites.
  [[nodiscard]] Wide squaredDistance(Label i, Label j) const {
    const auto d = way(i, j);
    return ldexp(Wide(dot(d, d)), 2 * quantum_);
  }

  /// The sites that are cospherical, or on a wall, with a vertex: all labels m with power 0.
  [[nodiscard]] std::vector<Label> labelsAt(Label i, const Triple& t) const {
    std::vector<Label> labels;
    for (Label m = -space::walls; m < static_cast<Label>(size()); ++m) {
      const bool own = m == i || std::find(t.begin(), t.end(), m) != t.end();
      if (own || power(i, t, m) == 0) labels.push_back(m);
    }
    return labels;
  }

 private:
  static std::size_t index(Label site) { return static_cast<std::size_t>(site); }

  [[nodiscard]] Integer integer(double value) const { return integer(value, quantum_); }
  static Integer integer(double value, int quantum) {
    int exponent = 0;
    const double mantissa = std::frexp(value, &exponent);
    Integer result = static_cast<std::int64_t>(std::ldexp(mantissa, 53));
    if (value != 0) result <<= exponent - 53 - quantum;
    return result;
  }

  [[nodiscard]] int rank(Label label) const {
    return isWallLabel(label) ? space::wallOf(label) - space::walls : rank_[index(label)];
  }

  [[nodiscard]] std::array<Integer, 4> minorsOf(Label i, const Triple& t, Label m) const {
    const auto a = way(i, t[0]), b = way(i, t[1]), c = way(i, t[2]), d = way(i, m);
    return {-det(b, c, d), det(a, c, d), -det(a, b, d), det(a, b, c)};
  }

  /// Returns whether anything of the cell is left.
  bool cut(Label i, Label m, std::vector<Triple>& vertices) const {
    std::vector<Triple> kept;
    std::map<std::pair<Label, Label>, std::size_t> owner;
    std::vector<bool> removed;
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      const auto& t = vertices[v];
      removed.push_back(side(i, t, m) < 0);
      if (!removed[v]) kept.push_back(t);
      for (std::size_t e = 0; e < 3; ++e) owner[{t[e], t[(e + 1) % 3]}] = v;
    }
    if (kept.size() == vertices.size()) return true;
    if (kept.empty()) return false;
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      if (!removed[v]) continue;
      for (std::size_t e = 0; e < 3; ++e) {
        const Label a = vertices[v][e], b = vertices[v][(e + 1) % 3];
        if (!removed[owner.at({b, a})]) kept.push_back({a, b, m});
      }
    }
    vertices = std::move(kept);
    return true;
  }

  std::vector<Vector3<Integer>> at_;
  std::array<Integer, 6> offset_;
  std::vector<Integer> weight_;  ///< by site, or empty
  std::vector<int> rank_;
  int quantum_ = 0;
};

/// A cell by its faces: to each neighbor the ring of the neighbors across its edges, counter-clockwise seen
/// from outside.
using LabelRow = std::map<Label, std::vector<Label>>;
/// By site; that of a site without a cell is empty.
using LabelRows = std::vector<LabelRow>;

/// The row of a cell with these vertices; nothing if they do not close.
inline std::optional<LabelRow> rowOf(std::span<const Triple> vertices) {
  std::map<Label, std::map<Label, Label>> next;
  for (const auto& t : vertices) {
    for (std::size_t e = 0; e < 3; ++e) {
      if (!next[t[e]].emplace(t[(e + 1) % 3], t[(e + 2) % 3]).second) return std::nullopt;
    }
  }
  LabelRow row;
  for (const auto& [face, after] : next) {
    auto& ring = row[face];
    Label at = after.begin()->first;
    do {
      ring.push_back(at);
      const auto found = after.find(at);
      if (found == after.end() || ring.size() > after.size()) return std::nullopt;
      at = found->second;
    } while (at != ring.front());
    if (ring.size() != after.size()) return std::nullopt;
  }
  return row;
}

/// The cells of all sites.
inline LabelRows rowsOf(const ExactSpace& exact) {
  LabelRows rows;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    rows.push_back(rowOf(exact.cell(static_cast<Label>(i))).value());
  }
  return rows;
}

/// The conditions of the certificate that rows break: "C1" to "C4" of the design, by integers. C5, that the
/// sites without rows have no cell, is tested by ExactSpace::cell().
inline std::set<std::string> brokenConditions(const ExactSpace& exact, const LabelRows& rows) {
  std::set<std::string> broken;
  const auto follows = [](const LabelRow& row, Label face, Label before, Label after) {
    const auto found = row.find(face);
    if (found == row.end()) return false;
    const auto& ring = found->second;
    const auto at = std::find(ring.begin(), ring.end(), before);
    if (at == ring.end()) return false;
    return (at + 1 == ring.end() ? ring.front() : at[1]) == after;
  };
  std::size_t corners = 0;
  for (std::size_t s = 0; s < rows.size(); ++s) {
    const auto& row = rows[s];
    const auto i = static_cast<Label>(s);
    if (row.empty()) continue;
    if (row.size() < 4) broken.insert("C1");
    for (const auto& [j, ring] : row) {
      const std::set<Label> different(ring.begin(), ring.end());
      if (ring.size() < 3 || different.size() != ring.size() || j == i) broken.insert("C1");
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Label a = ring[k], b = ring[(k + 1) % ring.size()];
        if (!follows(row, a, b, j) || !follows(row, b, j, a)) broken.insert("C1");
      }
      if (isWallLabel(j)) continue;
      const auto other = rows[static_cast<std::size_t>(j)].find(i);
      if (other == rows[static_cast<std::size_t>(j)].end() || other->second.size() != ring.size()) {
        broken.insert("C1");
        continue;
      }
      std::vector<Label> reverse(other->second.rbegin(), other->second.rend());
      std::rotate(reverse.begin(), std::find(reverse.begin(), reverse.end(), ring[0]), reverse.end());
      if (reverse != ring) broken.insert("C1");
    }
  }
  if (!broken.empty()) return broken;
  for (std::size_t s = 0; s < rows.size(); ++s) {
    const auto i = static_cast<Label>(s);
    for (const auto& [j, ring] : rows[s]) {
      const std::size_t n = ring.size();
      for (std::size_t k = 0; k < n; ++k) {
        const Label a = ring[k], b = ring[(k + 1) % n];
        if (exact.orientation(i, j, a, b) <= 0) broken.insert("C2");
        corners += j == -1 && ((a == -3 && b == -5) || (a == -5 && b == -3));
        // Along the edge of b from the vertex (a, b) to (b, c).
        const Label c = ring[(k + 2) % n];
        if (isWallLabel(a) && isWallLabel(c) &&
            space::axisOf(space::wallOf(a)) == space::axisOf(space::wallOf(c)))
          continue;
        if (exact.side(i, {j, a, b}, c) * exact.orientation(i, j, a, b) <= 0) broken.insert("C3");
      }
    }
  }
  if (corners != 1) broken.insert("C4");
  return broken;
}

/// Rows of src/space, with the memory that they lie in.
class StoredRows {
 public:
  explicit StoredRows(const LabelRows& rows, std::span<const std::uint32_t> input = {})
      : rows_(rows.size(), input) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (!rows[i].empty()) store(rows[i], i);
    }
  }
  [[nodiscard]] const space::Rows& rows() const { return rows_; }
  [[nodiscard]] space::Rows& rows() { return rows_; }

 private:
  void store(const LabelRow& row, std::size_t i) {
    std::vector<Label> neighbors;
    for (const auto& [label, ring] : row) neighbors.push_back(label);
    const auto faceOf = [&](Label label) {
      return static_cast<std::uint32_t>(std::lower_bound(neighbors.begin(), neighbors.end(), label) -
                                        neighbors.begin());
    };
    std::vector<std::array<std::uint32_t, 3>> vertices;
    for (const auto& [label, ring] : row) {
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Label a = ring[k], b = ring[(k + 1) % ring.size()];
        if (label < a && label < b) vertices.push_back({faceOf(label), faceOf(a), faceOf(b)});
      }
    }
    if (!rows_.set(i, neighbors, vertices, arena_)) throw std::logic_error("a row does not close");
  }

  space::RowArena arena_;
  space::Rows rows_;
};

/// Volume, and area by face, of a cell with its vertices at exact places.
struct ExactMeasures {
  Wide volume = 0, surface = 0;
  Vector3<Wide> centroid{};       ///< relative to the site
  std::array<Wide, 6> moments{};  ///< about the centroid: xx, yy, zz, yz, xz, xy
  std::map<Label, Wide> area;
};

inline ExactMeasures exactMeasures(const ExactSpace& exact, Label i, const LabelRow& row) {
  ExactMeasures m;
  Vector3<Wide> first{};
  constexpr std::size_t pair[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
  for (const auto& [j, ring] : row) {
    std::vector<Vector3<Wide>> p;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      p.push_back(exact.place(i, j, ring[k], ring[(k + 1) % ring.size()]));
    }
    Vector3<Wide> sum{};
    for (std::size_t k = 2; k < p.size(); ++k) {
      const auto c = cross(p[k - 1] - p[0], p[k] - p[0]);
      const Wide six = det(p[0], p[k - 1], p[k]);
      Vector3<Wide> s{};
      for (std::size_t e = 0; e < 3; ++e) {
        sum[e] += c[e];
        s[e] = p[0][e] + p[k - 1][e] + p[k][e];
        first[e] += six * s[e];
      }
      m.volume += six;
      for (std::size_t e = 0; e < 6; ++e) {
        const auto [a, b] = std::pair(pair[e][0], pair[e][1]);
        m.moments[e] +=
            six * (p[0][a] * p[0][b] + p[k - 1][a] * p[k - 1][b] + p[k][a] * p[k][b] + s[a] * s[b]);
      }
    }
    m.area[j] = sqrt(dot(sum, sum)) / 2;
    m.surface += m.area[j];
  }
  m.volume /= 6;
  for (std::size_t e = 0; e < 3; ++e) m.centroid[e] = first[e] / (24 * m.volume);
  for (std::size_t e = 0; e < 6; ++e) {
    m.moments[e] = m.moments[e] / 120 - m.volume * m.centroid[pair[e][0]] * m.centroid[pair[e][1]];
  }
  return m;
}

}  // namespace vorpipe::test

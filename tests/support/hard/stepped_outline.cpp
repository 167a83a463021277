#include "support/hard/stepped_outline.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace vorpipe::test {
namespace {

/// Which fields between the lines are inside; those beyond the lines are not.
class Fields {
 public:
  Fields(std::size_t columns, std::size_t rows) : columns_(columns), rows_(rows), inside_(columns * rows) {}
  [[nodiscard]] std::size_t columns() const { return columns_; }
  [[nodiscard]] std::size_t rows() const { return rows_; }
  /// Fields are counted from 1, so that there are some beyond.
  [[nodiscard]] bool at(std::size_t column, std::size_t row) const {
    return column > 0 && row > 0 && column <= columns_ && row <= rows_ &&
           inside_[(row - 1) * columns_ + column - 1] != 0;
  }
  void set(std::size_t column, std::size_t row, bool inside) {
    inside_[(row - 1) * columns_ + column - 1] = inside ? 1 : 0;
  }

  void setBox(bool inside, Random& random) {
    const auto range = [&](std::size_t count) {
      const auto a = 1 + random.below(count), b = 1 + random.below(count);
      return std::minmax({a, b});
    };
    const auto [left, right] = range(columns_);
    const auto [low, high] = range(rows_);
    for (auto row = low; row <= high; ++row) {
      for (auto column = left; column <= right; ++column) set(column, row, inside);
    }
  }

  /// Fills fields until no two meet in a corner alone.
  void joinCorners() {
    bool changed = true;
    while (changed) {
      changed = false;
      for (std::size_t row = 1; row < rows_; ++row) {
        for (std::size_t column = 1; column < columns_; ++column) {
          const bool one = at(column, row), beside = at(column + 1, row);
          if (one == beside || one != at(column + 1, row + 1) || beside != at(column, row + 1)) continue;
          set(column, row, true);
          set(column + 1, row, true);
          changed = true;
        }
      }
    }
  }

 private:
  std::size_t columns_, rows_;
  std::vector<std::uint8_t> inside_;
};

/// A point of the lattice of lines, and one of the four ways from it, counter-clockwise from that to the
/// right.
struct Step {
  std::size_t x, y, way;
  bool operator==(const Step&) const = default;
};

/// Whether a step has an inside field to its left, and none to its right.
bool isSide(const Fields& fields, const Step& s) {
  // The fields around a point, counter-clockwise from that on the upper right.
  const auto around = [&](std::size_t k) {
    return fields.at(s.x + (k % 4 == 0 || k % 4 == 3 ? 1 : 0), s.y + (k % 4 < 2 ? 1 : 0));
  };
  return around(s.way) && !around(s.way + 3);
}

Step after(const Fields& fields, Step s) {
  s.x += s.way == 0 ? 1 : 0;
  s.x -= s.way == 2 ? 1 : 0;
  s.y += s.way == 1 ? 1 : 0;
  s.y -= s.way == 3 ? 1 : 0;
  s.way = (s.way + 3) % 4;
  while (!isSide(fields, s)) s.way = (s.way + 1) % 4;
  return s;
}

struct Traced {
  std::vector<Step> corners;
  bool is_hole;
};

/// The ring that has the step `begin`; merged: without corners on straight lines.
Traced traced(const Fields& fields, const Step& begin, std::vector<std::uint8_t>& seen, bool merged) {
  Traced ring{{}, false};
  int turns = 0;
  Step s = begin;
  do {
    seen[(s.y * (fields.columns() + 1) + s.x) * 4 + s.way] = 1;
    const Step next = after(fields, s);
    turns += next.way == (s.way + 1) % 4 ? 1 : (next.way == (s.way + 3) % 4 ? -1 : 0);
    if (next.way != s.way || !merged) ring.corners.push_back(next);
    s = next;
  } while (!(s == begin));
  ring.is_hole = turns < 0;
  return ring;
}

/// For each field the number of the part that it is in, from 1; 0 outside.
std::vector<std::size_t> partsOf(const Fields& fields) {
  std::vector<std::size_t> part(fields.columns() * fields.rows());
  std::size_t parts = 0;
  std::vector<std::pair<std::size_t, std::size_t>> open;
  const auto take = [&](std::size_t column, std::size_t row, std::size_t number) {
    if (!fields.at(column, row)) return;
    auto& of = part[(row - 1) * fields.columns() + column - 1];
    if (of != 0) return;
    of = number;
    open.emplace_back(column, row);
  };
  for (std::size_t row = 1; row <= fields.rows(); ++row) {
    for (std::size_t column = 1; column <= fields.columns(); ++column) {
      take(column, row, parts + 1);
      if (!open.empty()) ++parts;
      while (!open.empty()) {
        const auto [x, y] = open.back();
        open.pop_back();
        take(x + 1, y, parts);
        take(x - 1, y, parts);
        take(x, y + 1, parts);
        take(x, y - 1, parts);
      }
    }
  }
  return part;
}

/// The part on the left of a step.
std::size_t partBeside(const Fields& fields, const std::vector<std::size_t>& parts, const Step& s) {
  const std::size_t column = s.x + (s.way == 0 || s.way == 3 ? 1 : 0), row = s.y + (s.way < 2 ? 1 : 0);
  return parts[(row - 1) * fields.columns() + column - 1];
}

}  // namespace

Outline steppedOutline(std::span<const double> xs, std::span<const double> ys, Random& random) {
  Fields fields(xs.size() - 1, ys.size() - 1);
  for (auto boxes = 1 + random.below(6); boxes > 0; --boxes) fields.setBox(true, random);
  const auto taken = fields;
  for (auto boxes = random.below(6); boxes > 0; --boxes) fields.setBox(false, random);
  const auto parts_left = partsOf(fields);
  if (*std::ranges::max_element(parts_left) == 0) fields = taken;
  fields.joinCorners();
  const auto parts = partsOf(fields);
  const bool merged = random.below(2) == 0;
  // Outer rings before holes, in each part.
  std::vector<std::pair<std::pair<std::size_t, bool>, std::vector<Step>>> rings;
  std::vector<std::uint8_t> seen(xs.size() * ys.size() * 4);
  for (std::size_t y = 0; y < ys.size(); ++y) {
    for (std::size_t x = 0; x < xs.size(); ++x) {
      for (std::size_t way = 0; way < 4; ++way) {
        const Step begin{x, y, way};
        if (seen[(y * xs.size() + x) * 4 + way] != 0 || !isSide(fields, begin)) continue;
        auto ring = traced(fields, begin, seen, merged);
        rings.emplace_back(std::pair(partBeside(fields, parts, begin), ring.is_hole),
                           std::move(ring.corners));
      }
    }
  }
  std::ranges::stable_sort(rings, {}, [](const auto& ring) { return ring.first; });
  Outline outline{{}, {0}, {0}};
  for (const auto& [key, corners] : rings) {
    if (!key.second && outline.ring_offsets.size() > 1)
      outline.polygon_offsets.push_back(outline.ring_offsets.size() - 1);
    for (const Step& corner : corners) outline.points.push_back({xs[corner.x], ys[corner.y]});
    outline.ring_offsets.push_back(outline.points.size());
  }
  outline.polygon_offsets.push_back(outline.ring_offsets.size() - 1);
  return outline;
}

}  // namespace vorpipe::test

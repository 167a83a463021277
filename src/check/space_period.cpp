#include "check/space_period.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "check/space.h"

namespace vorpipe::core::checks {
namespace {

SpacePeriod::Step opposite(const SpacePeriod::Step& a) {
  return {-1.0 * a.way, {-a.shift[0], -a.shift[1], -a.shift[2]}};
}

SpacePeriod::Step sumOf(const SpacePeriod::Step& a, const SpacePeriod::Step& b) {
  return {a.way + b.way, {a.shift[0] + b.shift[0], a.shift[1] + b.shift[1], a.shift[2] + b.shift[2]}};
}

}  // namespace

SpacePeriod::SpacePeriod(const Cells3Options& options, double scale)
    : is_lattice_(options.lattice.has_value()), repeats_(options.periodic) {
  if (is_lattice_) {
    const auto& [a, b, c] = *options.lattice;
    vector_ = {scale * a, scale * b, scale * c};
    takeObtuse();
  } else {
    const Box3& box = options.domain;
    vector_ = {Point3{(box.xmax - box.xmin) * scale, 0, 0}, Point3{0, (box.ymax - box.ymin) * scale, 0},
               Point3{0, 0, (box.zmax - box.zmin) * scale}};
    for (std::size_t a = 0; a < 3; ++a) {
      if (!repeats_[a]) continue;
      Step step{vector_[a], {}};
      step.shift[a] = 1;
      basis_.push_back(step);
      relevant_.push_back(step);
      relevant_.push_back(opposite(step));
    }
  }
  takeDual();
}

/// Four vectors whose sum is 0, none two of which have an acute angle: so their sums, and no other vectors,
/// are normals of the faces of the lattice's own cell (Selling 1874; Conway and Sloane 1992).
void SpacePeriod::takeObtuse() {
  std::array<Step, 4> four{Step{vector_[0], {1, 0, 0}}, {vector_[1], {0, 1, 0}}, {vector_[2], {0, 0, 1}}, {}};
  four[3] = opposite(sumOf(sumOf(four[0], four[1]), four[2]));
  constexpr int most = 100'000;
  for (int turn = 0; turn < most; ++turn) {
    std::size_t i = 0, j = 0;
    double worst = 1e-13;
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = a + 1; b < 4; ++b) {
        const double cosine = dot(four[a].way, four[b].way) / (length(four[a].way) * length(four[b].way));
        if (cosine > worst) std::tie(worst, i, j) = std::tuple(cosine, a, b);
      }
    }
    if (i == j) break;
    for (std::size_t k = 0; k < 4; ++k) {
      if (k != i && k != j) four[k] = sumOf(four[k], four[i]);
    }
    four[i] = opposite(four[i]);
  }
  std::ranges::sort(four, {}, [](const Step& step) { return length(step.way); });
  basis_.assign(four.begin(), four.begin() + 3);
  for (unsigned set = 1; set < 15; ++set) {
    Step sum{};
    for (unsigned k = 0; k < 4; ++k) {
      if ((set >> k & 1U) != 0) sum = sumOf(sum, four[k]);
    }
    relevant_.push_back(sum);
  }
}

void SpacePeriod::takeDual() {
  if (!is_lattice_) {
    for (std::size_t r = 0; r < basis_.size(); ++r)
      dual_[r] = (1 / dot(basis_[r].way, basis_[r].way)) * basis_[r].way;
    return;
  }
  const Point3 &a = basis_[0].way, &b = basis_[1].way, &c = basis_[2].way;
  const double volume = dot(a, cross(b, c));
  dual_ = {(1 / volume) * cross(b, c), (1 / volume) * cross(c, a), (1 / volume) * cross(a, b)};
}

Point3 SpacePeriod::of(const Shift3& shift) const {
  return placeOf(
      {static_cast<double>(shift[0]), static_cast<double>(shift[1]), static_cast<double>(shift[2])});
}

Point3 SpacePeriod::placeOf(const std::array<double, 3>& parts) const {
  Point3 sum{0, 0, 0};
  for (std::size_t k = 0; k < 3; ++k) sum = sum + parts[k] * vector_[k];
  return sum;
}

double SpacePeriod::part(std::size_t r, const Point3& p) const { return dot(dual_[r], p); }
double SpacePeriod::partOfLength(std::size_t r) const { return length(dual_[r]); }

Shift3 SpacePeriod::stepsTo(const Point3& p) const {
  Shift3 steps{};
  Point3 rest = p;
  for (int again = 0; again < 2; ++again) {
    for (std::size_t r = 0; r < basis_.size(); ++r)
      steps[r] += static_cast<std::int32_t>(std::floor(part(r, rest) + 0.5));
    rest = less(p, steps);
  }
  return steps;
}

Point3 SpacePeriod::less(const Point3& p, const Shift3& steps) const {
  using Long = long double;
  Long x = p.x, y = p.y, z = p.z;
  for (std::size_t r = 0; r < basis_.size(); ++r) {
    x -= static_cast<Long>(steps[r]) * static_cast<Long>(basis_[r].way.x);
    y -= static_cast<Long>(steps[r]) * static_cast<Long>(basis_[r].way.y);
    z -= static_cast<Long>(steps[r]) * static_cast<Long>(basis_[r].way.z);
  }
  return {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
}

Shift3 SpacePeriod::toOrigin(const Point3& p) const {
  Step moved{p, {}};
  const Shift3 steps = stepsTo(p);
  for (std::size_t r = 0; r < basis_.size(); ++r) {
    for (std::size_t k = 0; k < 3; ++k) moved.shift[k] -= steps[r] * basis_[r].shift[k];
  }
  moved.way = less(p, steps);
  constexpr double shorter = 1 - 1e-12;
  for (bool nearer = true; nearer;) {
    nearer = false;
    for (const Step& step : relevant_) {
      const Step to = sumOf(moved, step);
      if (!(dot(to.way, to.way) < shorter * dot(moved.way, moved.way))) continue;
      moved = to;
      nearer = true;
    }
  }
  return moved.shift;
}

double SpacePeriod::volume() const { return std::abs(dot(vector_[0], cross(vector_[1], vector_[2]))); }

double SpacePeriod::shortest() const {
  double least = std::numeric_limits<double>::infinity();
  for (const Step& step : relevant_) least = std::min(least, length(step.way));
  return least;
}

bool SpacePeriod::isCoarse() const {
  const auto is = [](double number) { return std::rint(number * 0x1p20) == number * 0x1p20; };
  return std::ranges::all_of(vector_, [&](const Point3& v) { return is(v.x) && is(v.y) && is(v.z); });
}

}  // namespace vorpipe::core::checks

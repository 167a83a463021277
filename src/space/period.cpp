#include "space/period.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "base/refusal.h"
#include "space/fixed_integer.h"

namespace vorpipe::space {
namespace {

double dot(const Vector3& a, const Vector3& b) { return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]; }

Vector3 crossed(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// By vector: what a point is multiplied by for its component along it.
std::array<Vector3, 3> dualOf(const std::array<Vector3, 3>& v) {
  const double volume = dot(v[0], crossed(v[1], v[2]));
  std::array<Vector3, 3> dual{crossed(v[1], v[2]), crossed(v[2], v[0]), crossed(v[0], v[1])};
  for (auto& row : dual) {
    for (double& component : row) component /= volume;
  }
  return dual;
}

using Units3 = std::array<std::int64_t, 3>;

/// Of vectors of the options: sums and differences of a few are numbers of 32 bits.
constexpr std::int64_t most_shift = std::int64_t{1} << 29;
constexpr std::size_t most_images = std::numeric_limits<std::int32_t>::max();

tl::unexpected<Error> tooManyImages() {
  return tl::unexpected(
      refusal(Subject::domain,
              fmt::format("the period needs more than {} images of its sites: one of its sides is much "
                          "longer than another",
                          most_images)));
}

/// Sites in units. Along axes that do not repeat, components are not used.
class UnitPeriod {
 public:
  UnitPeriod(const Period& period, double band) : period_(period) {
    Vector3 half{};
    for (std::size_t a = 0; a < 3; ++a) {
      for (const auto& vector : period.vectors()) half[a] += std::abs(vector[a]) / 2;
    }
    double largest = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      if (period.along(a)) largest = std::max(largest, half[a] + band);
    }
    // So that no number is larger than 2^53 units, nor the sum of two.
    int exponent = 0;
    std::frexp(largest, &exponent);
    unit_ = std::ldexp(1.0, exponent - 52);
    for (std::size_t a = 0; a < 3; ++a) {
      if (!period.along(a)) continue;
      middle_[a] = static_cast<Int128>(std::nearbyint(period.middle()[a] / unit_));
      for (std::size_t r = 0; r < 3; ++r) vector_[r][a] = whole(period.vectors()[r][a]);
      far_[a] = whole(half[a] + band);
    }
    auto vectors = period.vectors();
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t a = 0; a < 3; ++a) {
        if (period.along(a)) vectors[r][a] = length(vector_[r][a]);
      }
    }
    dual_ = dualOf(vectors);
  }

  [[nodiscard]] double length(std::int64_t units) const { return static_cast<double>(units) * unit_; }
  [[nodiscard]] double middle(std::size_t axis) const { return static_cast<double>(middle_[axis]) * unit_; }
  [[nodiscard]] const std::array<Units3, 3>& vectors() const { return vector_; }
  /// Of the box around period and band: its half.
  [[nodiscard]] std::int64_t far(std::size_t axis) const { return far_[axis]; }
  [[nodiscard]] double component(std::size_t r, const Units3& place) const {
    return dot(dual_[r], {length(place[0]), length(place[1]), length(place[2])});
  }
  /// How many vectors a place in the box may be away from the period.
  [[nodiscard]] std::int32_t most(std::size_t r) const {
    double most = 0;
    for (std::size_t a = 0; a < 3; ++a) most += std::abs(dual_[r][a]) * length(far_[a]);
    return period_.repeats(r) ? static_cast<std::int32_t>(std::min(most + 0.5 + 1e-6, 0x1p30)) : 0;
  }

  /// How many periods have the volume of the box around period and band.
  [[nodiscard]] double periodsInBox() const {
    double ratio = 1 / period_.volume();
    for (std::size_t a = 0; a < 3; ++a)
      ratio *= period_.along(a) ? 2 * length(far_[a]) : period_.vectors()[a][a];
    return ratio;
  }

  [[nodiscard]] static Units3 moved(const Units3& place, const std::array<Units3, 3>& vector,
                                    const Shift& by) {
    Units3 to = place;
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t r = 0; r < 3; ++r) to[a] += by[r] * vector[r][a];
    }
    return to;
  }

  /// Puts a place into the period. Returns false if it is too far away.
  bool wrap(const Vector3& place, Units3& to, Shift& home) const {
    std::array<Int128, 3> at{};
    constexpr double far = 0x1p120;
    for (std::size_t a = 0; a < 3; ++a) {
      if (!period_.along(a)) continue;
      const double units = std::nearbyint(place[a] / unit_);
      if (!(std::abs(units) < far)) return false;
      at[a] = static_cast<Int128>(units) - middle_[a];
    }
    const auto componentOf = [&](std::size_t r) {
      double sum = 0;
      for (std::size_t a = 0; a < 3; ++a) sum += dual_[r][a] * (static_cast<double>(at[a]) * unit_);
      return sum;
    };
    home = {};
    // Twice, since a component of a place far away is rounded.
    for (int again = 0; again < 2; ++again) {
      Shift by{};
      for (std::size_t r = 0; r < 3; ++r) {
        if (!period_.repeats(r)) continue;
        const double whole = std::floor(componentOf(r) + 0.5);
        if (!(std::abs(whole) <= 0x1p30)) return false;
        by[r] = static_cast<std::int32_t>(whole);
      }
      for (std::size_t r = 0; r < 3; ++r) {
        home[r] += by[r];
        for (std::size_t a = 0; a < 3; ++a) at[a] -= static_cast<Int128>(by[r]) * vector_[r][a];
      }
    }
    for (std::size_t a = 0; a < 3; ++a) to[a] = static_cast<std::int64_t>(at[a]);
    takeFirst(to, home);
    return period_.mostOfOptions(home) <= most_shift;
  }

 private:
  std::int64_t whole(double number) const {
    return static_cast<std::int64_t>(std::nearbyint(number / unit_));
  }

  /// Of a site in the period's border, which has copies there: the one with the least coordinates, so that
  /// two sites that are one in the period get one place.
  void takeFirst(Units3& place, Shift& home) const {
    constexpr double edge = 0.5 - 1e-9, out = 0.5 + 1e-9;
    std::array<std::int32_t, 3> most{};
    bool any = false;
    for (std::size_t r = 0; r < 3; ++r) {
      if (!period_.repeats(r) || std::abs(component(r, place)) < edge) continue;
      most[r] = 1;
      any = true;
    }
    if (!any) return;
    const Units3 from = place;
    const Shift from_home = home;
    Shift by{};
    for (by[0] = -most[0]; by[0] <= most[0]; ++by[0]) {
      for (by[1] = -most[1]; by[1] <= most[1]; ++by[1]) {
        for (by[2] = -most[2]; by[2] <= most[2]; ++by[2]) {
          const Units3 copy = moved(from, vector_, by);
          bool within = true;
          for (std::size_t r = 0; r < 3; ++r)
            within = within && (!period_.repeats(r) || std::abs(component(r, copy)) <= out);
          if (!within || copy >= place) continue;
          place = copy;
          for (std::size_t r = 0; r < 3; ++r) home[r] = from_home[r] - by[r];
        }
      }
    }
  }

  const Period& period_;
  double unit_ = 1;
  std::array<Int128, 3> middle_{};
  std::array<Units3, 3> vector_{};
  Units3 far_{};
  std::array<Vector3, 3> dual_{};
};

}  // namespace

Period::Period(const Cells3Options& options)
    : is_lattice_(options.lattice.has_value()), repeats_(options.periodic) {
  const Box3& box = options.domain;
  vector_ = {{{box.xmax - box.xmin, 0, 0}, {0, box.ymax - box.ymin, 0}, {0, 0, box.zmax - box.zmin}}};
  middle_ = {box.xmin + vector_[0][0] / 2, box.ymin + vector_[1][1] / 2, box.zmin + vector_[2][2] / 2};
  if (!is_lattice_) return;
  const auto& [a, b, c] = *options.lattice;
  repeats_ = {true, true, true};
  vector_ = {{{a.x, a.y, a.z}, {b.x, b.y, b.z}, {c.x, c.y, c.z}}};
  for (std::size_t k = 0; k < 3; ++k) middle_[k] = (vector_[0][k] + vector_[1][k] + vector_[2][k]) / 2;
  reduce();
}

void Period::subtract(std::size_t from, std::size_t what, double times) {
  for (std::size_t k = 0; k < 3; ++k) {
    vector_[from][k] -= times * vector_[what][k];
    of_options_[from][k] -= static_cast<std::int64_t>(times) * of_options_[what][k];
  }
}

/// The longest vector is shortened by the two others as long as that helps.
void Period::reduce() {
  constexpr double worth_it = 1 - 1e-12;
  const auto swapIfLonger = [this](std::size_t a, std::size_t b) {
    if (dot(vector_[a], vector_[a]) <= dot(vector_[b], vector_[b])) return;
    std::swap(vector_[a], vector_[b]);
    std::swap(of_options_[a], of_options_[b]);
  };
  for (;;) {
    swapIfLonger(0, 1);
    swapIfLonger(1, 2);
    swapIfLonger(0, 1);
    const double in_plane = std::nearbyint(dot(vector_[1], vector_[0]) / dot(vector_[0], vector_[0]));
    if (in_plane != 0) {
      const auto before = dot(vector_[1], vector_[1]);
      subtract(1, 0, in_plane);
      if (dot(vector_[1], vector_[1]) < worth_it * before) continue;
      subtract(1, 0, -in_plane);
    }
    // The third less the nearest point of the lattice of the first two, which is one of nine.
    const double aa = dot(vector_[0], vector_[0]), ab = dot(vector_[0], vector_[1]),
                 bb = dot(vector_[1], vector_[1]), ac = dot(vector_[0], vector_[2]),
                 bc = dot(vector_[1], vector_[2]), det = aa * bb - ab * ab;
    const double x = std::nearbyint((ac * bb - bc * ab) / det), y = std::nearbyint((bc * aa - ac * ab) / det);
    const double before = dot(vector_[2], vector_[2]);
    double best = before, best_x = 0, best_y = 0;
    for (double dx = -1; dx <= 1; ++dx) {
      for (double dy = -1; dy <= 1; ++dy) {
        Vector3 v = vector_[2];
        for (std::size_t k = 0; k < 3; ++k) v[k] -= (x + dx) * vector_[0][k] + (y + dy) * vector_[1][k];
        if (dot(v, v) < worth_it * best) {
          best = dot(v, v);
          best_x = x + dx;
          best_y = y + dy;
        }
      }
    }
    if (best == before) return;
    subtract(2, 0, best_x);
    subtract(2, 1, best_y);
  }
}

double Period::volume() const { return std::abs(dot(vector_[0], crossed(vector_[1], vector_[2]))); }

std::int64_t Period::mostOfOptions(const Shift& shift) const {
  std::int64_t most = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    std::int64_t sum = 0;
    for (std::size_t r = 0; r < 3; ++r) sum += std::abs(shift[r] * of_options_[r][k]);
    most = std::max(most, sum);
  }
  return most;
}

Shift Period::ofOptions(const Shift& shift) const {
  Shift of_options{};
  for (std::size_t k = 0; k < 3; ++k) {
    std::int64_t sum = 0;
    for (std::size_t r = 0; r < 3; ++r) sum += shift[r] * of_options_[r][k];
    of_options[k] = static_cast<std::int32_t>(sum);
  }
  return of_options;
}

Result<ImagedSites> withImages(const Period& period, std::span<const Point3> sites,
                               const Cells3Options& options, double band, int threads) {
  const UnitPeriod units(period, band);
  ImagedSites out;
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t a = 0; a < 3; ++a)
      out.vector[r][a] = period.along(a) ? units.length(units.vectors()[r][a]) : period.vectors()[r][a];
  }
  for (std::size_t a = 0; a < 3; ++a) out.middle[a] = period.along(a) ? units.middle(a) : 0;
  const Box3& box = options.domain;
  const auto low = [&](std::size_t a, double wall) {
    return period.along(a) ? -units.length(units.far(a)) : wall;
  };
  const auto high = [&](std::size_t a, double wall) {
    return period.along(a) ? units.length(units.far(a)) : wall;
  };
  out.box = {low(0, box.xmin),  low(1, box.ymin),  low(2, box.zmin),
             high(0, box.xmax), high(1, box.ymax), high(2, box.zmax)};

  const std::size_t n = sites.size();
  constexpr std::size_t grain = std::size_t{1} << 14;
  const std::size_t parts = (n + grain - 1) / grain;
  std::vector<Units3> place(n);
  out.home.resize(n);
  std::vector<std::size_t> too_far(parts, n);
  std::vector<std::vector<Image>> images(parts);
  const Shift most{units.most(0), units.most(1), units.most(2)};
  // Before many are looked at.
  if (units.periodsInBox() * static_cast<double>(n) > 2.0 * most_images ||
      period.mostOfOptions(most) > most_shift)
    return tooManyImages();
  const auto isInBox = [&](const Units3& at) {
    bool in = true;
    for (std::size_t a = 0; a < 3; ++a) in = in && (!period.along(a) || std::abs(at[a]) <= units.far(a));
    return in;
  };
  parallelFor(n, grain, threads, [&](std::size_t begin, std::size_t end) {
    auto& found = images[begin / grain];
    for (std::size_t i = begin; i < end; ++i) {
      if (!units.wrap({sites[i].x, sites[i].y, sites[i].z}, place[i], out.home[i])) {
        too_far[begin / grain] = i;
        return;
      }
      Shift by{};
      for (by[0] = -most[0]; by[0] <= most[0]; ++by[0]) {
        for (by[1] = -most[1]; by[1] <= most[1]; ++by[1]) {
          for (by[2] = -most[2]; by[2] <= most[2]; ++by[2]) {
            if (by == Shift{}) continue;
            if (isInBox(UnitPeriod::moved(place[i], units.vectors(), by)))
              found.push_back({static_cast<std::uint32_t>(i), by});
          }
        }
      }
      if (found.size() > most_images) return;
    }
  });
  if (const std::size_t i = *std::ranges::min_element(too_far); i < n) {
    return tl::unexpected(refusal(Subject::sites, fmt::format("site {} is too many periods away: {}, {}, {}",
                                                              i, sites[i].x, sites[i].y, sites[i].z)));
  }
  std::size_t count = n;
  for (const auto& part : images) count += part.size();
  if (count > most_images) return tooManyImages();
  out.images.reserve(count - n);
  for (const auto& part : images) out.images.insert(out.images.end(), part.begin(), part.end());
  out.sites.resize(count);
  const auto put = [&](std::size_t to, std::size_t site, const Units3& at) {
    const Point3& p = sites[site];
    const auto coordinate = [&](std::size_t a, double own) {
      return period.along(a) ? units.length(at[a]) : own;
    };
    out.sites[to] = {coordinate(0, p.x), coordinate(1, p.y), coordinate(2, p.z)};
  };
  parallelEach(n, grain, threads, [&](std::size_t i) { put(i, i, place[i]); });
  parallelEach(out.images.size(), grain, threads, [&](std::size_t k) {
    const auto& [site, shift] = out.images[k];
    put(n + k, site, UnitPeriod::moved(place[site], units.vectors(), shift));
  });
  if (!options.weights.empty()) {
    out.weights.assign(options.weights.begin(), options.weights.end());
    for (const auto& image : out.images) out.weights.push_back(options.weights[image.site]);
  }
  return out;
}

}  // namespace vorpipe::space

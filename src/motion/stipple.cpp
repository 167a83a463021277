#include "vorpipe/stipple.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "base/refusal.h"
#include "base/try.h"
#include "domain/cell_mass.h"
#include "domain/degrees.h"
#include "globe/globe_density.h"
#include "motion/movable.h"

namespace vorpipe {
namespace {

using Random = std::mt19937_64;

/// Random number in [0, 1), a multiple of 2^-53.
double uniform(Random& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

/// Returns the pixels of an image in the order of a Hilbert curve through a square that holds it.
std::vector<std::uint32_t> alongCurve(int width, int height) {
  const auto side = std::bit_ceil(static_cast<std::uint32_t>(std::max(width, height)));
  std::vector<std::uint32_t> pixels;
  pixels.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (std::uint64_t step = 0; step < std::uint64_t{side} * side; ++step) {
    std::uint32_t x = 0, y = 0;
    auto rest = step;
    for (std::uint32_t part = 1; part < side; part *= 2, rest /= 4) {
      const auto right = static_cast<std::uint32_t>(rest / 2 % 2);
      const auto up = static_cast<std::uint32_t>((rest ^ right) % 2);
      if (up == 0) {
        if (right == 1) {
          x = part - 1 - x;
          y = part - 1 - y;
        }
        std::swap(x, y);
      }
      x += part * right;
      y += part * up;
    }
    if (x < static_cast<std::uint32_t>(width) && y < static_cast<std::uint32_t>(height)) {
      pixels.push_back(y * static_cast<std::uint32_t>(width) + x);
    }
  }
  return pixels;
}

/// Pixels along one side of a domain, clipped to it; counted from the left, or from the top.
class Side {
 public:
  Side(double pixels_begin, double pixels_end, int count, double begin, double end) {
    const double size = (pixels_end - pixels_begin) / count;
    first_ = (begin - pixels_begin) / size;
    last_ = (end - pixels_begin) / size;
  }
  /// Returns the range of a pixel inside the domain, in pixels.
  [[nodiscard]] std::pair<double, double> within(std::uint32_t pixel) const {
    return {std::max<double>(pixel, first_), std::min<double>(pixel + 1.0, last_)};
  }
  [[nodiscard]] double part(std::uint32_t pixel) const {
    const auto [from, to] = within(pixel);
    return std::max(0.0, to - from);
  }

 private:
  double first_, last_;
};

/// Draws places by mass.
class Draw {
 public:
  Draw(const Density& density, const Box& domain)
      : density_(density),
        box_(density.box.value_or(domain)),
        pixels_(alongCurve(density.width, density.height)) {
    if (density.box) {
      across_.emplace(box_.xmin, box_.xmax, density.width, domain.xmin, domain.xmax);
      down_.emplace(-box_.ymax, -box_.ymin, density.height, -domain.ymax, -domain.ymin);
    }
    const auto width = static_cast<std::uint32_t>(density.width);
    double sum = 0;
    for (const std::uint32_t pixel : pixels_) {
      const double part = across_ ? across_->part(pixel % width) * down_->part(pixel / width) : 1;
      sums_.push_back(sum += density.values[pixel] * part);
    }
  }

  [[nodiscard]] double mass() const { return sums_.back(); }

  /// Returns a place in the pixel where the curve has passed this part of the mass.
  [[nodiscard]] Point at(double part, Random& random) const {
    const auto found = std::ranges::upper_bound(sums_, part * mass());
    const auto last = std::ranges::lower_bound(sums_, mass());
    const std::uint32_t pixel = pixels_[static_cast<std::size_t>(std::min(found, last) - sums_.begin())];
    const auto width = static_cast<std::uint32_t>(density_.width);
    const auto drawn = [&](const std::optional<Side>& side, std::uint32_t of) {
      const auto [from, to] = side ? side->within(of) : std::pair<double, double>{of, of + 1.0};
      return from + (to - from) * uniform(random);
    };
    const double column = drawn(across_, pixel % width), row = drawn(down_, pixel / width);
    return {box_.xmin + column / density_.width * (box_.xmax - box_.xmin),
            box_.ymax - row / density_.height * (box_.ymax - box_.ymin)};
  }

 private:
  const Density& density_;
  Box box_;                            ///< of the pixels
  std::optional<Side> across_, down_;  ///< if the density has its own box
  std::vector<std::uint32_t> pixels_;
  std::vector<double> sums_;
};

/// Refuses a density that no run over the drawn sites would accept.
Result<void> checkDensityOver(const Box& domain, const Density& density) {
  CellsOptions options;
  options.domain = domain;
  options.density = density;
  return checkInput({{domain.xmin}, {domain.ymin}, {}}, options, 1);
}

}  // namespace

Result<Sites> drawnFrom(const Density& density, const Box& domain, const Outline& outline,
                        std::uint64_t count, std::uint64_t seed) {
  const auto refuse = [](const char* what) { return tl::unexpected(refusalOf(Subject::density, what)); };
  if (density.values.empty()) return refuse("there is none to draw sites from");
  VORPIPE_TRY(checkDensityOver(domain, density));
  const Draw draw(density, domain);
  if (!(draw.mass() > 0) || !std::isfinite(draw.mass())) return refuse("has no mass to draw sites from");
  const moving::AllowedPlaces allowed(domain, outline, Periodic::none);
  Random random(seed);
  Sites sites;
  // An outline that leaves so little of the mass is treated as leaving none.
  constexpr std::uint64_t most_tries = 10000;
  for (std::uint64_t k = 0; k < count; ++k) {
    const double first = static_cast<double>(k) + uniform(random);
    Point place = draw.at(first / static_cast<double>(count), random);
    for (std::uint64_t tries = 0; !allowed.contain(place); ++tries) {
      if (tries == most_tries) return refuse("has no mass inside of the outline to draw sites from");
      place = draw.at(uniform(random), random);
    }
    sites.x.push_back(place.x);
    sites.y.push_back(place.y);
  }
  return sites;
}

Result<Sites> drawnOnGlobe(Density density, std::uint64_t count, std::uint64_t seed) {
  if (density.values.empty()) return drawnFrom(density, {}, {}, count, seed);
  VORPIPE_TRY(core::checkDensity(density));
  VORPIPE_TRY(core::checkOnGlobe(density));
  const Box box = core::boxOnGlobe(density);
  const auto width = static_cast<std::size_t>(density.width);
  for (std::size_t k = 0; k < density.values.size(); ++k) {
    const double row = static_cast<double>(k / width) + 0.5;
    density.values[k] *= std::cos((box.ymax - row * (box.ymax - box.ymin) / density.height) * degree);
  }
  density.box.reset();
  return drawnFrom(density, box, {}, count, seed);
}

Density forEqualMasses(Density density) {
  if (density.values.empty()) return density;
  const double greatest = *std::ranges::max_element(density.values);
  if (!(greatest > 0)) return density;
  for (double& value : density.values) value = (value / greatest) * (value / greatest);
  return density;
}

}  // namespace vorpipe

#include "vorpipe/stipple.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "base/refusal.h"
#include "moving/relax/allowed_places.h"

namespace vorpipe {
namespace {

using Random = std::mt19937_64;

/// In [0, 1), a multiple of 2^-53.
double uniform(Random& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

/// The pixels of an image in the order of Hilbert's curve through a square that holds it.
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

/// Draws places by mass.
class Draw {
 public:
  Draw(const Density& density, const Box& domain)
      : density_(density), domain_(domain), pixels_(alongCurve(density.width, density.height)) {
    double sum = 0;
    for (const std::uint32_t pixel : pixels_) sums_.push_back(sum += density.values[pixel]);
  }

  [[nodiscard]] double mass() const { return sums_.back(); }

  /// A place in the pixel where the curve has passed this part of the mass.
  [[nodiscard]] Point at(double part, Random& random) const {
    const auto found = std::ranges::upper_bound(sums_, part * mass());
    const auto last = std::ranges::lower_bound(sums_, mass());
    const std::uint32_t pixel = pixels_[static_cast<std::size_t>(std::min(found, last) - sums_.begin())];
    const auto width = static_cast<std::uint32_t>(density_.width);
    const double column = static_cast<double>(pixel % width) + uniform(random);
    const double row = static_cast<double>(pixel / width) + uniform(random);
    return {domain_.xmin + column / density_.width * (domain_.xmax - domain_.xmin),
            domain_.ymax - row / density_.height * (domain_.ymax - domain_.ymin)};
  }

 private:
  const Density& density_;
  Box domain_;
  std::vector<std::uint32_t> pixels_;
  std::vector<double> sums_;
};

/// Refuses what no run over sites that are drawn would take.
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
  if (auto checked = checkDensityOver(domain, density); !checked) {
    return tl::unexpected(std::move(checked.error()));
  }
  const Draw draw(density, domain);
  if (!(draw.mass() > 0) || !std::isfinite(draw.mass())) return refuse("has no mass to draw sites from");
  const moving::AllowedPlaces allowed(domain, outline, Periodic::none);
  Random random(seed);
  Sites sites;
  // Where an outline leaves this little of the mass, it leaves nothing for all that can be found out.
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

Density forEqualMasses(Density density) {
  if (density.values.empty()) return density;
  const double greatest = *std::ranges::max_element(density.values);
  if (!(greatest > 0)) return density;
  for (double& value : density.values) value = (value / greatest) * (value / greatest);
  return density;
}

}  // namespace vorpipe

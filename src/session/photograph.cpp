#include "vorpipe/photograph.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/inside.h"
#include "base/try.h"
#include "vorpipe.h"

namespace vorpipe {
namespace {

constexpr std::uint32_t white_paper = 0xFFFFFFFFu;
constexpr int channel_count = 3;

/// The light of each value of a channel of sRGB (IEC 61966-2-1), in whole 65535ths: sums of these do not
/// depend on their order.
std::array<std::uint32_t, 256> lights() {
  constexpr double most = 255, unit = 65535, dark = 0.04045, slope = 12.92, offset = 0.055, exponent = 2.4;
  std::array<std::uint32_t, 256> light{};
  for (std::size_t k = 0; k < light.size(); ++k) {
    const double value = static_cast<double>(k) / most;
    const double linear = value <= dark ? value / slope : std::pow((value + offset) / (1 + offset), exponent);
    light[k] = static_cast<std::uint32_t>(std::lround(unit * linear));
  }
  return light;
}

/// The sums of some pixels' light.
struct Light {
  std::array<std::uint64_t, channel_count> sums{};
  std::uint64_t pixels = 0;
};

class MeanColors {
 public:
  explicit MeanColors(std::size_t sites) : light_(lights()), cells_(sites) {}

  void add(std::uint32_t site, std::uint32_t rgba) {
    Light& cell = cells_[site];
    for (int c = 0; c < channel_count; ++c) cell.sums[static_cast<std::size_t>(c)] += lightOf(rgba, c);
    ++cell.pixels;
  }
  [[nodiscard]] bool has(std::size_t site) const { return cells_[site].pixels > 0; }

  /// Returns the color whose light is nearest to the mean; of two, the darker.
  [[nodiscard]] std::uint32_t of(std::size_t site) const {
    const Light& cell = cells_[site];
    std::uint32_t rgba = 0xFF000000u;
    for (std::size_t c = 0; c < channel_count; ++c) {
      std::uint32_t value = 0;
      // Between two values the border is where their lights' mean is.
      const auto* const border = std::ranges::partition_point(
          light_.begin(), light_.end() - 1,
          [&](const std::uint32_t& light) { return (light + (&light)[1]) * cell.pixels < 2 * cell.sums[c]; });
      value = static_cast<std::uint32_t>(border - light_.begin());
      rgba |= value << 8 * c;
    }
    return rgba;
  }

 private:
  /// A transparent pixel lies on white paper.
  [[nodiscard]] std::uint64_t lightOf(std::uint32_t rgba, int channel) const {
    constexpr std::uint64_t opaque = 255;
    const std::uint64_t alpha = rgba >> 24;
    return (alpha * light_[rgba >> 8 * channel & 0xFF] + (opaque - alpha) * light_.back() + opaque / 2) /
           opaque;
  }

  std::array<std::uint32_t, 256> light_;
  std::vector<Light> cells_;
};

/// Maps places to the pixels of a photograph.
class PixelGridOf {
 public:
  PixelGridOf(const Photograph& photograph, const Box& box)
      : photograph_(photograph),
        box_(box),
        across_((box.xmax - box.xmin) / photograph.width),
        down_((box.ymax - box.ymin) / photograph.height) {}

  [[nodiscard]] Point center(int row, int column) const {
    return {box_.xmin + (column + 0.5) * across_, box_.ymax - (row + 0.5) * down_};
  }
  [[nodiscard]] std::uint32_t pixel(int row, int column) const {
    return photograph_.rgba[static_cast<std::size_t>(row) * static_cast<std::size_t>(photograph_.width) +
                            static_cast<std::size_t>(column)];
  }
  /// Returns the pixel at a place, which may lie beyond a photograph that covers everything.
  [[nodiscard]] std::uint32_t nearest(double x, double y) const {
    const auto step = [](double at, int count) {
      return static_cast<int>(std::clamp(std::floor(at), 0.0, static_cast<double>(count - 1)));
    };
    return pixel(step((box_.ymax - y) / down_, photograph_.height),
                 step((x - box_.xmin) / across_, photograph_.width));
  }

 private:
  const Photograph& photograph_;
  Box box_;
  double across_, down_;
};

tl::unexpected<Error> refusePhotograph(std::string message) {
  return tl::unexpected(Error{ErrorCode::input, std::move(message)});
}

/// Adds each pixel to the cell in which its center lies.
void addPixels(const Photograph& photograph, const PixelGridOf& grid, const Box& domain,
               const Locator& locator, MeanColors& means) {
  constexpr int pixels_at_once = 1 << 20;
  const int rows = std::max(1, pixels_at_once / photograph.width);
  std::vector<Point> places;
  std::vector<std::uint32_t> colors, sites;
  for (int first = 0; first < photograph.height; first += rows) {
    places.clear();
    colors.clear();
    for (int row = first; row < std::min(photograph.height, first + rows); ++row) {
      for (int column = 0; column < photograph.width; ++column) {
        const Point center = grid.center(row, column);
        // Pixels do not repeat with the domain.
        if (!isInside(domain, center.x, center.y)) continue;
        places.push_back(center);
        colors.push_back(grid.pixel(row, column));
      }
    }
    sites.resize(places.size());
    locator.at(places, sites);
    for (std::size_t k = 0; k < sites.size(); ++k) {
      if (sites[k] != no_site) means.add(sites[k], colors[k]);
    }
  }
}

}  // namespace

Result<std::vector<std::uint32_t>> photographColors(const Sites& sites, const Photograph& photograph,
                                                    const CellsOptions& cells, int threads) {
  const bool sized = photograph.width > 0 && photograph.height > 0;
  if (!sized || photograph.rgba.size() != static_cast<std::size_t>(photograph.width) *
                                              static_cast<std::size_t>(photograph.height)) {
    return refusePhotograph("photograph: has no pixels, or not as many as its sides have");
  }
  VORPIPE_LET(locator, Locator::make(sites, cells, threads));
  const bool periodic = cells.periodic != Periodic::none;
  VORPIPE_LET(placed, periodic ? wrapped(sites, cells.domain, cells.periodic, threads) : Sites{});
  const Sites& at = periodic ? placed : sites;
  const Box box = photograph.box.value_or(cells.domain);
  const PixelGridOf grid(photograph, box);
  MeanColors means(sites.size());
  addPixels(photograph, grid, cells.domain, locator, means);
  std::vector<std::uint32_t> colors(sites.size(), white_paper);
  for (std::uint32_t i = 0; i < colors.size(); ++i) {
    if (!means.has(i)) {
      if (photograph.box && !isInside(box, at.x[i], at.y[i])) continue;
      means.add(i, grid.nearest(at.x[i], at.y[i]));
    }
    colors[i] = means.of(i);
  }
  return colors;
}

}  // namespace vorpipe

#include <cmath>
#include <string>

#include "base/parallel.h"
#include "base/refusal.h"
#include "base/try.h"
#include "picture/pixels.h"
#include "vorpipe.h"
#include "vorpipe/free_surface.h"
#include "vorpipe/shapes.h"

namespace vorpipe {
namespace {

/// Number of rows that one thread processes at a time.
constexpr std::size_t air_grain = 16;

/// Maps pixels to the domain, and measures which part of each is not air.
class PixelsOfDiscs {
 public:
  PixelsOfDiscs(const Sites& sites, const RenderOptions& options)
      : sites_(sites),
        box_(shownBox(options)),
        frame_(shownFrame(options)),
        width_((box_.xmax - box_.xmin) / frame_.width),
        height_((box_.ymax - box_.ymin) / frame_.height) {}

  /// Whether the center of a pixel lies in the disc of a site.
  [[nodiscard]] bool has(std::uint32_t site, int row, int column) const {
    return holds(site, column + 0.5, row + 0.5);
  }

  /// Returns the share of a pixel's places, in as many rows and columns, that lie in the disc.
  [[nodiscard]] double partOf(std::uint32_t site, int row, int column, int places) const {
    int held = 0;
    for (int y = 0; y < places; ++y) {
      for (int x = 0; x < places; ++x) {
        held += holds(site, column + (x + 0.5) / places, row + (y + 0.5) / places) ? 1 : 0;
      }
    }
    return static_cast<double>(held) / (places * places);
  }

 private:
  [[nodiscard]] bool holds(std::uint32_t site, double column, double row) const {
    if (sites_.weight.empty()) return false;
    const double dx = box_.xmin + (column - frame_.left) * width_ - sites_.x[site];
    const double dy = box_.ymax - (row - frame_.top) * height_ - sites_.y[site];
    return dx * dx + dy * dy <= sites_.weight[site];
  }

  const Sites& sites_;
  Box box_;
  PictureFrame frame_;
  double width_, height_;  ///< of a pixel
};

Result<void> refuseWhatIsOverAir(const RenderOptions& options) {
  const auto refused = [](const char* what) {
    return tl::unexpected(
        refusal(Subject::none, std::string("a picture with a free surface takes no ") + what + " yet"));
  };
  if (options.periodic != Periodic::none) return refused("period");
  // Their values would be those of the cells before the removal of air.
  if (options.color == ColorBy::area || options.color == ColorBy::neighbors) {
    return refused("colors by area or neighbors");
  }
  if (options.legend) return refused("legend");
  if (options.labels) return refused("labels");
  if (options.dual) return refused("dual");
  if (options.show_sites) return refused("sites");
  return {};
}

/// Returns a color that covers a part of its pixel, which is transparent.
std::uint32_t partly(std::uint32_t rgba, double part) {
  const auto alpha = static_cast<std::uint32_t>(std::lround((rgba >> 24) * part));
  return alpha == 0 ? 0 : (rgba & 0xFFFFFFu) | alpha << 24;
}

/// Calls `air` for each pixel that is partly air, with its color and the part that is not air. A pixel loses
/// its site if its center is air.
template <class Air>
void forAir(const Sites& sites, const RenderOptions& options, Image& image, int threads, const Air& air) {
  const PixelsOfDiscs pixels(sites, options);
  const auto part_of = [&](std::uint32_t site, int row, int column) -> double {
    if (options.antialias > 1) return pixels.partOf(site, row, column, options.antialias);
    return pixels.has(site, row, column) ? 1 : 0;
  };
  parallelFor(static_cast<std::size_t>(image.height), air_grain, threads,
              [&](std::size_t begin, std::size_t end) {
                for (int row = static_cast<int>(begin); row < static_cast<int>(end); ++row) {
                  for (int column = 0; column < image.width; ++column) {
                    const std::size_t at = core::pixelAt(image, row, column);
                    std::uint32_t& site = image.ids[at];
                    if (site == no_site) continue;
                    const double part = part_of(site, row, column);
                    if (part < 1) air(image.rgba[at], part);
                    if (!pixels.has(site, row, column)) site = no_site;
                  }
                }
              });
}

}  // namespace

Result<void> takeOutAir(const Sites& sites, const RenderOptions& options, Image& image, int threads) {
  VORPIPE_TRY(refuseWhatIsOverAir(options));
  forAir(sites, options, image, threads, [&](std::uint32_t& pixel, double part) {
    pixel = options.background ? core::mixed(pixel, part, options.background->rgba) : partly(pixel, part);
  });
  return {};
}

void whitenAir(const Sites& sites, const RenderOptions& options, Image& image, int threads) {
  forAir(sites, options, image, threads, [&](std::uint32_t& pixel, double part) {
    pixel = core::mixed(pixel, part, unfilledColor(options));
  });
}

}  // namespace vorpipe

#include "picture/globe_picture.h"

#include <optional>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "base/try.h"
#include "domain/pixel_mask.h"
#include "globe/globe_cells.h"
#include "globe/sphere_map.h"
#include "globe/sphere_walk.h"
#include "picture/draw_marks.h"
#include "picture/palette.h"
#include "picture/pixels.h"
#include "vorpipe.h"
#include "vorpipe/globe.h"

namespace vorpipe::core {
namespace {

/// The pixels of a map, or several samples in each.
class MapPixels {
 public:
  /// `colors` are by site; `plane` has the map's options. All arguments outlive this.
  MapPixels(const SphereMap& map, const SphereWalk& walk, const std::vector<std::uint32_t>& colors,
            const RenderOptions& plane, int threads)
      : map_(map),
        walk_(walk),
        colors_(colors),
        rings_(sidesOf(plane.outline)),
        box_(shownBox(plane)),
        frame_(shownFrame(plane)),
        threads_(threads) {}

  /// Draws rows of the frame from `first` to before `last`.
  [[nodiscard]] Image draw(int first, int last, int in_pixel) const {
    Image image{frame_.width * in_pixel, (last - first) * in_pixel, {}, {}};
    const auto width = static_cast<std::size_t>(image.width), rows = static_cast<std::size_t>(image.height);
    image.rgba.resize(width * rows);
    image.ids.resize(width * rows);
    constexpr std::size_t rows_at_once = 16;
    parallelFor(rows, rows_at_once, threads_, [&](std::size_t begin, std::size_t end) {
      std::uint32_t site = walk_.first();
      for (auto row = begin; row < end; ++row) {
        const int down = first * in_pixel + static_cast<int>(row);
        site = drawRow(down, frame_.height * in_pixel, site, image, row * width);
      }
    });
    if (!rings_.points.empty())
      maskOutside(rings_, boxOfRows(box_, first, last, frame_.height), 0, threads_, image);
    return image;
  }

 private:
  /// The sides of an outline; a pixel is inside where it is to the left of an odd number.
  static Rings sidesOf(const Outline& outline) {
    Rings rings{outline.points, {}, {}, {}};
    for (const std::size_t offset : outline.ring_offsets) {
      if (!rings.offsets.empty())
        rings.ring.resize(offset, static_cast<std::uint32_t>(rings.offsets.size() - 1));
      rings.offsets.push_back(static_cast<std::uint32_t>(offset));
    }
    return rings;
  }

  /// Draws row `row` of `rows` into the image, from `pixel` on. The walk begins at `site`; returns the site
  /// of the row's first place.
  std::uint32_t drawRow(int row, int rows, std::uint32_t site, Image& image, std::size_t pixel) const {
    const Box& box = box_;
    const SphereMap::Row places(map_, box.ymax - (row + 0.5) / rows * (box.ymax - box.ymin));
    std::uint32_t first = no_site;
    for (int column = 0; column < image.width; ++column, ++pixel) {
      const auto at = places.at(box.xmin + (column + 0.5) / image.width * (box.xmax - box.xmin));
      if (!at) {
        image.ids[pixel] = no_site;
        continue;
      }
      site = walk_.to(*at, site);
      if (first == no_site) first = site;
      image.ids[pixel] = site;
      image.rgba[pixel] = colors_[site];
    }
    return first == no_site ? site : first;
  }

  const SphereMap& map_;
  const SphereWalk& walk_;
  const std::vector<std::uint32_t>& colors_;
  Rings rings_;  ///< empty without an outline
  Box box_;
  PictureFrame frame_;
  int threads_;
};

/// The colors of cells, by site.
std::vector<std::uint32_t> colorsOf(const PaletteIndices& found, const Palette& palette,
                                    const RenderOptions& options) {
  if (hasOwnColors(options)) return options.site_colors;
  std::vector<std::uint32_t> colors(found.index.size(), unfilledColor(options));
  if (!options.fill) return colors;
  for (std::size_t i = 0; i < colors.size(); ++i) colors[i] = palette[found.index[i]];
  return colors;
}

/// Draws cells of the globe, with marksDetail(options); `whole` are those of all of it. Errors: those of
/// paletteIndices and siteLabels.
Result<Rendering> drawGlobe(const Sites& sites, Diagram diagram, const Diagram* whole,
                            const RenderOptions& options, int threads) {
  const Stopwatch watch;
  VORPIPE_VAR(found, paletteIndices(sites, diagram, options, threads));
  VORPIPE_LET(palette, paletteOf(options, found.key));
  VORPIPE_LET(marks, marksOf(sites, diagram, options, threads));
  const auto fills = colorsOf(found, palette, options);
  const auto colors = cellsShowBackground(options) ? std::vector<std::uint32_t>(fills.size()) : fills;

  const SphereMap map(options);
  const SphereWalk walk(sites, whole != nullptr ? *whole : diagram, threads);
  const PictureFrame frame = shownFrame(options);
  VORPIPE_VAR(plane, optionsOnMap(options));
  if (options.outline.empty()) plane.outline = {};
  const MapPixels pixels(map, walk, colors, plane, threads);
  Rendering rendering;
  rendering.image = pixels.draw(0, frame.height, 1);
  const Sites dots = options.show_sites ? sitesOnMap(sites, options) : Sites{};
  const Overlays overlays{options, marks, dots, shownBox(options), {0, 0, frame.width, frame.height},
                          threads};
  const auto draw = [&](int first, int last) -> Result<Image> {
    return pixels.draw(first, last, options.antialias);
  };
  VORPIPE_TRY(drawOverlays(overlays, draw, rendering.image));
  completePicture(options, marks, fills, found.key, threads, rendering.image);
  rendering.report = diagram.report;
  rendering.report.time_ms.draw = watch.milliseconds();
  rendering.key = std::move(found.key);
  rendering.status = std::move(diagram.status);
  rendering.owner = std::move(diagram.owner);
  return rendering;
}

}  // namespace

Result<Rendering> renderGlobe(const Machine& machine, const Sites& sites, const RenderOptions& options) {
  CellsOptions wanted = cellsOptions(options);
  wanted.detail = marksDetail(options);
  VORPIPE_VAR(diagram, globeCellsOn(machine, sites, wanted));
  std::optional<Diagram> whole;
  if (!options.outline.empty()) {
    // The walk goes over neighbors all around.
    wanted.outline = {};
    wanted.detail = Detail::measures;
    VORPIPE_VAR(found, globeCellsOn(machine, sites, wanted));
    whole = std::move(found);
  }
  return drawGlobe(sites, std::move(diagram), whole ? &*whole : nullptr, options,
                   threadCount(machine.threads));
}

}  // namespace vorpipe::core

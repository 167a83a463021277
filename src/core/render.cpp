#include "core/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/cell_drawing.h"
#include "core/colormap.h"
#include "core/diagram.h"
#include "core/overlay.h"
#include "core/prepare.h"
#include "core/shade.h"
#include "core/stopwatch.h"

namespace vorpipe {
namespace {

constexpr int largest_side = 32768;

Result<void> checkOptions(const RenderOptions& options) {
  const auto refuse = [](std::string message) {
    return tl::unexpected(Error{ErrorCode::input, std::move(message)});
  };
  if (std::min(options.width, options.height) < 1 || std::max(options.width, options.height) > largest_side) {
    return refuse(fmt::format("a picture of {}x{} pixels: each side must be 1 to {}", options.width,
                              options.height, largest_side));
  }
  return checkSearch(options.search);
}

/// One view of a picture that is drawn in parts: its place in the image, rows from the bottom.
struct Part {
  int column, row, width, height;
};

std::vector<Part> partsOf(int width, int height, int most) {
  std::vector<Part> parts;
  for (int row = 0; row < height; row += most) {
    for (int column = 0; column < width; column += most) {
      parts.push_back({column, row, std::min(most, width - column), std::min(most, height - row)});
    }
  }
  return parts;
}

Box boxOf(const Part& part, const Box& domain, int width, int height) {
  const auto x = [&](int column) { return domain.xmin + (domain.xmax - domain.xmin) * column / width; };
  const auto y = [&](int row) { return domain.ymin + (domain.ymax - domain.ymin) * row / height; };
  return {x(part.column), y(part.row), x(part.column + part.width), y(part.row + part.height)};
}

/// Copies a part, whose row 0 is the bottom, into the image, whose row 0 is the top.
void place(const Part& part, const std::vector<std::uint32_t>& from, const Image& image,
           std::vector<std::uint32_t>& to) {
  const auto width = static_cast<std::size_t>(part.width);
  for (int row = 0; row < part.height; ++row) {
    const auto target =
        static_cast<std::size_t>(image.height - 1 - part.row - row) * static_cast<std::size_t>(image.width) +
        static_cast<std::size_t>(part.column);
    std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(row) * width), width,
                to.begin() + static_cast<std::ptrdiff_t>(target));
  }
}

/// The measures that the colors follow; nothing for colors that do not.
Result<Diagram> measure(Backend& backend, Backend& judge, int threads, const Sites& sites,
                        const RenderOptions& options) {
  if (options.color != ColorBy::area && options.color != ColorBy::neighbors) return Diagram{};
  return cellsOn(backend, judge, threads, sites,
                 {options.domain, options.search, Detail::measures, options.progress});
}

Result<Image> drawParts(Backend& backend, CellDrawing& drawing, const SiteSet& set, const Palette& palette,
                        const RenderOptions& options, double& download_seconds) {
  Image image{options.width, options.height, {}, {}};
  const auto pixels = static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height);
  image.rgba.resize(pixels);
  image.ids.resize(pixels);
  std::vector<std::uint32_t> rgba;
  std::vector<std::uint32_t> ids;
  for (const auto& part : partsOf(options.width, options.height, backend.info().max_view)) {
    const View view{boxOf(part, set.domain, options.width, options.height), part.width, part.height, palette};
    if (auto drawn = drawing.draw(view); !drawn) return tl::unexpected(drawn.error());
    rgba.resize(static_cast<std::size_t>(part.width) * static_cast<std::size_t>(part.height));
    ids.resize(rgba.size());
    Stopwatch watch;
    if (auto read = backend.read(rgba, ids); !read) return tl::unexpected(read.error());
    place(part, rgba, image, image.rgba);
    place(part, ids, image, image.ids);
    download_seconds += watch.seconds();
  }
  return image;
}

void countStatuses(const Prepared& prepared, const std::vector<CellStatus>& status, Rendering& rendering) {
  rendering.status.assign(prepared.owner.size(), Status::duplicate);
  for (std::size_t i = 0; i < prepared.set.size(); ++i) {
    const bool empty = status[i] == CellStatus::empty;
    rendering.status[prepared.set.id[i]] = empty ? Status::empty : Status::ok;
    ++(empty ? rendering.report.empty : rendering.report.ok);
  }
  rendering.report.duplicate = prepared.owner.size() - prepared.set.size();
}

}  // namespace

Result<Rendering> renderOn(Backend& backend, Backend& judge, int threads, const Sites& sites,
                           const RenderOptions& options) {
  if (auto checked = checkOptions(options); !checked) return tl::unexpected(checked.error());
  const auto palette = paletteByName(options.colormap);
  if (!palette) return tl::unexpected(palette.error());

  Rendering rendering;
  auto& times = rendering.report.time_ms;
  const auto cells = measure(backend, judge, threads, sites, options);
  if (!cells) return tl::unexpected(cells.error());
  times.cells = cells->report.time_ms.cells;

  const Stopwatch order_watch;
  auto prepared = prepare(sites, options.domain, threads);
  if (!prepared) return tl::unexpected(prepared.error());
  const auto shades = shadesOf(options.color, sites, prepared->set, *cells);
  if (!shades) return tl::unexpected(shades.error());
  times.order = 1e3 * order_watch.seconds();

  const int most = backend.info().max_view;
  Judge set_judge(judge, prepared->set);
  CellDrawing drawing({backend, set_judge, prepared->set, *shades, options.search, threads, options.progress,
                       options.width > most || options.height > most});
  double download_seconds = 0;
  auto image = drawParts(backend, drawing, prepared->set, *palette, options, download_seconds);
  if (!image) return tl::unexpected(image.error());
  rendering.image = std::move(*image);
  if (options.edges) drawEdges(rendering.image);
  if (options.show_sites) drawSites(rendering.image, sites, options.domain);

  auto& report = rendering.report;
  times.download = 1e3 * download_seconds;
  drawing.describe(report);
  countStatuses(*prepared, drawing.status(), rendering);
  rendering.owner = std::move(prepared->owner);
  const auto& device = backend.info().device;
  report.backend = device.backend;
  report.device = device.name;
  report.driver = device.driver;
  report.validation_messages = backend.validationMessages();
  return rendering;
}

}  // namespace vorpipe

#include "picture/draw_parts.h"

#include <algorithm>
#include <atomic>
#include <vector>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "base/try.h"
#include "domain/pixel_mask.h"
#include "picture/near_view.h"
#include "picture/pixels.h"
#include "sites/bin_sort.h"
#include "sites/site_set.h"
#include "vorpipe.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t uncovered_grain = std::size_t{1} << 16;
/// Number of pixels per query to the exact search: a device may have covered none.
constexpr std::size_t uncovered_at_once = std::size_t{1} << 20;

bool areAllCovered(const NearestSites& nearest, std::span<const std::uint32_t> ids) {
  std::atomic<bool> all = true;
  parallelFor(ids.size(), uncovered_grain, threadsForSteps(ids.size(), nearest.threads),
              [&](std::size_t begin, std::size_t end) {
                const auto part = ids.subspan(begin, end - begin);
                if (std::ranges::any_of(part, [&](auto id) { return id >= nearest.ids; })) all = false;
              });
  return all;
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

/// Copies a part, whose row 0 is the bottom, into the image, whose row 0 is the top.
void place(const Part& part, const std::vector<std::uint32_t>& from, const Image& image,
           std::vector<std::uint32_t>& to) {
  for (int row = 0; row < part.height; ++row) {
    const auto first = from.begin() + static_cast<std::ptrdiff_t>(row) * part.width;
    const auto target = pixelAt(image, image.height - 1 - part.row - row, part.column);
    std::copy_n(first, part.width, to.begin() + static_cast<std::ptrdiff_t>(target));
  }
}

View viewOf(const ShownPart& shown, const Part& part, const Palette& palette) {
  return {shown.boxOf(part.column, part.row, part.width, part.height),
          part.width,
          part.height,
          palette,
          {shown.box.xmin, shown.box.ymin}};
}

RenderOptions samplesOf(RenderOptions options) {
  const PictureFrame frame = shownFrame(options);
  options.width = frame.width * options.antialias;
  options.height = frame.height * options.antialias;
  options.fit = Fit::stretch;
  return options;
}

}  // namespace

std::uint64_t coverRest(const NearestSites& nearest, const View& view, std::span<std::uint32_t> rgba,
                        std::span<std::uint32_t> ids) {
  if (areAllCovered(nearest, ids)) return 0;
  std::uint64_t count = 0;
  std::vector<std::uint32_t> pixels;
  std::vector<std::uint32_t> sites;
  for (std::size_t next = 0; next < ids.size();) {
    pixels.clear();
    for (; next < ids.size() && pixels.size() < uncovered_at_once; ++next) {
      if (ids[next] >= nearest.ids) pixels.push_back(static_cast<std::uint32_t>(next));
    }
    sites.resize(pixels.size());
    nearest.exact_search.nearest(view, pixels, sites);
    for (std::size_t k = 0; k < pixels.size(); ++k) {
      const bool none = sites[k] == no_site;
      ids[pixels[k]] = none ? no_site : nearest.sites.id[sites[k]];
      rgba[pixels[k]] = none ? 0 : view.palette[nearest.palette_index[sites[k]]];
    }
    count += pixels.size();
  }
  return count;
}

Box shownIn(const Scene& scene, const RenderOptions& options) {
  if (!options.view) return scene.picture;
  const Box &view = *options.view, &domain = options.domain;
  if (options.periodic == Periodic::none) return view;
  // The scene of a periodic domain is scaled and shifted.
  const PowerOfTwo scale(scaleExponent(domain));
  const double west = scene.picture.xmin + scale(view.xmin - domain.xmin);
  const double south = scene.picture.ymin + scale(view.ymin - domain.ymin);
  return {west, south, west + scale(view.xmax - view.xmin), south + scale(view.ymax - view.ymin)};
}

ShownPart shownPart(const Scene& scene, const RenderOptions& options, int exponent) {
  const PowerOfTwo scale(exponent);
  const Box box = shownIn(scene, options);
  const PictureFrame frame = shownFrame(options), shown = domainFrame(options);
  return {{scale(box.xmin), scale(box.ymin), scale(box.xmax), scale(box.ymax)},
          frame.width,
          frame.height,
          shown.left - frame.left,
          (frame.top + frame.height) - (shown.top + shown.height),
          shown.width,
          shown.height};
}

Result<Drawn> drawParts(Backend& backend, CellDrawing& drawing, const NearestSites& nearest,
                        const ShownPart& shown, const Palette& palette, std::size_t room) {
  Drawn drawn{{shown.width, shown.height, {}, {}}};
  Image& image = drawn.image;
  const auto pixels = static_cast<std::size_t>(shown.width) * static_cast<std::size_t>(shown.height);
  image.rgba.reserve(room);
  image.ids.reserve(room);
  image.rgba.resize(pixels);
  image.ids.resize(pixels);
  std::vector<std::uint32_t> rgba;
  std::vector<std::uint32_t> ids;
  for (const auto& part : partsOf(shown.width, shown.height, backend.info().max_view)) {
    const View view = viewOf(shown, part, palette);
    VORPIPE_TRY(drawing.draw(view));
    rgba.resize(static_cast<std::size_t>(part.width) * static_cast<std::size_t>(part.height));
    ids.resize(rgba.size());
    Stopwatch watch;
    VORPIPE_TRY(drawing.read(view, rgba, ids));
    drawn.uncovered += coverRest(nearest, view, rgba, ids);
    place(part, rgba, image, image.rgba);
    place(part, ids, image, image.ids);
    drawn.download_seconds += watch.seconds();
  }
  if (pixels == 0) {
    VORPIPE_TRY(drawing.findStatuses());
  }
  return drawn;
}

WhatToDraw whatToDraw(const SiteSet& set, const RenderOptions& options, const ShownPart& shown) {
  WhatToDraw what;
  if (!options.view) return what;
  if (shown.width == 0) {
    what.shown.emplace();
    return what;
  }
  const View view = viewOf(shown, {0, 0, shown.width, shown.height}, {});
  what.by_device = isForDevices(view);
  const Box& box = view.box;
  const Box in_set{view.corner.x + box.xmin, view.corner.y + box.ymin, view.corner.x + box.xmax,
                   view.corner.y + box.ymax};
  const Box& domain = set.domain;
  const double part = (box.xmax - box.xmin) / (domain.xmax - domain.xmin) *
                      ((box.ymax - box.ymin) / (domain.ymax - domain.ymin));
  if (2 * part < 1 || !what.by_device) what.shown = sitesNear(set, in_set);
  return what;
}

SampleDrawing::SampleDrawing(const Machine& machine, const NearestSites& nearest,
                             const RenderOptions& options, const Palette& palette, KeptPicture& kept)
    : machine_(machine),
      nearest_(nearest),
      in_pixel_(options.antialias),
      options_(samplesOf(options)),
      palette_(palette),
      kept_(kept),
      all_(shownPart(kept.found.scene, options_, kept.found.run->prepared.exponent)),
      drawing_({machine.backend, kept.found.run->exact_search, kept.found.run->prepared.set, options.search,
                machine.threads, options.progress},
               kept.colors->index, whatToDraw(kept.found.run->prepared.set, options_, all_), kept.before) {}

Result<Image> SampleDrawing::draw(int first, int last) {
  const int rows = options_.height / in_pixel_, height = (last - first) * in_pixel_;
  const int lowest = (rows - last) * in_pixel_;
  ShownPart part = all_;
  part.bottom = std::max(all_.bottom, lowest);
  part.height = std::max(0, std::min(all_.bottom + all_.height, lowest + height) - part.bottom);
  Image image{0, 0, {}, {}};
  PictureFrame at{0, 0, 0, 0};
  if (part.height > 0 && part.width > 0) {
    const auto room = static_cast<std::size_t>(options_.width) * static_cast<std::size_t>(height);
    VORPIPE_VAR(drawn, drawParts(machine_.backend, drawing_, nearest_, part, palette_, room));
    image = std::move(drawn.image);
    at = {all_.left, lowest + height - (part.bottom + part.height), part.width, part.height};
  }
  putIntoFrame(at, options_.width, height, image);
  if (!options_.outline.empty()) {
    const Box box = boxOfRows(shownBox(options_), first, last, rows);
    maskOutside(kept_.rings, box, kept_.found.run->prepared.exponent, machine_.threads, image);
  }
  return image;
}

}  // namespace vorpipe::core

#include "picture/draw_places.h"

#include <algorithm>

#include "domain/pixel_mask.h"
#include "picture/frame.h"
#include "vorpipe.h"

namespace vorpipe::core {
namespace {

/// Returns the rows of a box from `first` to before `last` of `rows`, counted from its upper end.
Box rowsOf(const Box& box, int first, int last, int rows) {
  const auto upper = [&](int row) {
    return row == rows ? box.ymin : box.ymax - (box.ymax - box.ymin) * row / rows;
  };
  return {box.xmin, upper(last), box.xmax, upper(first)};
}

RenderOptions placesOf(RenderOptions options) {
  const PictureFrame frame = shownFrame(options);
  options.width = frame.width * options.antialias;
  options.height = frame.height * options.antialias;
  options.fit = Fit::stretch;
  return options;
}

}  // namespace

PlacesDrawing::PlacesDrawing(const Machine& machine, const NearestSites& nearest,
                             const RenderOptions& options, const Palette& palette, KeptPicture& kept)
    : machine_(machine),
      nearest_(nearest),
      in_pixel_(options.antialias),
      options_(placesOf(options)),
      palette_(palette),
      kept_(kept),
      all_(shownPart(kept.found.scene, options_, kept.found.run->prepared.exponent)),
      drawing_({machine.backend, kept.found.run->judge, kept.found.run->prepared.set, options.search,
                machine.threads, options.progress},
               kept.colors->index, whatToDraw(kept.found.run->prepared.set, options_, all_), kept.before) {}

Result<Image> PlacesDrawing::draw(int first, int last) {
  const int rows = options_.height / in_pixel_, height = (last - first) * in_pixel_;
  const int lowest = (rows - last) * in_pixel_;
  ShownPart part = all_;
  part.bottom = std::max(all_.bottom, lowest);
  part.height = std::max(0, std::min(all_.bottom + all_.height, lowest + height) - part.bottom);
  Image image{0, 0, {}, {}};
  PictureFrame at{0, 0, 0, 0};
  if (part.height > 0 && part.width > 0) {
    const auto room = static_cast<std::size_t>(options_.width) * static_cast<std::size_t>(height);
    auto drawn = drawParts(machine_.backend, drawing_, nearest_, part, palette_, room);
    if (!drawn) return tl::unexpected(drawn.error());
    image = std::move(drawn->image);
    at = {all_.left, lowest + height - (part.bottom + part.height), part.width, part.height};
  }
  putIntoFrame(at, options_.width, height, image);
  if (!options_.outline.empty()) {
    const Box box = rowsOf(shownBox(options_), first, last, rows);
    maskOutside(kept_.rings, box, kept_.found.run->prepared.exponent, machine_.threads, image);
  }
  return image;
}

}  // namespace vorpipe::core

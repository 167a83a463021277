#include "picture/shown_part.h"

#include "sites/bin_sort.h"
#include "sites/site_set.h"
#include "vorpipe.h"

namespace vorpipe::core {

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

}  // namespace vorpipe::core

#include <fmt/core.h>

#include <algorithm>
#include <new>
#include <optional>

#include "base/try.h"
#include "check/checks.h"
#include "check/outline.h"
#include "vorpipe.h"

namespace vorpipe::core::checks {
namespace {

constexpr std::uint64_t sampled_pixels = std::uint64_t{1} << 22;

/// The pixels of a picture, and those that show the domain.
struct Pixels {
  Pixels(const CheckedSites& run, const RenderOptions& options, const Image& of)
      : image(of), frame(shownFrame(options)), of_domain(domainFrame(options)) {
    if (!options.view) {
      shown = run.domain;
      return;
    }
    const Box &view = *options.view, &domain = options.domain;
    shown.xmin = run.domain.xmin + (view.xmin - domain.xmin) * run.scale;
    shown.ymax = run.domain.ymax + (view.ymax - domain.ymax) * run.scale;
    shown.xmax = shown.xmin + (view.xmax - view.xmin) * run.scale;
    shown.ymin = shown.ymax - (view.ymax - view.ymin) * run.scale;
  }
  [[nodiscard]] int row(std::size_t pixel) const {
    return static_cast<int>(pixel / static_cast<std::size_t>(image.width));
  }
  [[nodiscard]] int column(std::size_t pixel) const {
    return static_cast<int>(pixel % static_cast<std::size_t>(image.width));
  }
  [[nodiscard]] bool showsDomain(std::size_t pixel) const {
    const int down = row(pixel) - of_domain.top, right = column(pixel) - of_domain.left;
    return down >= 0 && down < of_domain.height && right >= 0 && right < of_domain.width;
  }
  /// Relative to the same origin as run.site.
  [[nodiscard]] Point centerOf(std::size_t pixel) const {
    const double right = (column(pixel) - frame.left + 0.5) / frame.width;
    const double down = (row(pixel) - frame.top + 0.5) / frame.height;
    return {shown.xmin + right * (shown.xmax - shown.xmin), shown.ymax - down * (shown.ymax - shown.ymin)};
  }

  const Image& image;
  PictureFrame frame;      ///< the part that shows the view
  PictureFrame of_domain;  ///< its part that shows the domain
  Box shown{};             ///< the box in the frame, with the same origin as run.site
};

/// Largest absolute coordinate in the domain.
double extentOf(const CheckedSites& run) {
  const Box& box = run.domain;
  return std::max({std::abs(box.xmin), std::abs(box.xmax), std::abs(box.ymin), std::abs(box.ymax)});
}

bool isSampled(std::size_t pixel, std::size_t pixels) {
  const std::uint64_t every = (pixels + sampled_pixels - 1) / sampled_pixels;
  // Multiplied so that the samples do not form columns.
  return (pixel * 0x9E3779B97F4A7C15u >> 32) % every == 0;
}

/// The pixel's own id if no site is nearer, else the nearest site's.
std::uint32_t trueId(const CheckedSites& run, const Pixels& pixels, const Rendering& rendering,
                     const NearestSite& nearest, std::size_t pixel) {
  const std::uint32_t id = rendering.image.ids[pixel];
  const Point p = pixels.centerOf(pixel);
  const NearImage near = nearestImage(run, nearest, p);
  const NearImage own = imageNear(run, id, p);
  const Point way = wayTo(run, own, near);
  if (dot(way, way) == 0) return id;
  // The bisector follows from two differences; its position and that of p are as accurate as these are long.
  const double weight_difference = run.weightDifference(id, near.site);
  const double lengths =
      length(p - own.place) + length(p - near.place) + std::abs(weight_difference) / length(way);
  const double rounding = 16 * epsilon * (lengths + extentOf(run));
  return beyondBisector(way, own.place, weight_difference, p) <= rounding ? id : rendering.owner[near.site];
}

/// Whether a pixel may have no site if `outside`, else whether it may have one. A pixel whose center is as
/// near to the outline as rounding may belong to either side.
bool mayBeOutside(const CheckedSites& run, const CheckedOutline& outline, Point center, bool outside) {
  using Side = CheckedOutline::Side;
  const Side side = outline.at(center, run.largest * 16 * epsilon);
  return side == Side::edge || (side == Side::outside) == outside;
}

/// A pixel on the outline may belong to a site on its other side, which then may have no cell.
bool isOnOutline(const CheckedSites& run, const std::optional<CheckedOutline>& outline, Point center) {
  return outline && mayBeOutside(run, *outline, center, true) && mayBeOutside(run, *outline, center, false);
}

/// Checks that pixels outside an outline have no site; in larger pictures, only sampled pixels.
void checkOutside(const CheckedSites& run, const CheckedOutline& outline, const Pixels& pixels,
                  Broken& broken) {
  const Image& image = pixels.image;
  broken.expect("pixels", image.ids.size(), run.threads, [&](std::size_t pixel) -> std::string {
    const bool outside = image.ids[pixel] == no_site;
    if (!isSampled(pixel, image.ids.size()) || !pixels.showsDomain(pixel)) return {};
    if (mayBeOutside(run, outline, pixels.centerOf(pixel), outside)) return {};
    return fmt::format("row {}, column {} has {} site, but lies {} the outline", pixels.row(pixel),
                       pixels.column(pixel), outside ? "no" : "a", outside ? "inside" : "outside");
  });
}

bool checkCovered(const CheckedSites& run, const Pixels& pixels, const Rendering& rendering, Broken& broken) {
  const Image& image = rendering.image;
  std::optional<CheckedOutline> outline;
  if (run.outline != nullptr) checkOutside(run, outline.emplace(run), pixels, broken);
  return broken.expect("pixels", image.ids.size(), run.threads, [&](std::size_t pixel) -> std::string {
    const std::uint32_t id = image.ids[pixel];
    const bool inside = pixels.showsDomain(pixel);
    if (inside && id < run.size() && rendering.status[id] == Status::ok) return {};
    if (id == no_site && (run.outline != nullptr || !inside)) return {};
    const bool hidden = inside && id < run.size() && rendering.status[id] == Status::empty;
    if (hidden && isOnOutline(run, outline, pixels.centerOf(pixel))) return {};
    if (!inside) {
      return fmt::format("row {}, column {} lies beside the domain, and belongs to site {}",
                         pixels.row(pixel), pixels.column(pixel), id);
    }
    return fmt::format("row {}, column {} belongs to {}", pixels.row(pixel), pixels.column(pixel),
                       id == no_site ? "no site" : fmt::format("site {}, which has no cell", id));
  });
}

/// The correct ids, for sampled pixels.
std::vector<std::uint32_t> trueIds(const CheckedSites& run, const Pixels& pixels,
                                   const Rendering& rendering) {
  const NearestSite nearest(run, rendering.owner);
  std::vector<std::uint32_t> ids = rendering.image.ids;
  constexpr std::size_t grain = 4096;
  parallelEach(ids.size(), grain, run.threads, [&](std::size_t pixel) {
    if (!isSampled(pixel, ids.size()) || ids[pixel] == no_site) return;
    ids[pixel] = trueId(run, pixels, rendering, nearest, pixel);
  });
  return ids;
}

void checkPixels(const CheckedSites& run, const Pixels& pixels, const RenderOptions& options,
                 const Rendering& rendering, Broken& broken) {
  const Image& image = rendering.image;
  const auto diff = diffIds(image.ids, trueIds(run, pixels, rendering), run.sites, options);
  if (!diff) {
    broken.add("pixels", diff.error().message);
  } else if (diff->wrong > 0) {
    const IdDifference& first = diff->first.front();
    broken.add("pixels",
               fmt::format("row {}, column {} belongs to site {}, but site {} is nearer by {:.4g} px "
                           "(the first of {})",
                           first.row, first.column, first.a, first.b, first.distance, diff->wrong));
  } else if (!diff->agree()) {
    broken.add("pixels",
               fmt::format("{} lie beside the cell of their nearest site, the cell boundaries allow {}",
                           diff->ties, diff->ties_allowed));
  }
}

std::vector<std::string> brokenBy(const CheckedSites& run, const RenderOptions& options,
                                  const Rendering& rendering) {
  Broken broken;
  const Image& image = rendering.image;
  const auto pixels = static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height);
  const bool owned = checkOutcome(run, {rendering.status, rendering.owner, rendering.report}, broken);
  if (image.width != options.width || image.height != options.height || image.ids.size() != pixels ||
      image.rgba.size() != pixels) {
    broken.add("pixels", fmt::format("there are {} ids and {} colors for {}x{}", image.ids.size(),
                                     image.rgba.size(), options.width, options.height));
  } else if (const Pixels shown(run, options, image); owned && checkCovered(run, shown, rendering, broken)) {
    checkPixels(run, shown, options, rendering, broken);
  }
  return broken.take();
}

}  // namespace
}  // namespace vorpipe::core::checks

namespace vorpipe {

Result<std::vector<std::string>> check(const Sites& sites, const RenderOptions& options,
                                       const Rendering& rendering, int threads) {
  try {
    VORPIPE_TRY(checkView(options));
    if (options.globe) return core::checks::brokenInGlobePicture(sites, options, rendering, threads);
    VORPIPE_LET(inside, core::checks::wrappedIfPeriodic(sites, options.domain, options.periodic, threads));
    core::checks::CheckedSites run(inside ? *inside : sites, options.domain, options.periodic, threads);
    run.countFromCorner();
    if (!options.outline.empty()) run.outline = &options.outline;
    return core::checks::brokenBy(run, options, rendering);
  } catch (const std::bad_alloc&) {
    return tl::unexpected(Error{ErrorCode::device, "there is not enough memory to check the picture"});
  }
}

}  // namespace vorpipe

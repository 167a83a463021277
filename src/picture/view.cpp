#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "base/option_rows.h"
#include "base/refusal.h"
#include "base/try.h"
#include "globe/sphere_map.h"
#include "vorpipe.h"

namespace vorpipe {
namespace {

tl::unexpected<Error> refusePicture(std::string message) {
  return tl::unexpected(Error{ErrorCode::input, std::move(message)});
}

struct Steps {
  int first = 0, count = 0;
};

/// Returns the first of `count` steps for which `is` holds, as it does from there to the end; else `count`.
template <typename Is>
int firstThat(int count, const Is& is) {
  int low = 0, high = count;
  while (low < high) {
    const int middle = std::midpoint(low, high);
    if (is(middle)) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  return low;
}

/// Returns the pixels along an axis whose centers lie between `low` and `high`, both relative to the first
/// pixel's start. There are `count` pixels with the total length `length`.
Steps centersBetween(double low, double high, double length, int count) {
  const auto centerOf = [&](int step) { return (step + 0.5) / count * length; };
  const int first = firstThat(count, [&](int step) { return centerOf(step) >= low; });
  const int end = firstThat(count, [&](int step) { return centerOf(step) > high; });
  return {first, std::max(0, end - first)};
}

}  // namespace

PictureSize sizeFor(const Box& domain, int longer_side) {
  const double width = domain.xmax - domain.xmin, height = domain.ymax - domain.ymin;
  const auto shorter = [&](double part) {
    return std::max(1, static_cast<int>(std::lround(part * longer_side)));
  };
  if (width >= height) return PictureSize{longer_side, shorter(height / width)};
  return PictureSize{shorter(width / height), longer_side};
}

PictureSize defaultSize(const Box& domain) {
  constexpr int default_longer_side = 1000;
  return sizeFor(domain, default_longer_side);
}

PictureFrame frameOf(const Box& domain, int width, int height, Fit fit) {
  const PictureFrame whole{0, 0, width, height};
  if (fit == Fit::stretch) return whole;
  // Per width of the picture and per height of it, so that no extent of a domain overflows.
  const double wide = (domain.xmax - domain.xmin) / width, high = (domain.ymax - domain.ymin) / height;
  const double fitting_width = wide < high ? width * (wide / high) : width;
  const double fitting_height = high < wide ? height * (high / wide) : height;
  // If the width matches the height, rounding to pixels leaves up to a pixel, and rounding of doubles
  // slightly more.
  constexpr double most_left = 1 + 1e-6;
  if (width - fitting_width <= most_left && height - fitting_height <= most_left) return whole;
  const auto pixels = [](double side) { return std::max(1, static_cast<int>(std::lround(side))); };
  const int frame_width = pixels(fitting_width), frame_height = pixels(fitting_height);
  return {(width - frame_width) / 2, (height - frame_height) / 2, frame_width, frame_height};
}

DotSize dotSizeOf(double size, double spacing, PictureSize picture) {
  double radius = size / 2;
  if (size == 0) {
    // Large pictures are viewed from farther away.
    constexpr double part_of_spacing = 0.12, least = 0.5, usual = 5;
    constexpr int sides = 200;
    const int part_of_side = std::max(picture.width, picture.height) / sides;
    const double most = std::max<double>(usual, part_of_side);
    radius = std::clamp(part_of_spacing * spacing, least, most);
  }
  // A rim around a smaller dot would leave little of it.
  constexpr double least_with_rim = 2.5, part_of_radius = 0.2;
  return {radius, radius >= least_with_rim ? std::max(1.0, part_of_radius * radius) : 0};
}

const Box& shownBox(const RenderOptions& options) {
  if (options.view) return *options.view;
  return options.globe ? core::boxOfMap(options) : options.domain;
}

PictureFrame shownFrame(const RenderOptions& options) {
  return frameOf(shownBox(options), options.width, options.height,
                 options.globe ? Fit::letterbox : options.fit);
}

PictureFrame domainFrame(const RenderOptions& options) {
  const PictureFrame frame = shownFrame(options);
  if (!options.view || options.globe) return frame;
  const Box &view = *options.view, &domain = options.domain;
  const Steps columns =
      centersBetween(domain.xmin - view.xmin, domain.xmax - view.xmin, view.xmax - view.xmin, frame.width);
  const Steps rows =
      centersBetween(view.ymax - domain.ymax, view.ymax - domain.ymin, view.ymax - view.ymin, frame.height);
  if (columns.count == 0 || rows.count == 0) return {frame.left, frame.top, 0, 0};
  return {frame.left + columns.first, frame.top + rows.first, columns.count, rows.count};
}

Result<void> checkView(const RenderOptions& options) {
  if (options.globe && options.view_from) {
    VORPIPE_TRY(Projection::around(*options.view_from));
  }
  if (!options.view) return {};
  const Box &view = *options.view, &domain = options.globe ? core::boxOfMap(options) : options.domain;
  const double width = view.xmax - view.xmin, height = view.ymax - view.ymin;
  const bool finite =
      std::isfinite(view.xmin) && std::isfinite(view.ymin) && std::isfinite(width) && std::isfinite(height);
  if (!finite || !(width > 0) || !(height > 0)) {
    return refusePicture(
        fmt::format("the view {},{},{},{} is not a rectangle with xmin < xmax and ymin < ymax", view.xmin,
                    view.ymin, view.xmax, view.ymax));
  }
  const double longer = std::max(domain.xmax - domain.xmin, domain.ymax - domain.ymin);
  // Another error reports what is wrong with the domain.
  if (!(longer > 0) || !std::isfinite(longer)) return {};
  const PictureFrame frame = shownFrame(options);
  const double pixel = std::min(width / frame.width, height / frame.height);
  if (pixel < least_pixel * longer) {
    return refusePicture(
        fmt::format("the view {},{},{},{} is too small: a pixel of it must be at least {:.0e} of the "
                    "domain's longer side, and is {:.1e}",
                    view.xmin, view.ymin, view.xmax, view.ymax, least_pixel, pixel / longer));
  }
  const double farthest =
      std::max({width, height, std::abs(view.xmin - domain.xmin), std::abs(view.ymin - domain.ymin)});
  if (!(farthest <= largest_view * longer)) {
    return refusePicture(
        fmt::format("the view {},{},{},{} is too large or too far from the domain: {:.0e} of its "
                    "longer side at most",
                    view.xmin, view.ymin, view.xmax, view.ymax, largest_view));
  }
  return {};
}

Result<void> checkPicture(const RenderOptions& options) {
  if (std::min(options.width, options.height) < 1 || std::max(options.width, options.height) > largest_side) {
    return refusePicture(fmt::format("a picture of {}x{} pixels: each side must be 1 to {}", options.width,
                                     options.height, largest_side));
  }
  if (options.legend && !options.legend_beside &&
      (options.width < least_with_legend.width || options.height < least_with_legend.height)) {
    return refusePicture(fmt::format("legend: a picture of {}x{} pixels has no room for it, {}x{} has",
                                     options.width, options.height, least_with_legend.width,
                                     least_with_legend.height));
  }
  if (options.legend && !options.fill) return refusePicture("legend: cells without fill have no colors");
  if (options.graticule > 0 && !options.globe) return refusePicture("graticule: is of the globe");
  if (options.edge_color && !options.edge_color->isOpaque()) {
    return refusePicture(fmt::format("edge color {}: must be opaque", textOf(*options.edge_color)));
  }
  Result<void> checked;
  const auto check = [&](const auto& row) {
    if constexpr (requires { row.least; }) {
      const auto value = options.*row.member;
      if (!checked || (value >= row.least && value <= row.most)) return;
      checked = refusePicture(fmt::format("{} {}: must be {} to {}{}", nameWith(' ', row.name), value,
                                          row.least, row.most, row.unit));
    }
  };
  forEachRow(picture_rows, check);
  if (!checked) return checked;
  return checkView(options);
}

}  // namespace vorpipe


#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "vorpipe.h"

namespace vorpipe {
namespace {

/// Returns the first of `count` steps for which `is` holds, by bisection: it holds from there to the end.
/// Returns `count` if it never does.
int firstThat(int count, const std::function<bool(int)>& is) {
  int low = 0, high = count;
  while (low < high) {
    const int middle = low + (high - low) / 2;
    if (is(middle)) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  return low;
}

struct Steps {
  int first = 0, count = 0;
};

/// Returns the pixels along an axis whose centers lie between `low` and `high`, both relative to the first
/// pixel's start. There are `count` pixels with the total length `length`.
Steps centersBetween(double low, double high, double length, int count) {
  const auto centerOf = [&](int step) { return (step + 0.5) / count * length; };
  const int first = firstThat(count, [&](int step) { return centerOf(step) >= low; });
  const int end = firstThat(count, [&](int step) { return centerOf(step) > high; });
  return {first, std::max(0, end - first)};
}

}  // namespace

const Box& shownBox(const RenderOptions& options) { return options.view ? *options.view : options.domain; }

PictureFrame shownFrame(const RenderOptions& options) {
  return frameOf(shownBox(options), options.width, options.height, options.fit);
}

PictureFrame domainFrame(const RenderOptions& options) {
  const PictureFrame frame = shownFrame(options);
  if (!options.view) return frame;
  const Box &view = *options.view, &domain = options.domain;
  const Steps columns =
      centersBetween(domain.xmin - view.xmin, domain.xmax - view.xmin, view.xmax - view.xmin, frame.width);
  const Steps rows =
      centersBetween(view.ymax - domain.ymax, view.ymax - domain.ymin, view.ymax - view.ymin, frame.height);
  if (columns.count == 0 || rows.count == 0) return {frame.left, frame.top, 0, 0};
  return {frame.left + columns.first, frame.top + rows.first, columns.count, rows.count};
}

Result<void> checkView(const RenderOptions& options) {
  if (!options.view) return {};
  const auto refuse = [](std::string message) {
    return tl::unexpected(Error{ErrorCode::input, std::move(message)});
  };
  const Box &view = *options.view, &domain = options.domain;
  const double width = view.xmax - view.xmin, height = view.ymax - view.ymin;
  const bool finite =
      std::isfinite(view.xmin) && std::isfinite(view.ymin) && std::isfinite(width) && std::isfinite(height);
  if (!finite || !(width > 0) || !(height > 0)) {
    return refuse(fmt::format("the view {},{},{},{} is not a rectangle with xmin < xmax and ymin < ymax",
                              view.xmin, view.ymin, view.xmax, view.ymax));
  }
  const double longer = std::max(domain.xmax - domain.xmin, domain.ymax - domain.ymin);
  // Another error reports what is wrong with the domain.
  if (!(longer > 0) || !std::isfinite(longer)) return {};
  const PictureFrame frame = shownFrame(options);
  const double pixel = std::min(width / frame.width, height / frame.height);
  if (pixel < least_pixel * longer) {
    return refuse(
        fmt::format("the view {},{},{},{} is too small: a pixel of it must be at least {:.0e} of the "
                    "domain's longer side, and is {:.1e}",
                    view.xmin, view.ymin, view.xmax, view.ymax, least_pixel, pixel / longer));
  }
  const double farthest =
      std::max({width, height, std::abs(view.xmin - domain.xmin), std::abs(view.ymin - domain.ymin)});
  if (!(farthest <= largest_view * longer)) {
    return refuse(
        fmt::format("the view {},{},{},{} is too large or too far from the domain: {:.0e} of its "
                    "longer side at most",
                    view.xmin, view.ymin, view.xmax, view.ymax, largest_view));
  }
  return {};
}

}  // namespace vorpipe

#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <utility>

#include "vorpipe.h"

namespace vorpipe {

Result<void> checkPicture(const RenderOptions& options) {
  const auto refuse = [](std::string message) {
    return tl::unexpected(Error{ErrorCode::input, std::move(message)});
  };
  if (std::min(options.width, options.height) < 1 || std::max(options.width, options.height) > largest_side) {
    return refuse(fmt::format("a picture of {}x{} pixels: each side must be 1 to {}", options.width,
                              options.height, largest_side));
  }
  if (options.legend &&
      (options.width < least_with_legend.width || options.height < least_with_legend.height)) {
    return refuse(fmt::format("legend: a picture of {}x{} pixels has no room for it, {}x{} has",
                              options.width, options.height, least_with_legend.width,
                              least_with_legend.height));
  }
  constexpr double widest = 100;
  if (!(options.edge_width >= 1 && options.edge_width <= widest)) {
    return refuse(fmt::format("edge width {}: must be 1 to {} pixels", options.edge_width, widest));
  }
  if (options.legend && !options.fill) return refuse("legend: cells without fill have no colors");
  if (!(options.dot_size >= 0 && options.dot_size <= widest)) {
    return refuse(fmt::format("dot size {}: must be 0 to {} pixels", options.dot_size, widest));
  }
  constexpr int most_places = 8;
  if (options.antialias < 1 || options.antialias > most_places) {
    return refuse(fmt::format("antialias {}: must be 1 to {}", options.antialias, most_places));
  }
  constexpr double least_label = 5, largest_label = 200;
  if (!(options.label_size >= least_label && options.label_size <= largest_label)) {
    return refuse(fmt::format("label size {}: must be {} to {} pixels", options.label_size, least_label,
                              largest_label));
  }
  return checkView(options);
}

}  // namespace vorpipe

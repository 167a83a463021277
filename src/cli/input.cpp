#include "cli/input.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "cli/progress.h"
#include "io/error.h"
#include "io/outline_file.h"
#include "io/site_source.h"
#include "io/weights_file.h"

namespace vorpipe::cli {
namespace {

constexpr int default_longer_side = 1000;
/// Color and id: on the device (whose memory is this machine's when it is software), and read back.
constexpr std::uint64_t bytes_per_pixel_drawing = 16;
constexpr std::uint64_t bytes_per_pixel_kept = 8;

std::uint64_t physicalMemory() {
  const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
  if (pages <= 0 || page <= 0) return std::numeric_limits<std::uint64_t>::max();
  return static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page);
}

Result<void> forecast(std::string_view option, std::uint64_t bytes) {
  constexpr double gigabyte = 1e9;
  const std::uint64_t memory = physicalMemory();
  if (bytes <= memory) return {};
  return inputError(fmt::format("{}: needs about {:.1f} GB of memory, this machine has {:.1f} GB", option,
                                static_cast<double>(bytes) / gigabyte,
                                static_cast<double>(memory) / gigabyte));
}

Box boxOf(std::span<const Point> points) {
  const auto [left, right] = std::ranges::minmax(points, {}, &Point::x);
  const auto [low, high] = std::ranges::minmax(points, {}, &Point::y);
  return {left.x, low.y, right.x, high.y};
}

Result<void> takeWeights(const InputOptions& options, Input& input) {
  const std::string_view option = options.random_weights ? "--random-weights" : "--weights";
  if (!options.random_weights && options.weights.empty()) return {};
  if (!input.sites.weight.empty()) {
    return inputError(fmt::format("{}: {} has weights of its own", option, options.sites));
  }
  if (options.random_weights) {
    if (!input.seed) {
      return inputError(fmt::format("{}: is for generators; give {} its weights by --weights or a column",
                                    option, options.sites));
    }
    const auto [low, high] = *options.random_weights;
    input.sites.weight = randomWeights(low, high, input.sites.size(), *input.seed);
    return {};
  }
  auto weights = readWeights(options.weights, input.sites.size());
  if (!weights) return named(option, std::move(weights.error()));
  input.sites.weight = std::move(*weights);
  return {};
}

/// The least square around the box, with the same center.
Box squareAround(const Box& box) {
  const double width = box.xmax - box.xmin, height = box.ymax - box.ymin;
  const double grown = (std::max(width, height) - std::min(width, height)) / 2;
  return width < height ? Box{box.xmin - grown, box.ymin, box.xmax + grown, box.ymax}
                        : Box{box.xmin, box.ymin - grown, box.xmax, box.ymax + grown};
}

/// A periodic domain takes images of sites, and polygons whether they are wanted or not.
Result<void> forecastImages(const Input& input, std::uint64_t bytes_per_site) {
  constexpr std::uint64_t bytes_of_images = 60;
  if (input.periodic == Periodic::none) return {};
  const auto count = sitesAndImages(input.sites, input.domain, input.periodic);
  if (!count) return tl::unexpected(count.error());
  const auto bytes = std::max(bytes_per_site, bytesPerSite(Detail::polygons)) + bytes_of_images;
  return forecast("--periodic", *count * bytes);
}

Result<void> takeOutline(const InputOptions& options, Input& input) {
  auto outline = readOutline(options.domain.file);
  if (!outline) return named("--domain", std::move(outline.error()));
  if (input.periodic != Periodic::none) {
    return inputError("--periodic: a domain with an outline does not repeat itself");
  }
  input.outline = std::move(*outline);
  input.domain = boxOf(input.outline.points);
  if (input.seed) {
    // A square keeps the shapes of the patterns.
    const Box square = squareAround(input.domain);
    for (double& x : input.sites.x) x = square.xmin + x * (square.xmax - square.xmin);
    for (double& y : input.sites.y) y = square.ymin + y * (square.ymax - square.ymin);
  }
  return {};
}

Result<void> takeDomain(const InputOptions& options, Input& input) {
  if (!options.domain.file.empty()) return takeOutline(options, input);
  if (options.domain.box) {
    input.domain = *options.domain.box;
  } else if (!input.seed) {
    input.domain = domainOfSites(input.sites);
    const Box& box = input.domain;
    if (!std::isfinite(box.xmax - box.xmin) || !std::isfinite(box.ymax - box.ymin)) {
      return inputError("--domain: the sites reach too far for a default, name what to draw");
    }
  }
  return {};
}

}  // namespace

Result<Input> loadInput(const InputOptions& options, std::uint64_t bytes_per_site) {
  const Stopwatch watch;
  const std::uint64_t generated = generatedCount(options.sites).value_or(0);
  if (const auto enough = forecast("--sites", generated * bytes_per_site); !enough) {
    return tl::unexpected(enough.error());
  }
  auto source = loadSites(options.sites, options.seed);
  if (!source) return named("--sites", std::move(source.error()));
  if (const auto enough = forecast("--sites", source->sites.size() * bytes_per_site); !enough) {
    return tl::unexpected(enough.error());
  }
  Input input;
  input.sites = std::move(source->sites);
  input.seed = source->seed;
  input.periodic = options.periodic;
  if (auto taken = takeWeights(options, input); !taken) return tl::unexpected(std::move(taken.error()));
  if (auto taken = takeDomain(options, input); !taken) return tl::unexpected(std::move(taken.error()));
  if (auto enough = forecastImages(input, bytes_per_site); !enough) return tl::unexpected(enough.error());
  input.read_ms = watch.milliseconds();
  return input;
}

tl::unexpected<Error> named(std::string_view option, Error error) {
  if (error.code == ErrorCode::input) error.message.insert(0, fmt::format("{}: ", option));
  return tl::unexpected(std::move(error));
}

tl::unexpected<Error> asOption(Error error) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 3> options = {
      {{"outline: ", "--domain: "}, {"density: ", "--density: "}, {"search by FLANN: ", "--search: "}}};
  for (const auto& [what, option] : options) {
    if (error.message.starts_with(what)) error.message.replace(0, what.size(), option);
  }
  return tl::unexpected(std::move(error));
}

Box domainOfSites(const Sites& sites) {
  const auto [xmin, xmax] = std::ranges::minmax(sites.x);
  const auto [ymin, ymax] = std::ranges::minmax(sites.y);
  const double longer = std::max(xmax - xmin, ymax - ymin);
  double grown = longer > 0 ? 0.05 * longer : 0.5;
  // Far from the origin so little may be less than a coordinate can tell; a few thousand steps are not.
  const double largest = std::max({std::abs(xmin), std::abs(xmax), std::abs(ymin), std::abs(ymax)});
  const double step = largest - std::nextafter(largest, 0.0);
  grown = std::max(grown, 4096 * step);
  return Box{xmin - grown, ymin - grown, xmax + grown, ymax + grown};
}

Size defaultSize(const Box& domain) {
  const double width = domain.xmax - domain.xmin, height = domain.ymax - domain.ymin;
  const auto shorter = [](double part) {
    return std::max(1, static_cast<int>(std::lround(part * default_longer_side)));
  };
  if (width >= height) return Size{default_longer_side, shorter(height / width)};
  return Size{shorter(width / height), default_longer_side};
}

std::uint64_t bytesPerSite(Detail detail) {
  switch (detail) {
    case Detail::measures:
      return 250;
    case Detail::polygons:
      return 330;
    case Detail::everything:
      break;
  }
  return 350;
}

Result<void> forecastPicture(const Size& size, std::uint64_t pictures) {
  const auto pixels = static_cast<std::uint64_t>(size.width) * static_cast<std::uint64_t>(size.height);
  return forecast("--size", pixels * (bytes_per_pixel_drawing + pictures * bytes_per_pixel_kept));
}

}  // namespace vorpipe::cli

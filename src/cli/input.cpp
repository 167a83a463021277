#include "cli/input.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cli/progress.h"
#include "io/error.h"
#include "io/site_source.h"

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

}  // namespace

Result<Input> loadInput(const InputOptions& options, std::uint64_t bytes_per_site) {
  const Stopwatch watch;
  const std::uint64_t generated = generatedCount(options.sites).value_or(0);
  if (const auto enough = forecast("--sites", generated * bytes_per_site); !enough) {
    return tl::unexpected(enough.error());
  }
  auto source = loadSites(options.sites, options.seed);
  if (!source) {
    Error error = std::move(source.error());
    if (error.code == ErrorCode::input) error.message.insert(0, "--sites: ");
    return tl::unexpected(std::move(error));
  }
  if (const auto enough = forecast("--sites", source->sites.size() * bytes_per_site); !enough) {
    return tl::unexpected(enough.error());
  }
  Input input{std::move(source->sites), Box{0, 0, 1, 1}, source->seed, 0};
  if (options.domain) {
    input.domain = *options.domain;
  } else if (!input.seed) {
    input.domain = domainOfSites(input.sites);
    const Box& box = input.domain;
    if (!std::isfinite(box.xmax - box.xmin) || !std::isfinite(box.ymax - box.ymin)) {
      return inputError("--domain: the sites reach too far for a default, name what to draw");
    }
  }
  input.read_ms = watch.milliseconds();
  return input;
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

#include "cli/forecast.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <limits>

#include "io/error.h"

namespace vorpipe::cli {
namespace {

/// Color and id: on the device (whose memory is this machine's when it is software), and read back.
constexpr std::uint64_t bytes_per_pixel_drawing = 16, bytes_per_pixel_kept = 8;
/// By a mean cell: what a site takes while it is drawn, more for its weight, for a cell that an outline may
/// cut, and for an image.
constexpr std::uint64_t bytes_per_drawn_site = 250, bytes_per_weight = 30, bytes_per_clipped_cell = 220,
                        bytes_per_image = 60;

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

/// What one site takes at most while its cell is computed, by a mean cell.
std::uint64_t bytesPerCell(Detail detail) {
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

/// Whether cells are computed, and not only drawn.
bool hasCells(const Work& work, bool clipped, bool weighted) {
  return work.cells.has_value() || (work.draws && (clipped || weighted));
}

/// Outlines, images and masses take polygons, whether they are wanted or not.
std::uint64_t bytesPerSite(const Work& work, bool clipped, bool weighted, bool imaged) {
  std::uint64_t bytes = work.draws ? bytes_per_drawn_site : 0;
  if (hasCells(work, clipped, weighted)) {
    const Detail detail = work.cells.value_or(Detail::measures);
    const bool polygons = clipped || imaged || work.density;
    bytes = std::max(bytes, bytesPerCell(polygons ? std::max(detail, Detail::polygons) : detail));
    bytes += clipped ? bytes_per_clipped_cell : 0;
  }
  return bytes + (weighted ? bytes_per_weight : 0) + work.beside;
}

}  // namespace

Result<void> forecastSites(const Work& work, const InputOptions& options, std::uint64_t sites,
                           bool weighted) {
  const bool has_weights = weighted || options.random_weights || !options.weights.empty();
  return forecast("--sites", sites * bytesPerSite(work, !options.domain.file.empty(), has_weights, false));
}

Result<void> forecastImages(const Work& work, const Input& input, int threads) {
  if (input.periodic == Periodic::none) return {};
  const bool weighted = !input.sites.weight.empty(), cells = hasCells(work, false, weighted);
  const auto count = sitesAndImages(input.sites, input.domain, input.periodic,
                                    cells ? ImagesFor::cells : ImagesFor::pictures, threads);
  if (!count) return tl::unexpected(count.error());
  return forecast("--periodic", *count * (bytesPerSite(work, false, weighted, true) + bytes_per_image));
}

Result<void> forecastPicture(const Size& size, std::uint64_t pictures) {
  const auto pixels = static_cast<std::uint64_t>(size.width) * static_cast<std::uint64_t>(size.height);
  return forecast("--size", pixels * (bytes_per_pixel_drawing + pictures * bytes_per_pixel_kept));
}

}  // namespace vorpipe::cli

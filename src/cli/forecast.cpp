#include "cli/forecast.h"

#include <fmt/core.h>

#include <algorithm>
#include <functional>
#include <numeric>

#include "base/try.h"
#include "io/base/error.h"
#include "io/cells/forecast_files.h"
#include "io/sites/site_source.h"

namespace vorpipe::cli {
namespace {

std::string sizeText(std::uint64_t bytes) {
  constexpr double gigabyte = 1e9, megabyte = 1e6;
  const auto size = static_cast<double>(bytes);
  if (size < megabyte) return fmt::format("{} bytes", bytes);
  return size < gigabyte ? fmt::format("{:.0f} MB", size / megabyte)
                         : fmt::format("{:.1f} GB", size / gigabyte);
}

/// Returns the user's limit if it is the lower one, else the system's.
MemoryLimit limitOf(std::optional<std::uint64_t> limit) {
  MemoryLimit least = systemMemoryLimit();
  if (limit && *limit < least.bytes) least = {*limit, "allowed by --memory-limit"};
  return least;
}

std::uint64_t attributeBytes(const Input& input) {
  return std::transform_reduce(input.attributes.begin(), input.attributes.end(), std::uint64_t{0},
                               std::plus<>(), [](const Attribute& attribute) { return attribute.bytes(); });
}

bool hasWeights(const InputOptions& options) { return options.random_weights || !options.weights.empty(); }

/// Returns the peak of the whole run; `attributes` is in bytes.
std::uint64_t peakOf(const InputOptions& options, const Workload& work, const PlanRun& plan,
                     std::uint64_t attributes) {
  MemoryPlan whole;
  planSites(whole, options.sites, work.sites, work.weighted && !hasWeights(options));
  planAttributes(whole, attributes);
  if (hasWeights(options)) planWeights(whole, options.weights, work.sites);
  if (options.project) whole.take("the sites in degrees", work.sites * sizeof(double[2]));
  plan(whole, work);
  return whole.peak();
}

/// Returns what would fit, as the end of the message.
std::string adviceFor(const InputOptions& options, const Workload& work, const PlanRun& plan,
                      std::uint64_t attributes, std::uint64_t limit) {
  // Attributes scale with the number of sites.
  const auto needs = [&](const Workload& other) {
    const double part =
        work.sites == 0 ? 1 : static_cast<double>(other.sites) / static_cast<double>(work.sites);
    return peakOf(options, other, plan, static_cast<std::uint64_t>(part * static_cast<double>(attributes)));
  };
  Workload other = work;
  other.backend = "cpu";
  other.beside_drivers = false;
  if (work.device_on_host && (work.backend != "cpu" || work.beside_drivers) && needs(other) <= limit) {
    return fmt::format("--backend cpu needs {}", sizeText(needs(other)));
  }
  other = work;
  other.sites = other.images = 0;
  if (needs(other) > limit) return fmt::format("without any site it needs {}", sizeText(needs(other)));
  std::uint64_t fits = 0, fails = work.sites;
  while (fails - fits > fails / 100 + 1) {
    other.sites = fits + (fails - fits) / 2;
    const double part = static_cast<double>(other.sites) / static_cast<double>(work.sites);
    other.images = static_cast<std::uint64_t>(part * static_cast<double>(work.images));
    (needs(other) <= limit ? fits : fails) = other.sites;
  }
  return fmt::format("some {} sites would fit", fits);
}

Result<std::uint64_t> forecast(const InputOptions& options, const Workload& work, const PlanRun& plan,
                               std::uint64_t attributes, std::optional<std::uint64_t> user_limit,
                               std::string_view advice) {
  const auto bytes = peakOf(options, work, plan, attributes);
  const MemoryLimit limit = limitOf(user_limit);
  if (bytes <= limit.bytes) return bytes;
  return inputError(fmt::format("--sites: {}; {}{}", *lackOfMemory(bytes, user_limit),
                                adviceFor(options, work, plan, attributes, limit.bytes), advice));
}

/// Returns the peak of a run in tiles of `tile` sites.
std::uint64_t peakInTiles(const InputOptions& options, const Workload& work, std::uint64_t mapped_bytes,
                          std::uint64_t tile) {
  MemoryPlan whole;
  if (mapped_bytes > 0) {
    whole.take("the mapped file", mapped_bytes);
  } else {
    planSites(whole, options.sites, work.sites, false);
  }
  planTiles(whole, work, tile);
  return whole.peak();
}

}  // namespace

void planTiles(MemoryPlan& plan, const Workload& work, std::uint64_t tile_sites) {
  constexpr std::uint64_t word = 4, number = 8, sites_of_cell = 128;
  Workload tile = work;
  tile.sites = std::min(work.sites, tile_sites);
  tile.images = 0;
  planSession(plan, tile);
  plan.take("areas, centroids and numbers of neighbors", work.sites * (3 * number + word + 1));
  plan.take("sites by cells of a lattice", work.sites * word);
  // Counts of eight threads, where cells begin, sums, and those of few sites.
  plan.take("sites by cells of a lattice", (work.sites / sites_of_cell + 1) * (9 * word + number));
  plan.take("the sites of a tile", tile.sites * (2 * number + 3 * word + 2 * number + 2));
  const auto cells = plan.take("cells of a tile for the run", tile.sites * (4 * number + word));
  planCells(plan, tile, Detail::measures);
  plan.drop(cells);
}

Result<TileSizes> forecastTiles(const InputOptions& options, std::uint64_t sites, std::uint64_t mapped_bytes,
                                const DeviceInfo& device, const BackendOptions& backend,
                                std::optional<std::uint64_t> limit) {
  Workload work;
  work.sites = sites;
  work.backend = device.backend;
  work.device_on_host = device.type == "cpu";
  work.beside_drivers = device.beside_drivers;
  work.threads = backend.threads;
  const auto peak = [&](std::uint64_t tile) { return peakInTiles(options, work, mapped_bytes, tile); };
  const auto fits = [&](std::uint64_t tile) { return !lackOfMemory(peak(tile), limit); };
  TileSizes sizes{usual_tile, usual_tile, 0};
  while (sizes.usual > least_tile && !fits(sizes.usual)) sizes.usual /= 2;
  sizes.forecast = peak(sizes.usual);
  if (const auto lack = lackOfMemory(sizes.forecast, limit)) {
    return inputError(fmt::format("--sites: in tiles, too, {}", *lack));
  }
  sizes.most = sizes.usual;
  while (sizes.most < sites && fits(2 * sizes.most)) sizes.most *= 2;
  return sizes;
}

std::optional<std::string> lackOfMemory(std::uint64_t bytes, std::optional<std::uint64_t> limit) {
  const MemoryLimit least = limitOf(limit);
  if (bytes <= least.bytes) return std::nullopt;
  return fmt::format("needs about {} of memory, {} are {}", sizeText(bytes), sizeText(least.bytes),
                     least.what);
}

Result<void> forecastGenerated(const InputOptions& options, const PlanRun& plan,
                               std::optional<std::uint64_t> limit, std::string_view advice) {
  const auto sites = generatedCount(options.sites);
  if (!sites) return {};
  Workload work;
  work.sites = *sites;
  work.weighted = hasWeights(options);
  work.outlined = options.domain.hull || !options.domain.file.empty();
  work.periodic = options.periodic.any();
  work.globe = options.globe;
  return forecast(options, work, plan, 0, limit, advice).map([](std::uint64_t) {});
}

Result<std::uint64_t> forecastRun(const InputOptions& options, const Input& input, ImagesFor purpose,
                                  const DeviceInfo& device, const BackendOptions& backend,
                                  const PlanRun& plan, std::optional<std::uint64_t> limit,
                                  std::string_view advice) {
  CellsOptions cells{};
  cells.domain = input.domain;
  cells.outline = input.outline;
  cells.periodic = input.periodic;
  cells.globe = input.globe;
  VORPIPE_LET(work, workloadOf(input.sites, cells, purpose, device, backend.threads));
  return forecast(options, work, plan, attributeBytes(input), limit, advice);
}

}  // namespace vorpipe::cli

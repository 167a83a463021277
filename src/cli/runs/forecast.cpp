#include "cli/runs/forecast.h"

#include <fmt/core.h>

#include <algorithm>
#include <functional>
#include <numeric>

#include "io/files/error.h"
#include "io/forecast/forecast_files.h"
#include "io/sites/site_source.h"

namespace vorpipe::cli {
namespace {

std::string sizeText(std::uint64_t bytes) {
  constexpr double gigabyte = 1e9, megabyte = 1e6;
  const auto size = static_cast<double>(bytes);
  return size < gigabyte ? fmt::format("{:.0f} MB", size / megabyte)
                         : fmt::format("{:.1f} GB", size / gigabyte);
}

/// What the user has set, else what the system has.
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

/// The whole run; `attributes` are bytes.
std::uint64_t peakOf(const InputOptions& options, const Workload& work, const PlanRun& plan,
                     std::uint64_t attributes) {
  MemoryPlan whole;
  planSites(whole, options.sites, work.sites, work.weighted && !hasWeights(options));
  planAttributes(whole, attributes);
  if (hasWeights(options)) planWeights(whole, options.weights, work.sites);
  plan(whole, work);
  return whole.peak();
}

/// What would fit, in words that end the message.
std::string adviceFor(const InputOptions& options, const Workload& work, const PlanRun& plan,
                      std::uint64_t attributes, std::uint64_t limit) {
  // Fewer sites have fewer of them.
  const auto needs = [&](const Workload& other) {
    const double part =
        work.sites == 0 ? 1 : static_cast<double>(other.sites) / static_cast<double>(work.sites);
    return peakOf(options, other, plan, static_cast<std::uint64_t>(part * static_cast<double>(attributes)));
  };
  Workload other = work;
  other.backend = "cpu";
  if (work.device_on_host && work.backend != "cpu" && needs(other) <= limit) {
    return fmt::format("--backend cpu needs {}", sizeText(needs(other)));
  }
  other = work;
  other.sites = other.images = 0;
  if (needs(other) > limit) return "a smaller --size, or another backend, needs less";
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
                               std::uint64_t attributes, std::optional<std::uint64_t> user_limit) {
  const auto bytes = peakOf(options, work, plan, attributes);
  const MemoryLimit limit = limitOf(user_limit);
  if (bytes <= limit.bytes) return bytes;
  return inputError(fmt::format("--sites: {}; {}", *lackOfMemory(bytes, user_limit),
                                adviceFor(options, work, plan, attributes, limit.bytes)));
}

}  // namespace

std::optional<std::string> lackOfMemory(std::uint64_t bytes, std::optional<std::uint64_t> limit) {
  const MemoryLimit least = limitOf(limit);
  if (bytes <= least.bytes) return std::nullopt;
  return fmt::format("needs about {} of memory, {} are {}", sizeText(bytes), sizeText(least.bytes),
                     least.what);
}

Result<void> forecastGenerated(const InputOptions& options, const PlanRun& plan,
                               std::optional<std::uint64_t> limit) {
  const auto sites = generatedCount(options.sites);
  if (!sites) return {};
  Workload work;
  work.sites = *sites;
  work.weighted = hasWeights(options);
  work.outlined = !options.domain.file.empty();
  work.periodic = options.periodic != Periodic::none;
  return forecast(options, work, plan, 0, limit).map([](std::uint64_t) {});
}

Result<std::uint64_t> forecastRun(const InputOptions& options, const Input& input, ImagesFor purpose,
                                  const DeviceInfo& device, const BackendOptions& backend,
                                  const PlanRun& plan, std::optional<std::uint64_t> limit) {
  CellsOptions cells{};
  cells.domain = input.domain;
  cells.outline = input.outline;
  cells.periodic = input.periodic;
  const auto work = workloadOf(input.sites, cells, purpose, device, backend.threads);
  if (!work) return tl::unexpected(work.error());
  return forecast(options, *work, plan, attributeBytes(input), limit);
}

}  // namespace vorpipe::cli

#include "cli/drawn_input.h"

#include <fmt/format.h>

#include <string_view>
#include <utility>

#include "base/try.h"
#include "io/base/error.h"
#include "io/sites/sites_file.h"
#include "vorpipe/stipple.h"

namespace vorpipe::cli {
namespace {

constexpr std::string_view prefix = "density:";

}  // namespace

Result<std::optional<std::uint64_t>> drawnCount(const InputOptions& options) {
  const std::string_view text = options.sites;
  if (!text.starts_with(prefix)) return std::nullopt;
  const auto count = parseWhole(text.substr(prefix.size()), 1, max_sites);
  if (!count) return inputError(fmt::format("--sites: {}: {}", text, count.error()));
  return *count;
}

Result<InputOptions> asGenerator(const InputOptions& options, std::uint64_t count, const Density& density) {
  if (density.values.empty()) {
    return inputError(
        fmt::format("--sites: {} draws sites from a density; name it by --density", options.sites));
  }
  if (options.domain.hull) {
    return inputError(
        fmt::format("--domain: {} draws sites in a domain, and so has no hull before it", options.sites));
  }
  InputOptions generator = options;
  generator.sites = fmt::format("random:{}", count);
  if (!options.domain.box && options.domain.file.empty()) {
    generator.domain.box = density.box.value_or(
        Box{0, 0, static_cast<double>(density.width), static_cast<double>(density.height)});
  }
  return generator;
}

Result<void> drawSites(Input& input, const Density& density, const InputOptions& options) {
  auto drawn = drawnFrom(density, input.domain, input.outline, input.sites.size(), options.seed);
  if (!drawn) return asOption(std::move(drawn.error()), options);
  input.sites.x = std::move(drawn->x);
  input.sites.y = std::move(drawn->y);
  return {};
}

Result<Input> inputUnder(const DensityFile& given, const DensityOptions& from, InputOptions& options,
                         const PlanRun& plan, std::optional<std::uint64_t> memory_limit) {
  const Density& density = given.density;
  const auto drawn = drawnCount(options);
  if (!drawn) return tl::unexpected(drawn.error());
  if (*drawn) {
    auto generator = asGenerator(options, **drawn, density);
    if (!generator) return tl::unexpected(std::move(generator.error()));
    options = std::move(*generator);
  }
  const auto fits = forecastGenerated(options, plan, memory_limit);
  if (!fits) return tl::unexpected(fits.error());
  auto input = loadInput(options);
  if (!input) return input;
  VORPIPE_TRY(placeUnder(given, from, options, *input));
  if (*drawn) {
    VORPIPE_TRY(drawSites(*input, density, options));
  }
  return input;
}

}  // namespace vorpipe::cli

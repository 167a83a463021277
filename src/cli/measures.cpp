#include "cli/measures.h"

#include "base/parallel.h"
#include "base/stopwatch.h"

namespace vorpipe::cli {

bool canBeTiled(const InputOptions& options) {
  return !options.random_weights && options.weights.empty() && options.periodic == Periodic::none &&
         !options.domain.hull && options.domain.file.empty() && !options.project;
}

Result<TiledInput> loadTiled(const InputOptions& options, int threads) {
  const Stopwatch watch;
  if (options.sites.ends_with(".npy") && options.reading.columns.empty() && !options.reading.skip_missing) {
    auto mapped = MappedSites::map(options.sites, threads);
    if (!mapped) return named("--sites", std::move(mapped.error()));
    if (*mapped) {
      auto input = inputAround(options, (*mapped)->corners());
      if (!input) return tl::unexpected(std::move(input.error()));
      input->read_ms = watch.milliseconds();
      return TiledInput{std::move(*input), std::move(*mapped)};
    }
  }
  auto input = loadInput(options);
  if (!input) return tl::unexpected(std::move(input.error()));
  return TiledInput{std::move(*input), std::nullopt};
}

Measured::Measured(std::size_t sites) : area(sites), centroid(sites), neighbors(sites), status(sites) {}

CellsSink sinkOf(Measured& measured, int threads) {
  constexpr std::size_t grain = std::size_t{1} << 14;
  return [&measured, threads](std::span<const std::uint32_t> sites,
                              std::span<const CellMeasures> measures) -> Result<void> {
    parallelFor(sites.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
      for (auto k = begin; k < end; ++k) {
        const auto i = sites[k];
        const CellMeasures& cell = measures[k];
        measured.area[i] = cell.area;
        measured.centroid[i] = cell.centroid;
        measured.neighbors[i] = cell.neighbors;
        measured.status[i] = cell.status;
      }
    });
    return {};
  };
}

}  // namespace vorpipe::cli

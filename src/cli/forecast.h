/// Forecasts, before a run begins, whether it fits into memory.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

#include "cli/input.h"
#include "vorpipe.h"

namespace vorpipe::cli {

/// Plans the memory of a run besides its input: sessions, their results, checks and files.
using PlanRun = std::function<void(MemoryPlan&, const Workload&)>;

/// Error (input): a generator's sites will not fit on any device, or not into `limit` if given. Call before
/// the sites are made. `advice` ends the message.
Result<void> forecastGenerated(const InputOptions& options, const PlanRun& plan,
                               std::optional<std::uint64_t> limit, std::string_view advice = {});

/// Returns the peak memory, in bytes, of a run over this input on a device. `purpose` is what images are for.
/// Errors (input): more than available or than `limit`, in a message that ends with `advice`; those of
/// sitesAndImages.
Result<std::uint64_t> forecastRun(const InputOptions& options, const Input& input, ImagesFor purpose,
                                  const DeviceInfo& device, const BackendOptions& backend,
                                  const PlanRun& plan, std::optional<std::uint64_t> limit,
                                  std::string_view advice = {});

/// Sizes of the tiles of a run, and its memory with them.
struct TileSizes {
  std::uint64_t usual = 0, most = 0;  ///< as in TiledOptions
  std::uint64_t forecast = 0;         ///< bytes at the peak, with usual tiles
};

/// Plans the memory of a tiled run besides its sites: the part that lasts for all tiles, and that of one
/// tile.
void planTiles(MemoryPlan& plan, const Workload& work, std::uint64_t tile_sites);

/// Returns the largest worthwhile tiles that fit, for a run over `sites` sites. `mapped_bytes` of them are
/// mapped; 0: the sites are in memory. Error (input): no tile fits.
Result<TileSizes> forecastTiles(const InputOptions& options, std::uint64_t sites, std::uint64_t mapped_bytes,
                                const DeviceInfo& device, const BackendOptions& backend,
                                std::optional<std::uint64_t> limit);

/// Sites of a worthwhile tile, and of the smallest tile tried when memory is short.
inline constexpr std::uint64_t usual_tile = std::uint64_t{1} << 20, least_tile = std::uint64_t{1} << 13;

/// Returns why a run that needs `bytes` bytes does not fit into `limit` and the system's memory; nothing if
/// it fits.
std::optional<std::string> lackOfMemory(std::uint64_t bytes, std::optional<std::uint64_t> limit);

}  // namespace vorpipe::cli

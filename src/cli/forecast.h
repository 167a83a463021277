/// Whether a run fits into the memory that there is, told before it begins.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

#include "cli/input.h"
#include "vorpipe.h"

namespace vorpipe::cli {

/// Plans what a run takes beside its input: sessions, what they compute, checks and files.
using PlanRun = std::function<void(MemoryPlan&, const Workload&)>;

/// Refuses (input) the sites of a generator that will not fit whatever the device is, before they are made.
/// Where `limit` is given, that is the most. `advice` ends the message.
Result<void> forecastGenerated(const InputOptions& options, const PlanRun& plan,
                               std::optional<std::uint64_t> limit, std::string_view advice = {});

/// Bytes at the peak of a run over this input on a device. Errors (input): more than there are, or than
/// `limit`, in a message that `advice` ends; those of sitesAndImages. `purpose` is what images are for.
Result<std::uint64_t> forecastRun(const InputOptions& options, const Input& input, ImagesFor purpose,
                                  const DeviceInfo& device, const BackendOptions& backend,
                                  const PlanRun& plan, std::optional<std::uint64_t> limit,
                                  std::string_view advice = {});

/// How large the tiles of a run may be, and what it takes with them.
struct TileSizes {
  std::uint64_t usual = 0, most = 0;  ///< as TiledOptions has them
  std::uint64_t forecast = 0;         ///< bytes at the peak, with usual tiles
};

/// Plans a run in tiles beside its sites: what stays for all of them, and what a tile takes.
void planTiles(MemoryPlan& plan, const Workload& work, std::uint64_t tile_sites);

/// The largest tiles that fit, of those that are worth it, for a run over `sites` sites, of which
/// `mapped_bytes` are mapped, 0: they are in memory. Error (input): none fits.
Result<TileSizes> forecastTiles(const InputOptions& options, std::uint64_t sites, std::uint64_t mapped_bytes,
                                const DeviceInfo& device, const BackendOptions& backend,
                                std::optional<std::uint64_t> limit);

/// A tile that pays, and the least that is tried where there is less memory.
inline constexpr std::uint64_t usual_tile = std::uint64_t{1} << 20, least_tile = std::uint64_t{1} << 13;

/// Why a run that needs `bytes` bytes does not fit into `limit` and the system's memory; nothing if it does.
std::optional<std::string> lackOfMemory(std::uint64_t bytes, std::optional<std::uint64_t> limit);

}  // namespace vorpipe::cli

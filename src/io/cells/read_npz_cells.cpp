#include "io/cells/read_npz_cells.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "base/try.h"
#include "io/base/error.h"

namespace vorpipe {
namespace {

/// What cells in the plane and in space have in common.
struct CommonArrays {
  std::vector<Status> status;
  std::vector<std::uint32_t> owner;
  std::vector<double> measure;
  std::vector<std::uint64_t> offsets;
  std::vector<std::int64_t> neighbors;
};

/// Reads them; `owner` and `measure` are the names of two arrays.
Result<CommonArrays> readCommon(const NpzFile& file, const char* owner, const char* measure) {
  const auto wrong = [&file](std::string_view what) {
    return inputError(fmt::format("{}: {}", file.name(), what));
  };
  for (const char* const name : {"status", owner, measure, "neighbor_offsets", "neighbors"}) {
    if (!file.has(name))
      return wrong(fmt::format("has no array \"{}\", as cells with all of their parts", name));
  }
  CommonArrays arrays;
  VORPIPE_LET(status, file.numbers<std::uint8_t>("status"));
  VORPIPE_VAR(owners, file.numbers<std::uint32_t>(owner));
  VORPIPE_VAR(measures, file.numbers<double>(measure));
  VORPIPE_VAR(offsets, file.numbers<std::uint64_t>("neighbor_offsets"));
  VORPIPE_VAR(neighbors, file.numbers<std::int64_t>("neighbors"));
  const std::size_t n = status.size();
  const bool fits = owners.size() == n && measures.size() == n && offsets.size() == n + 1 &&
                    offsets.front() == 0 && std::ranges::is_sorted(offsets) &&
                    offsets.back() == neighbors.size();
  if (!fits) return wrong("its arrays do not fit each other");
  for (const std::uint8_t each : status) {
    if (each > static_cast<std::uint8_t>(Status::duplicate))
      return wrong(fmt::format("{} is no status", each));
    arrays.status.push_back(static_cast<Status>(each));
  }
  arrays.owner = std::move(owners);
  arrays.measure = std::move(measures);
  arrays.offsets = std::move(offsets);
  arrays.neighbors = std::move(neighbors);
  return arrays;
}

}  // namespace

bool hasSpaceCells(const NpzFile& file) { return file.has("volumes"); }

Result<Diagram> readNpzCells(const NpzFile& file) {
  VORPIPE_VAR(arrays, readCommon(file, "owners", "areas"));
  VORPIPE_LET(shifts, file.numbers<std::int32_t>("neighbor_shifts", 2));
  if (!shifts.empty() && shifts.size() != 2 * arrays.neighbors.size())
    return inputError(fmt::format("{}: neighbor_shifts does not fit neighbors", file.name()));
  Diagram diagram;
  for (std::size_t k = 0; k < shifts.size(); k += 2)
    diagram.neighbor_shifts.push_back({shifts[k], shifts[k + 1]});
  diagram.status = std::move(arrays.status);
  diagram.owner = std::move(arrays.owner);
  diagram.area = std::move(arrays.measure);
  diagram.cell_offsets = std::move(arrays.offsets);
  diagram.neighbors = std::move(arrays.neighbors);
  return diagram;
}

Result<Diagram3> readSpaceCells(const NpzFile& file) {
  VORPIPE_VAR(arrays, readCommon(file, "owner", "volumes"));
  Diagram3 diagram;
  diagram.status = std::move(arrays.status);
  diagram.owner = std::move(arrays.owner);
  diagram.volume = std::move(arrays.measure);
  diagram.face_offsets = std::move(arrays.offsets);
  diagram.neighbors = std::move(arrays.neighbors);
  return diagram;
}

}  // namespace vorpipe

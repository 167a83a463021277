/// Sites in space that `--sites` names: a generator or a file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/sites/sites_file.h"
#include "vorpipe.h"

namespace vorpipe {

struct SpaceTable {
  Sites3 sites;
  std::vector<double> weights{};        ///< as many, or none
  std::vector<Attribute> attributes{};  ///< in the file's order, each as long as the sites
  std::vector<std::string> notes{};     ///< what was reinterpreted or ignored: a line each
  std::optional<Box3> box{};            ///< that the file names
  bool generated = false;
};

/// The patterns that are of space whatever else is said, in the order in which messages name them.
std::vector<std::string_view> spacePatternNames();

/// Whether `spec` asks for one of them, or is a file of space by nature: by its extension, or an .xyz whose
/// second line is of an extended one.
bool isOfSpace(std::string_view spec);

/// Returns the N that `spec` asks a generator in space for; none if it names a file or is wrong.
std::optional<std::uint64_t> generatedInSpace(std::string_view spec);

/// Reads at least one site of a table: .csv, .tsv, .npy (N, 3) or (N, 4), .xyz or .txt, or of a file of
/// extensionsOfSpace(), with the box of its cell. A note says that a cell is not used because it is tilted,
/// or that it has periods. Errors: those of readSites, or the file is of another kind (input).
Result<SpaceTable> readSpaceSites(const std::string& path, const ReadOptions& options = {});

/// Reads or generates the sites of `spec`: PATTERN:N (random, jitter, clusters and spacePatternNames()) over
/// the box, else the unit cube; or what readSpaceSites takes. Errors: those of readSpaceSites, N is not a
/// number from 1 to max_sites (input), memory ran out (device).
Result<SpaceTable> loadSpaceSites(const std::string& spec, std::uint64_t seed,
                                  const ReadOptions& options = {}, const std::optional<Box3>& box = {});

}  // namespace vorpipe

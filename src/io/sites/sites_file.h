/// Reads sites from a file of any known kind.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/attribute.h"
#include "io/base/coordinate_system.h"
#include "vorpipe.h"

namespace vorpipe {

/// Most sites of one run: a neighbor is a signed 32-bit index.
inline constexpr std::uint64_t max_sites = std::numeric_limits<std::int32_t>::max();

/// An attribute that each row must have a value of, just as a position.
struct NeededAttribute {
  std::string name;
  std::function<tl::expected<void, std::string>(std::string_view)> check;  ///< what is wrong with a value
  bool unique = false;  ///< whether each site must have another value
};

/// What the third number of a site is.
enum class Third : std::uint8_t {
  weight,
  z,  ///< required: of sites in space, for readSpaceSites(); a fourth is the weight
};

/// How to read a file with sites, if the file does not define it.
struct ReadOptions {
  /// The kind of file by its extension, without the dot: "csv", "geojson". Empty: the path's own; "csv" for
  /// standard input.
  std::string format{};
  /// X,Y or X,Y,W, in space X,Y,Z or X,Y,Z,W: names in any case, or numbers from 1. One name: a column of WKT
  /// points. Empty: as in the header.
  std::vector<std::string> columns{};
  std::string layer{};        ///< of a GeoPackage; empty: its only one with points
  bool skip_missing = false;  ///< leaves out rows without a place, or with an empty weight, and counts them
  bool attributes = true;     ///< whether attributes are kept
  std::optional<NeededAttribute> needed{};  ///< if there is one of that name; it is kept
  Third third = Third::weight;
  /// Ends the note that a column named z is no place of a site in the plane; empty: there is no note.
  std::string advice_on_z{};
};

/// The cell of a simulation in space that a file names.
struct SimulationCell {
  Point3 origin{};
  std::array<Point3, 3> vectors{};
  std::array<bool, 3> periodic{};  ///< whether it repeats itself along each
};

struct SiteTable {
  Sites sites;
  std::vector<double> z{};              ///< of sites in space, else empty
  std::vector<Attribute> attributes{};  ///< in the file's order, each as long as the sites
  CoordinateSystem system{};
  std::optional<SimulationCell> cell{};
  std::uint64_t skipped = 0;         ///< rows that were left out
  std::vector<std::string> notes{};  ///< what was reinterpreted or ignored: a line each, with the file's name
};

/// The extensions of all kinds that may have sites in the plane, in the order in which messages name them.
std::vector<std::string_view> sitesExtensions();

/// Those of the other kinds, which are in space whatever else is said.
std::vector<std::string_view> extensionsOfSpace();

/// Reads at least one site. The path's extension, or the one before .gz, determines the kind of file; "-" is
/// standard input. Sites::weight is empty if the file has none. docs/formats.md lists the kinds. Errors: a
/// path, data or an option that is wrong for them, with file, line and column (input); reading failed or
/// memory ran out (device).
Result<SiteTable> readSites(const std::string& path, const ReadOptions& options = {});

}  // namespace vorpipe

/// Reads sites from an open file of one kind each. Errors: what is wrong with the data, with file, line and
/// column (input); reading failed or memory ran out (device).
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/input_file.h"
#include "io/base/wkt_tokens.h"
#include "io/sites/sites_file.h"
#include "io/sites/table_builder.h"
#include "vorpipe.h"

namespace vorpipe {

/// The values of a site in a row of only numbers, in order.
inline constexpr std::array<std::string_view, 3> site_numbers = {"x", "y", "weight"};
inline constexpr std::array<std::string_view, 4> space_numbers = {"x", "y", "z", "weight"};

/// All of them; the last is the weight, which a row may lack.
constexpr std::span<const std::string_view> namesOf(Third third) {
  return third == Third::z ? std::span<const std::string_view>(space_numbers) : site_numbers;
}

/// The note about unnamed columns as many as those numbers.
constexpr std::string_view lastIsWeight(Third third) {
  return third == Third::z ? "the fourth column is taken as weights; --columns 1,2,3 leaves it out"
                           : "the third column is taken as weights; --columns 1,2 leaves it out";
}

/// A table with a header that names its columns, or of only numbers. The first line determines the field
/// separator.
Result<SiteTable> readCsvSites(InputFile file, const ReadOptions& options);

/// The same, separated by tabs.
Result<SiteTable> readTsvSites(InputFile file, const ReadOptions& options);

/// Lines of x y or x y weight, in space of x y z or x y z weight, separated by blanks or commas; # begins a
/// comment. A first line without a number names the columns, as in .csv. In space also the .xyz of chemistry:
/// the number of sites, a comment, which may be that of an extended xyz, and lines of an element, x, y, z and
/// perhaps more.
Result<SiteTable> readTextSites(InputFile file, const ReadOptions& options);

/// An .xyz of chemistry, of which the first frame is read. Its comment may name the columns and the cell, as
/// Properties=species:S:1:pos:R:3 Lattice="..." pbc="T T F".
Result<SiteTable> readExtendedXyz(InputFile file, const ReadOptions& options);

/// Lines of id x y z or id x y z r, as Voro++ reads them.
Result<SiteTable> readVoroSites(InputFile file, const ReadOptions& options);

/// A text dump of LAMMPS, of which the first frame is read. Positions are x y z, else xu yu zu, xs ys zs or
/// xsu ysu zsu, in the file's order.
Result<SiteTable> readLammpsDump(InputFile file, const ReadOptions& options);

/// The section Atoms of a data file of LAMMPS, which names its style, as in "Atoms # full".
Result<SiteTable> readLammpsData(InputFile file, const ReadOptions& options);

/// NumPy array of shape (N, 2) or (N, 3), the third column being the weight, in space (N, 3) or (N, 4), of
/// numbers that areNumbers() takes.
Result<SiteTable> readNpySites(InputFile file, const ReadOptions& options);

/// GeoJSON (RFC 7946) of points: features, in a collection or single, or geometries. The whole is not kept in
/// memory.
Result<SiteTable> readGeoJsonSites(InputFile file, const ReadOptions& options);

/// GeoJSON features or geometries, one per line (RFC 8142, which puts a byte 0x1E before each; or NDJSON).
Result<SiteTable> readGeoJsonLines(InputFile file, const ReadOptions& options);

/// POINT and MULTIPOINT in well-known text, one after the other.
Result<SiteTable> readWktSites(InputFile file, const ReadOptions& options);

/// A layer of points of a GeoPackage, which is a database and no stream.
Result<SiteTable> readGeoPackageSites(const std::string& path, const ReadOptions& options);

/// A shapefile of points, which GDAL's ogr2ogr makes a GeoPackage of.
Result<SiteTable> readShapefileSites(const std::string& path, const ReadOptions& options);

/// A POINT or MULTIPOINT.
struct WktPoints {
  std::vector<Point> points;             ///< none if it is EMPTY
  bool others = false;                   ///< whether positions have more than x and y
  std::optional<std::int64_t> system{};  ///< the code before it
};

WktProblem takePoints(WktTokens& tokens, WktPoints& taken);

/// Sets attributes of a row to the properties of a GeoJSON feature, and to its id if no property is called
/// so.
void setProperties(AttributeColumns& attributes, const nlohmann::ordered_json& feature);

/// Returns the system that a member "crs" of the top object names, as in GeoJSON of 2008; else WGS 84.
tl::expected<CoordinateSystem, std::string> systemOfGeoJson(const nlohmann::ordered_json& top);

}  // namespace vorpipe

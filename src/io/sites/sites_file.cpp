#include "io/sites/sites_file.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <new>
#include <utility>

#include "base/try.h"
#include "io/base/coordinate_system.h"
#include "io/base/error.h"
#include "io/base/extension.h"
#include "io/base/input_file.h"
#include "io/base/shapefile.h"
#include "io/sites/sites_reader.h"

namespace vorpipe {
namespace {

struct Kind {
  std::string_view extension;
  Result<SiteTable> (*read)(InputFile file, const ReadOptions& options);
  bool table = false;     ///< whether its columns can be chosen
  bool of_space = false;  ///< whether its sites are in space by nature
};

/// The kind with layers. It is no stream of bytes, and neither are shapefiles.
constexpr std::string_view geopackage = ".gpkg";

constexpr std::array<Kind, 19> kinds = {{{".csv", readCsvSites, true},
                                         {".tsv", readTsvSites, true},
                                         {".xyz", readTextSites, true},
                                         {".txt", readTextSites, true},
                                         {".npy", readNpySites, true},
                                         {".geojson", readGeoJsonSites},
                                         {".json", readGeoJsonSites},
                                         {".geojsonl", readGeoJsonLines},
                                         {".geojsons", readGeoJsonLines},
                                         {".ndjson", readGeoJsonLines},
                                         {".wkt", readWktSites},
                                         {geopackage, nullptr},
                                         {shapefile_extension, nullptr},
                                         {".extxyz", readExtendedXyz, true, true},
                                         {".dump", readLammpsDump, true, true},
                                         {".lammpstrj", readLammpsDump, true, true},
                                         {".data", readLammpsData, true, true},
                                         {".lmp", readLammpsData, true, true},
                                         {".voro", readVoroSites, true, true}}};

std::vector<std::string_view> extensionsWhere(bool of_space) {
  std::vector<std::string_view> extensions;
  for (const Kind& kind : kinds) {
    if (kind.of_space == of_space) extensions.push_back(kind.extension);
  }
  return extensions;
}

Result<SiteTable> readByExtension(const std::string& path, InputFile file, const ReadOptions& options) {
  const std::string name = file.name();
  const std::string extension = !options.format.empty() ? "." + options.format
                                : path == "-"           ? ".csv"
                                                        : inputExtension(path);
  const auto* const kind = std::ranges::find(kinds, extension, &Kind::extension);
  if (kind == kinds.end()) {
    return inputError(
        fmt::format("{}: unknown kind of file; known are {}", name, fmt::join(sitesExtensions(), ", ")));
  }
  if (kind->of_space && options.third != Third::z) {
    return inputError(
        fmt::format("{}: a {} has sites in space, where there are `cells` alone", name, extension));
  }
  if (!options.columns.empty() && !kind->table) {
    return inputError(
        fmt::format("{}: its columns cannot be chosen: a {} has none for --columns", name, extension));
  }
  if (!options.layer.empty() && extension != geopackage) {
    return inputError(fmt::format("{}: has no layers for --layer; a {} has", name, geopackage));
  }
  if (kind->read != nullptr) return kind->read(std::move(file), options);
  const bool package = extension == geopackage;
  if (path != "-") return package ? readGeoPackageSites(path, options) : readShapefileSites(path, options);
  return inputError(fmt::format("{}: a {} cannot be read from standard input; name its file", name,
                                package ? "GeoPackage" : "shapefile"));
}

}  // namespace

std::vector<std::string_view> sitesExtensions() { return extensionsWhere(false); }

std::vector<std::string_view> extensionsOfSpace() { return extensionsWhere(true); }

Result<SiteTable> readSites(const std::string& path, const ReadOptions& options) {
  VORPIPE_VAR(file, InputFile::open(path));
  const std::string name = file.name();
  try {
    auto table = readByExtension(path, std::move(file), options);
    if (table && table->sites.size() == 0) {
      return inputError(fmt::format("{}: holds no sites{}", name,
                                    table->skipped > 0 ? ": what a site needs is missing in every row" : ""));
    }
    if (!table) return table;
    VORPIPE_TRY(readSystemBeside(path, table->system));
    return table;
  } catch (const std::bad_alloc&) {
    return deviceError(name + ": there is not enough memory for its sites");
  }
}

}  // namespace vorpipe

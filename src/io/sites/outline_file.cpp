#include "io/sites/outline_file.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <string_view>
#include <utility>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/extension.h"
#include "io/base/input_file.h"
#include "io/base/system_beside.h"
#include "io/sites/outline_reader.h"

namespace vorpipe {
namespace {

struct OutlineKind {
  std::string_view extension;
  Result<OutlineFile> (*read)(InputFile file);
};

/// The kind that is no stream of bytes.
constexpr std::string_view packaged = ".gpkg";

constexpr std::array<OutlineKind, 7> outline_kinds = {{{".geojson", readGeoJsonOutline},
                                                       {".json", readGeoJsonOutline},
                                                       {".geojsonl", readGeoJsonLinesOutline},
                                                       {".geojsons", readGeoJsonLinesOutline},
                                                       {".ndjson", readGeoJsonLinesOutline},
                                                       {".wkt", readWktOutline},
                                                       {packaged, nullptr}}};

Result<OutlineFile> readOutlineKind(const OutlineKind& kind, const std::string& path,
                                    const std::string& layer) {
  if (kind.extension == packaged) return readGeoPackageOutline(path, layer);
  if (!layer.empty()) return inputError(fmt::format("{}: has no layers; a {} has", path, packaged));
  auto file = InputFile::open(path);
  if (!file) return tl::unexpected(std::move(file.error()));
  return kind.read(std::move(*file));
}

/// Whether GeoJSON's coordinates may be degrees: the format has no others, but files may hold meters of a
/// plane.
bool mayBeDegrees(const Outline& outline) {
  constexpr double most_x = 360, most_y = 90;
  return std::ranges::all_of(
      outline.points, [](Point point) { return std::abs(point.x) <= most_x && std::abs(point.y) <= most_y; });
}

Result<OutlineFile> readByExtension(const std::string& path, const std::string& layer) {
  const auto* const kind = std::ranges::find(outline_kinds, inputExtension(path), &OutlineKind::extension);
  if (kind == outline_kinds.end()) {
    return inputError(
        fmt::format("{}: unknown kind of file; known are {}", path, fmt::join(outlineExtensions(), ", ")));
  }
  auto read = readOutlineKind(*kind, path, layer);
  if (!read) return read;
  if (read->outline.empty()) return inputError(path + ": holds no polygon");
  if (read->system.kind == CoordinateKind::degrees && !mayBeDegrees(read->outline)) read->system = {};
  VORPIPE_TRY(readSystemBeside(path, read->system));
  return read;
}

}  // namespace

tl::expected<void, std::string> addRing(std::vector<Point> points, Outline& outline) {
  const auto refuse = [](std::string what) { return tl::unexpected(std::move(what)); };
  constexpr std::size_t fewest = 4;
  if (points.size() < fewest) {
    return refuse(fmt::format("the ring has {} positions; it needs {} or more, the last like the first",
                              points.size(), fewest));
  }
  const Point first = points.front(), last = points.back();
  if (first.x != last.x || first.y != last.y) {
    return refuse(fmt::format("the ring is not closed: it begins at {} {} and ends at {} {}", first.x,
                              first.y, last.x, last.y));
  }
  if (outline.ring_offsets.empty()) {
    outline.ring_offsets.push_back(0);
    outline.polygon_offsets.push_back(0);
  }
  outline.points.insert(outline.points.end(), points.begin(), points.end() - 1);
  outline.ring_offsets.push_back(outline.points.size());
  return {};
}

void endPolygon(Outline& outline) {
  const std::size_t rings = outline.ring_offsets.empty() ? 0 : outline.ring_offsets.size() - 1;
  if (rings > 0 && rings > outline.polygon_offsets.back()) {
    outline.polygon_offsets.push_back(rings);
  }
}

std::vector<std::string> outlineExtensions() {
  std::vector<std::string> extensions;
  for (const OutlineKind& kind : outline_kinds) extensions.emplace_back(kind.extension);
  return extensions;
}

Result<OutlineFile> readOutline(const std::string& path, const std::string& layer) {
  try {
    return readByExtension(path, layer);
  } catch (const std::bad_alloc&) {
    return deviceError(path + ": there is not enough memory for its polygons");
  }
}

}  // namespace vorpipe

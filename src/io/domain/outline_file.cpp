#include "io/domain/outline_file.h"

#include <fmt/core.h>

#include <new>
#include <utility>

#include "io/domain/outline_reader.h"
#include "io/files/error.h"
#include "io/files/extension.h"
#include "io/files/input_file.h"

namespace vorpipe {
namespace {

Result<Outline> readByExtension(const std::string& path) {
  const std::string extension = inputExtension(path);
  const bool json = extension == ".geojson" || extension == ".json";
  if (!json && extension != ".wkt") {
    return inputError(path + ": unknown kind of file; known are .geojson, .json and .wkt");
  }
  auto file = InputFile::open(path);
  if (!file) {
    return tl::unexpected(file.error());
  }
  auto outline = json ? readGeoJsonOutline(*file) : readWktOutline(*file);
  if (outline && outline->empty()) {
    return inputError(path + ": holds no polygon");
  }
  return outline;
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

Result<Outline> readOutline(const std::string& path) {
  try {
    return readByExtension(path);
  } catch (const std::bad_alloc&) {
    return deviceError(path + ": there is not enough memory for its polygons");
  }
}

}  // namespace vorpipe

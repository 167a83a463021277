#include <fmt/core.h>

#include <cstdint>
#include <optional>
#include <utility>

#include "io/base/error.h"
#include "io/base/geojson_nesting.h"
#include "io/base/wkt_tokens.h"
#include "io/sites/outline_reader.h"

namespace vorpipe {
namespace {

class Wkt {
 public:
  explicit Wkt(InputFile& file) : tokens_(file) {}

  Result<OutlineFile> all() {
    while (!tokens_.atEnd()) {
      if (auto problem = geometry()) return tokens_.refused(*problem);
    }
    OutlineFile read{std::move(outline_)};
    if (system_ && *system_ > 0) read.system = systemOfCode(*system_);
    return tokens_.end().map([&] { return std::move(read); });
  }

 private:
  WktProblem geometry(int depth = 0) {
    const WktPlace begin = tokens_.place();
    std::optional<std::int64_t> code;
    if (auto problem = tokens_.takeSystem(code)) return problem;
    if (code && system_ && code != system_)
      return wrongAt(begin, fmt::format("is of SRID {}, and those before it of {}", *code, *system_));
    if (code) system_ = code;
    if (tokens_.takeType("MULTIPOLYGON")) return tokens_.takeList([&] { return polygon(); });
    if (tokens_.takeType("POLYGON")) return polygon();
    if (!tokens_.takeType("GEOMETRYCOLLECTION")) return tokens_.expected("POLYGON or MULTIPOLYGON");
    if (depth > most_nested_collections)
      return wrongAt(begin, fmt::format("stands in more than {} collections", most_nested_collections));
    return tokens_.takeList([&] { return geometry(depth + 1); });
  }

  WktProblem polygon() {
    auto problem = tokens_.takeList([&] { return ring(); });
    if (!problem) endPolygon(outline_);
    return problem;
  }

  WktProblem ring() {
    const WktPlace begin = tokens_.place();
    std::vector<Point> points;
    bool heights = false;
    const auto position = [&] { return tokens_.takePosition(points.emplace_back(), heights); };
    if (auto problem = tokens_.takeList(position)) return problem;
    const auto added = addRing(std::move(points), outline_);
    return added ? WktProblem{} : wrongAt(begin, added.error());
  }

  WktTokens tokens_;
  Outline outline_;
  std::optional<std::int64_t> system_;  ///< the code before geometries
};

}  // namespace

Result<OutlineFile> readWktOutline(InputFile file) { return Wkt(file).all(); }

}  // namespace vorpipe

#include <fmt/core.h>

#include <cstdint>
#include <optional>
#include <utility>

#include "io/domain/outline_reader.h"
#include "io/files/error.h"
#include "io/text/wkt_tokens.h"

namespace vorpipe {
namespace {

class Wkt {
 public:
  Wkt(InputFile& file, Outline& outline) : tokens_(file), outline_(outline) {}

  Result<void> all() {
    while (!tokens_.atEnd()) {
      if (auto problem = geometry()) return tokens_.refused(*problem);
    }
    return tokens_.end();
  }

 private:
  WktProblem geometry() {
    std::optional<std::int64_t> code;
    if (auto problem = tokens_.takeSystem(code)) return problem;
    if (tokens_.takeType("MULTIPOLYGON")) {
      return tokens_.takeList([&] { return polygon(); });
    }
    return tokens_.takeType("POLYGON") ? polygon() : tokens_.expected("POLYGON or MULTIPOLYGON");
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
  Outline& outline_;
};

}  // namespace

Result<Outline> readWktOutline(InputFile& file) {
  Outline outline;
  return Wkt(file, outline).all().map([&] { return std::move(outline); });
}

}  // namespace vorpipe

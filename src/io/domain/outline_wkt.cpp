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
  Wkt(std::string_view text, Outline& outline) : tokens_(text), outline_(outline) {}

  WktProblem all() {
    while (!tokens_.atEnd()) {
      if (auto problem = geometry()) return problem;
    }
    return {};
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
    const WktTokens begin = tokens_;
    std::vector<Point> points;
    bool heights = false;
    const auto position = [&] { return tokens_.takePosition(points.emplace_back(), heights); };
    if (auto problem = tokens_.takeList(position)) return problem;
    const auto added = addRing(std::move(points), outline_);
    return added ? WktProblem{} : begin.wrong(added.error());
  }

  WktTokens tokens_;
  Outline& outline_;
};

}  // namespace

Result<Outline> readWktOutline(const std::string& name, std::string_view text) {
  Outline outline;
  if (const auto problem = Wkt(text, outline).all()) {
    return inputError(fmt::format("{}:{}", name, *problem));
  }
  return outline;
}

}  // namespace vorpipe

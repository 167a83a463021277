#include "io/sites/wkt_points.h"

namespace vorpipe {

WktProblem takePoints(WktTokens& tokens, WktPoints& taken) {
  if (auto problem = tokens.takeSystem(taken.system)) return problem;
  const bool several = tokens.takeType("MULTIPOINT");
  if (!several && !tokens.takeType("POINT")) return tokens.expected("POINT or MULTIPOINT");
  const auto position = [&] { return tokens.takePosition(taken.points.emplace_back(), taken.others); };
  if (!several) {
    auto problem = tokens.takeList(position);
    if (!problem && taken.points.size() > 1)
      return tokens.wrong("a POINT of several positions ends before this");
    return problem;
  }
  // Each point may have parentheses of its own: (1 2, 3 4), ((1 2), (3 4)).
  const auto point = [&] {
    const std::size_t before = taken.points.size();
    auto problem = tokens.is("(") || tokens.is("EMPTY") ? tokens.takeList(position) : position();
    if (!problem && taken.points.size() > before + 1)
      return WktProblem(tokens.wrong("a point of several positions ends before this"));
    return problem;
  };
  return tokens.takeList(point);
}

CoordinateSystem systemOfCode(std::int64_t code) {
  // EPSG numbers what has longitude and latitude so, but for the one whose center is that of the Earth.
  constexpr std::int64_t first = 4001, last = 4999, geocentric = 4978;
  const bool degrees = code >= first && code <= last && code != geocentric;
  return {degrees ? CoordinateKind::degrees : CoordinateKind::plane, "EPSG", code, {}, {}};
}

}  // namespace vorpipe

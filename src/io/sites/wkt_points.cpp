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

}  // namespace vorpipe

#include "cli/difference_text.h"

#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace vorpipe::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string idText(std::uint32_t id) { return id == no_site ? "none" : fmt::format("{}", id); }

Json placeJson(const IdDifference& place) {
  return {{"row", place.row},
          {"column", place.column},
          {"a", place.a},
          {"b", place.b},
          {"distance_px", std::isfinite(place.distance) ? Json(place.distance) : Json(nullptr)}};
}

}  // namespace

std::string placeText(const IdDifference& place) {
  std::string text = fmt::format("row {}, column {}: sites {} and {}", place.row, place.column,
                                 idText(place.a), idText(place.b));
  if (std::isfinite(place.distance)) text += fmt::format(", {:.4g} px from their bisector", place.distance);
  return text;
}

std::string disagreementText(const IdDiff& diff) {
  if (diff.wrong == 0) {
    return fmt::format(
        "{} pixels whose centers lie on edges went to the other cell, where at most {} lie on any", diff.ties,
        diff.ties_allowed);
  }
  return fmt::format("{} pixels wrong ({} ties, {} equal), first at {}", diff.wrong, diff.ties, diff.equal,
                     placeText(diff.first.front()));
}

Json diffJson(const IdDiff& diff) {
  Json first = Json::array();
  for (const IdDifference& place : diff.first) first.push_back(placeJson(place));
  return {{"equal", diff.equal},
          {"ties", diff.ties},
          {"ties_allowed", diff.ties_allowed},
          {"widest_tie_px", diff.widest_tie},
          {"wrong", diff.wrong},
          {"first", std::move(first)},
          {"worst", diff.wrong > 0 ? placeJson(diff.worst) : Json(nullptr)}};
}

}  // namespace vorpipe::cli

#include "cli/difference.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "io/base/error.h"

namespace vorpipe::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint32_t opaque = 0xFF000000u;
constexpr std::uint32_t red = opaque | 0x000000FFu;
constexpr std::uint32_t yellow = opaque | 0x0000FFFFu;

std::uint32_t gray(std::uint32_t level) { return opaque | level << 16 | level << 8 | level; }

std::size_t at(int width, int row, int column) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
}

template <class Level>
Picture shaded(std::span<const std::uint32_t> values, int width, int height, const Level& level) {
  Picture picture{width, height, std::vector<std::uint32_t>(values.size())};
  std::ranges::transform(values, picture.rgba.begin(),
                         [&](std::uint32_t value) { return gray(level(value)); });
  return picture;
}

void paintSquare(Picture& picture, int row, int column, int radius, std::uint32_t color) {
  const int bottom = std::min(picture.height - 1, row + radius);
  const int right = std::min(picture.width - 1, column + radius);
  for (int r = std::max(0, row - radius); r <= bottom; ++r) {
    for (int c = std::max(0, column - radius); c <= right; ++c) picture.rgba[at(picture.width, r, c)] = color;
  }
}

std::string idText(std::uint32_t id) { return id == no_site ? "none" : fmt::format("{}", id); }

Json placeJson(const IdDifference& place) {
  return {{"row", place.row},
          {"column", place.column},
          {"a", place.a},
          {"b", place.b},
          {"distance_px", std::isfinite(place.distance) ? Json(place.distance) : Json(nullptr)}};
}

Json colorJson(std::uint32_t rgba) { return {rgba & 0xFF, rgba >> 8 & 0xFF, rgba >> 16 & 0xFF, rgba >> 24}; }

Json placeJson(const ColorDifference& place) {
  return {{"row", place.row}, {"column", place.column}, {"a", colorJson(place.a)}, {"b", colorJson(place.b)}};
}

template <class Place>
Json placesJson(const std::vector<Place>& places) {
  Json all = Json::array();
  for (const Place& place : places) all.push_back(placeJson(place));
  return all;
}

}  // namespace

Picture grayOfIds(std::span<const std::uint32_t> ids, int width, int height) {
  return shaded(ids, width, height, [](std::uint32_t id) {
    // Multiplied by the golden ratio of 2^32, consecutive ids get shades far apart.
    return id == no_site ? 0u : 48u + (id * 0x9E3779B9u >> 25) / 2;
  });
}

Picture grayOfColors(std::span<const std::uint32_t> rgba, int width, int height) {
  return shaded(rgba, width, height, [](std::uint32_t color) {
    const std::uint32_t r = color & 0xFF, g = color >> 8 & 0xFF, b = color >> 16 & 0xFF;
    return (2 * r + 5 * g + b) / 8 / 2;
  });
}

void markDifferences(Picture& picture, std::span<const PixelMatch> pixels) {
  constexpr int pixels_per_radius = 400;
  const int radius = std::max(picture.width, picture.height) / pixels_per_radius;
  for (const auto& [match, color] : {std::pair(PixelMatch::tie, yellow), std::pair(PixelMatch::wrong, red)}) {
    for (int row = 0; row < picture.height; ++row) {
      for (int column = 0; column < picture.width; ++column) {
        if (pixels[at(picture.width, row, column)] == match) paintSquare(picture, row, column, radius, color);
      }
    }
  }
}

void paste(Picture& to, const Picture& from, int row, int column) {
  for (int r = 0; r < from.height; ++r) {
    const auto line =
        std::span(from.rgba).subspan(at(from.width, r, 0), static_cast<std::size_t>(from.width));
    std::ranges::copy(line, to.rgba.begin() + static_cast<std::ptrdiff_t>(at(to.width, row + r, column)));
  }
}

Result<void> checkIds(const std::string& path, const Image& image, const Sites& sites) {
  const auto names_none = [&](std::uint32_t id) { return id != no_site && id >= sites.size(); };
  const auto found = std::ranges::find_if(image.ids, names_none);
  if (found == image.ids.end()) return {};
  const auto pixel = found - image.ids.begin();
  return inputError(fmt::format("{}: row {}, column {}: there is no site {}: --sites has {}, from 0 on", path,
                                pixel / image.width, pixel % image.width, *found, sites.size()));
}

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
  return {{"equal", diff.equal},
          {"ties", diff.ties},
          {"ties_allowed", diff.ties_allowed},
          {"widest_tie_px", diff.widest_tie},
          {"wrong", diff.wrong},
          {"first", placesJson(diff.first)},
          {"worst", diff.wrong > 0 ? placeJson(diff.worst) : Json(nullptr)}};
}

Json diffJson(const ImageDiff& diff) {
  const bool any = diff.different > 0;
  return {{"equal", diff.pixels.size() - diff.close - diff.different},
          {"close", diff.close},
          {"wrong", diff.different},
          {"largest_difference", diff.largest},
          {"rows", any ? Json({diff.top, diff.bottom}) : Json(nullptr)},
          {"columns", any ? Json({diff.left, diff.right}) : Json(nullptr)},
          {"first", placesJson(diff.first)}};
}

}  // namespace vorpipe::cli

#include "io/sites/place_beside.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/line_reader.h"
#include "io/base/number.h"
#include "io/base/system_beside.h"

namespace vorpipe {
namespace {

constexpr std::array<std::string_view, 4> world_extensions = {".pgw", ".pngw", ".tfw", ".wld"};
constexpr std::size_t place_numbers = 6;

using PlaceNumbers = std::array<double, place_numbers>;

/// Pixels in the terms of a world file, except that the corner is that of the upper left one.
struct Pixels {
  double across, turn_x, turn_y, down, west, north;
};

bool isFile(const std::string& path) {
  std::error_code none;
  return std::filesystem::is_regular_file(path, none);
}

Result<Box> boxOf(const Pixels& pixels, const std::string& name, int width, int height) {
  if (pixels.turn_x != 0 || pixels.turn_y != 0) return inputError(fmt::format("{}: turns the pixels", name));
  if (!(pixels.across > 0) || !(pixels.down < 0)) {
    return inputError(
        fmt::format("{}: pixels are {} wide and {} high; more than 0 and less than 0 are "
                    "needed, since rows count from the top",
                    name, pixels.across, pixels.down));
  }
  return Box{pixels.west, pixels.north + height * pixels.down, pixels.west + width * pixels.across,
             pixels.north};
}

Result<PlaceNumbers> numbersIn(const std::string& path) {
  auto file = InputFile::open(path);
  if (!file) return tl::unexpected(std::move(file.error()));
  LineReader lines(std::move(*file));
  PlaceNumbers numbers{};
  std::size_t found = 0;
  while (true) {
    const auto line = lines.next();
    if (!line) return tl::unexpected(line.error());
    if (!*line) break;
    const std::string_view text = trimmed(**line);
    if (text.empty()) continue;
    const auto number = parseNumber(text);
    if (!number) return lines.errorAt(1, number.error());
    if (found == place_numbers)
      return lines.errorAt(1, "a world file has 6 numbers, and this is another one");
    numbers[found++] = *number;
  }
  if (found == place_numbers) return numbers;
  return inputError(fmt::format("{}: has {} numbers; a world file has {}", path, found, place_numbers));
}

/// Returns the content of the first element of this name, which holds only text; none if there is none.
std::optional<std::string_view> textIn(std::string_view xml, std::string_view name) {
  const std::string begin = fmt::format("<{}", name), end = fmt::format("</{}>", name);
  for (std::size_t at = xml.find(begin); at != std::string_view::npos; at = xml.find(begin, at + 1)) {
    std::string_view rest = xml.substr(at + begin.size());
    // Another name may begin the same way.
    if (rest.empty() || std::string_view(" \t\r\n>").find(rest.front()) == std::string_view::npos) continue;
    rest = rest.substr(std::min(rest.find('>'), rest.size() - 1) + 1);
    return rest.substr(0, rest.find(end));
  }
  return std::nullopt;
}

/// Replaces XML's escapes by their characters.
std::string plainOf(std::string_view xml) {
  constexpr std::array<std::pair<std::string_view, char>, 5> marks = {
      {{"&quot;", '"'}, {"&apos;", '\''}, {"&lt;", '<'}, {"&gt;", '>'}, {"&amp;", '&'}}};
  std::string text;
  while (!xml.empty()) {
    const auto* const mark =
        std::ranges::find_if(marks, [&](const auto& each) { return xml.starts_with(each.first); });
    text += mark == marks.end() ? xml.front() : mark->second;
    xml.remove_prefix(mark == marks.end() ? 1 : mark->first.size());
  }
  return text;
}

/// GDAL's numbers: x of the left side, width, two of which are 0, y of the upper side, height.
Result<PlaceNumbers> transformIn(std::string_view text, const std::string& name) {
  PlaceNumbers numbers{};
  for (double& number : numbers) {
    const std::size_t comma = std::min(text.find(','), text.size());
    // GDAL puts blanks and line ends around them.
    std::string_view part = text.substr(0, comma);
    part = part.substr(std::min(part.find_first_not_of(" \t\r\n"), part.size()));
    part = part.substr(0, part.find_last_not_of(" \t\r\n") + 1);
    const auto read = parseNumber(part);
    if (!read) return inputError(fmt::format("{}: its GeoTransform: {}", name, read.error()));
    number = *read;
    text = text.substr(std::min(comma + 1, text.size()));
  }
  return numbers;
}

/// Takes the place from GDAL's file, if nothing else gave it, and the system.
Result<void> takeAux(const std::string& path, int width, int height, PixelPlace& place) {
  constexpr std::size_t longest = std::size_t{1} << 24;  // bytes: it has histograms and tables as well
  const std::string name = path + ".aux.xml";
  if (!isFile(name)) return {};
  auto file = InputFile::open(name);
  if (!file) return tl::unexpected(std::move(file.error()));
  const auto xml = readText(*file, longest);
  if (!xml) return tl::unexpected(xml.error());
  if (const auto transform = textIn(*xml, "GeoTransform"); transform && !place.box) {
    const auto numbers = transformIn(*transform, name);
    if (!numbers) return tl::unexpected(numbers.error());
    const auto [west, across, turn_x, north, turn_y, down] = *numbers;
    const auto box = boxOf({across, turn_x, turn_y, down, west, north}, name, width, height);
    if (!box) return tl::unexpected(box.error());
    place.box = *box;
  }
  const auto srs = textIn(*xml, "SRS");
  if (!srs || !place.box) return {};
  auto system = systemNamed(plainOf(*srs));
  if (!system) return inputError(fmt::format("{}: its SRS: {}", name, system.error()));
  place.system = std::move(*system);
  return {};
}

}  // namespace

Result<PixelPlace> placeBeside(const std::string& path, int width, int height) {
  PixelPlace place;
  for (const std::string_view extension : world_extensions) {
    const std::string beside = besides(path, std::string(extension));
    if (place.box || !isFile(beside)) continue;
    const auto numbers = numbersIn(beside);
    if (!numbers) return tl::unexpected(numbers.error());
    const auto [across, turn_y, turn_x, down, x, y] = *numbers;
    const auto box =
        boxOf({across, turn_x, turn_y, down, x - across / 2, y - down / 2}, beside, width, height);
    if (!box) return tl::unexpected(box.error());
    place.box = *box;
  }
  VORPIPE_TRY(takeAux(path, width, height, place));
  if (!place.box) return place;
  VORPIPE_TRY(readSystemBeside(path, place.system));
  return place;
}

}  // namespace vorpipe

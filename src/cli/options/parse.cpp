#include "cli/options/parse.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "base/option_names.h"
#include "base/try.h"
#include "base/words.h"
#include "cli/options/unknown_option.h"
#include "io/base/extension.h"
#include "io/base/number.h"
#include "io/base/quoted.h"
#include "io/sites/outline_file.h"
#include "io/sites/site_domain.h"
#include "view/recorder.h"

namespace vorpipe::cli {
namespace {

bool isKind(std::string_view text) {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz0123456789.";
  return !text.empty() && text.front() != '.' && text.find_first_not_of(letters) == std::string_view::npos;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t end; (end = text.find(separator)) != std::string_view::npos; text.remove_prefix(end + 1)) {
    parts.push_back(text.substr(0, end));
  }
  parts.push_back(text);
  return parts;
}

tl::unexpected<std::string> bad(std::string message) { return tl::unexpected(std::move(message)); }

Parsed<std::string> oneOf(const std::vector<std::string>& names, std::string_view text) {
  if (std::ranges::find(names, text) != names.end()) return std::string(text);
  return bad(
      fmt::format("{} is not one of {}{}", inQuotes(text), fmt::join(names, ", "), didYouMean(text, names)));
}

/// Returns the value that `text` names.
template <Named Enum>
Parsed<Enum> valueIn(std::string_view text, Enum first = Enum{}) {
  return oneOf(namesFrom(first), text).map([](const std::string& name) { return *valueNamed<Enum>(name); });
}

}  // namespace

std::string anyOf(std::span<const std::string> words) {
  if (words.size() < 2) return fmt::to_string(fmt::join(words, ""));
  return fmt::format("{} or {}", fmt::join(words.first(words.size() - 1), ", "), words.back());
}

std::vector<std::string> periodicNames() {
  auto names = namesFrom(Periodic::x);
  for (const std::string_view in_space : {"z", "xz", "yz", "xyz"}) names.emplace_back(in_space);
  return names;
}
std::vector<std::string> searchNames() { return namesFrom<Search>(); }
std::vector<std::string> colorNames() { return namesFrom<ColorBy>(); }

Parsed<std::uint64_t> parseWhole(std::string_view text, std::uint64_t low, std::uint64_t high) {
  const auto value = wholeNumber<std::uint64_t>(text);
  if (value && *value >= low && *value <= high) return *value;
  return bad(fmt::format("{} is not a whole number from {} to {}", inQuotes(text), low, high));
}

Parsed<Point> parsePlace(std::string_view text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) {
    return bad(fmt::format("{} is not LON,LAT, degrees of a place, as in 12.5,42", inQuotes(text)));
  }
  const auto longitude = parseNumber(text.substr(0, comma)), latitude = parseNumber(text.substr(comma + 1));
  if (!longitude) return bad("LON: " + longitude.error());
  if (!latitude) return bad("LAT: " + latitude.error());
  const Point place{*longitude, *latitude};
  if (auto projection = Projection::around(place); !projection) {
    return bad(std::move(projection.error().message));
  }
  return place;
}

Parsed<Box> parseBox(std::string_view text) {
  constexpr std::array<std::string_view, 4> names = {"xmin", "ymin", "xmax", "ymax"};
  const auto parts = split(text, ',');
  if (parts.size() != names.size()) return bad(fmt::format("{} is not XMIN,YMIN,XMAX,YMAX", inQuotes(text)));
  std::array<double, 4> values{};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto value = parseNumber(parts[i]);
    if (!value) return bad(fmt::format("{}: {}", names[i], value.error()));
    values[i] = *value;
  }
  const Box box{values[0], values[1], values[2], values[3]};
  if (!(box.xmin < box.xmax)) return bad(fmt::format("xmin {} is not below xmax {}", box.xmin, box.xmax));
  if (!(box.ymin < box.ymax)) return bad(fmt::format("ymin {} is not below ymax {}", box.ymin, box.ymax));
  if (!std::isfinite(box.xmax - box.xmin)) return bad("xmax - xmin is too large for a double");
  if (!std::isfinite(box.ymax - box.ymin)) return bad("ymax - ymin is too large for a double");
  return box;
}

namespace {

/// Six numbers, a valid box in space.
Parsed<Box3> parseBoxInSpace(const std::vector<std::string_view>& parts) {
  constexpr std::array<std::string_view, 6> names = {"xmin", "ymin", "zmin", "xmax", "ymax", "zmax"};
  std::array<double, 6> values{};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto value = parseNumber(parts[i]);
    if (!value) return bad(fmt::format("{}: {}", names[i], value.error()));
    values[i] = *value;
  }
  for (std::size_t low = 0; low < 3; ++low) {
    const std::size_t high = low + 3;
    if (!(values[low] < values[high]))
      return bad(fmt::format("{} {} is not below {} {}", names[low], values[low], names[high], values[high]));
    if (!std::isfinite(values[high] - values[low]))
      return bad(fmt::format("{} - {} is too large for a double", names[high], names[low]));
  }
  return Box3{values[0], values[1], values[2], values[3], values[4], values[5]};
}

}  // namespace

Parsed<DomainChoice> parseDomain(std::string_view text) {
  if (text == "hull") return DomainChoice{.hull = true};
  const auto outlines = outlineExtensions();
  if (std::ranges::find(outlines, inputExtension(std::string(text))) != outlines.end()) {
    return DomainChoice{.file = std::string(text)};
  }
  const auto parts = split(text, ',');
  if (parts.size() == 6) {
    VORPIPE_LET(space, parseBoxInSpace(parts));
    return DomainChoice{.space = space};
  }
  if (parts.size() != 4) {
    return bad(fmt::format("{} is neither XMIN,YMIN,XMAX,YMAX nor hull nor a {} file", inQuotes(text),
                           anyOf(outlines)));
  }
  auto box = parseBox(text);
  const auto west = parseNumber(parts.front()), east = parseNumber(parts[2]);
  if (!box) return bad(box.error() + (west && east ? hintAcrossAntimeridian(*west, *east) : std::string()));
  return DomainChoice{.box = *box};
}

std::string AxesChoice::name() const {
  return fmt::format("{}{}", plane == Periodic::none ? "" : nameOf(plane), z ? "z" : "");
}

Parsed<AxesChoice> parsePeriodic(std::string_view text) {
  std::string letters(text);
  std::erase(letters, ',');
  const auto name = oneOf(periodicNames(), letters);
  if (!name) return bad(oneOf(periodicNames(), text).error());
  AxesChoice axes;
  axes.z = letters.ends_with('z');
  if (axes.z) letters.pop_back();
  if (!letters.empty()) axes.plane = *valueNamed<Periodic>(letters);
  return axes;
}

Parsed<Lattice> parseLattice(std::string_view text) {
  const auto parts = split(text, ',');
  std::array<double, 9> values{};
  if (parts.size() != values.size())
    return bad(fmt::format("{} is not nine numbers AX,AY,AZ,BX,BY,BZ,CX,CY,CZ", inQuotes(text)));
  for (std::size_t k = 0; k < values.size(); ++k) {
    const auto value = parseNumber(parts[k]);
    if (!value) return bad(fmt::format("number {}: {}", k + 1, value.error()));
    values[k] = *value;
  }
  const auto& v = values;
  return Lattice{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8]}};
}

Parsed<WeightRange> parseWeightRange(std::string_view text) {
  const auto parts = split(text, ',');
  if (parts.size() != 2) return bad(fmt::format("{} is not LO,HI, as in 0,0.001", inQuotes(text)));
  const auto low = parseNumber(parts[0]), high = parseNumber(parts[1]);
  if (!low) return bad("LO: " + low.error());
  if (!high) return bad("HI: " + high.error());
  if (*low > *high) return bad(fmt::format("LO {} is above HI {}", *low, *high));
  if (!std::isfinite(*high - *low)) return bad("HI - LO is too large for a double");
  return WeightRange{*low, *high};
}

Parsed<PictureSize> parseSize(std::string_view text) {
  const auto parts = split(text, 'x');
  if (parts.size() != 2) return bad(fmt::format("{} is not WxH, as in 800x600", inQuotes(text)));
  const auto width = parseWhole(parts[0], 1, largest_side);
  if (!width) return bad("width " + width.error());
  const auto height = parseWhole(parts[1], 1, largest_side);
  if (!height) return bad("height " + height.error());
  return PictureSize{static_cast<int>(*width), static_cast<int>(*height)};
}

Parsed<std::uint64_t> parseBytes(std::string_view text) {
  struct Unit {
    std::string_view name;
    double bytes;
  };
  constexpr std::array<Unit, 11> units = {{{"", 1},
                                           {"B", 1},
                                           {"kB", 1e3},
                                           {"KB", 1e3},
                                           {"MB", 1e6},
                                           {"GB", 1e9},
                                           {"TB", 1e12},
                                           {"KiB", 0x1p10},
                                           {"MiB", 0x1p20},
                                           {"GiB", 0x1p30},
                                           {"TiB", 0x1p40}}};
  const std::size_t end = text.find_last_of("0123456789.") + 1;
  const std::string_view name = trimmed(text.substr(end));
  const auto* const unit = std::ranges::find(units, name, &Unit::name);
  const auto number = parseNumber(text.substr(0, end));
  constexpr double most = 0x1p63;
  const double bytes = number && unit != units.end() ? *number * unit->bytes : 0;
  if (bytes >= 1 && bytes < most) return static_cast<std::uint64_t>(bytes);
  return bad(fmt::format("{} is not a size above 0, as in 8GiB, 500MB or 1000000000", inQuotes(text)));
}

Parsed<SearchOptions> parseSearch(std::string_view text) {
  constexpr std::string_view flann = "flann";
  SearchOptions search;
  if (text == "grid") return search;
  search.method = Search::flann;
  if (text == flann) return search;
  if (!text.starts_with("flann:"))
    return bad(fmt::format("{} is not grid, flann or flann:K", inQuotes(text)));
  const auto neighbors = parseWhole(text.substr(flann.size() + 1), 3, 1024);
  if (!neighbors) return bad("flann: " + neighbors.error());
  search.neighbors = static_cast<int>(*neighbors);
  return search;
}

Parsed<std::string> parseBackend(std::string_view text) { return oneOf(backendNames(), text); }

Parsed<std::string> parseFeature(std::string_view text) { return oneOf(featureNames(), text); }

Parsed<std::pair<std::string, std::uint64_t>> parseLimit(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string_view::npos) {
    return bad(fmt::format("{} is not NAME=VALUE, as in maxTexelBufferElements=65536", inQuotes(text)));
  }
  auto name = oneOf(limitNames(), text.substr(0, equals));
  if (!name) return bad(std::move(name.error()));
  const auto value = parseWhole(text.substr(equals + 1), 0, UINT64_MAX);
  if (!value) return bad(fmt::format("{}: {}", *name, value.error()));
  return std::pair(std::move(*name), *value);
}

Parsed<ColorBy> parseColor(std::string_view text) { return valueIn<ColorBy>(text); }

Parsed<Color> parseOpaqueColor(std::string_view text) {
  const auto color = readColor(text);
  if (color && color->isOpaque()) return *color;
  if (color)
    return bad(fmt::format("{} is not opaque, as #rgb, #rrggbb and names of CSS are", inQuotes(text)));
  return bad(
      fmt::format("{} is no color: neither #rgb, #rrggbb nor a name of CSS, as steelblue", inQuotes(text)));
}

Parsed<ColormapChoice> parseColormap(std::string_view text) {
  ColormapChoice choice;
  if (text.find(',') != std::string_view::npos || text.starts_with('#')) {
    for (const std::string_view part : split(text, ',')) {
      const auto color = parseOpaqueColor(trimmed(part));
      if (!color) return bad(color.error());
      choice.colors.push_back(*color);
    }
    if (choice.colors.size() < 2) return bad("is one color, and takes two or more");
    return choice;
  }
  if (text.find_first_of("./") != std::string_view::npos) {
    VORPIPE_VAR(path, parseFile(text, ""));
    choice.file = std::move(path);
    return choice;
  }
  VORPIPE_VAR(name, oneOf(colormaps(), text));
  choice.name = std::move(name);
  return choice;
}

Parsed<std::vector<BackendDevice>> parseBackendDevices(std::string_view text) {
  std::vector<BackendDevice> named;
  for (const std::string_view item : split(text, ',')) {
    if (item.empty()) return bad(fmt::format("{} has an empty name", inQuotes(text)));
    if (std::ranges::find(named, item, &BackendDevice::text) != named.end()) {
      return bad(fmt::format("{} is named twice", inQuotes(item)));
    }
    const std::size_t colon = std::min(item.find(':'), item.size());
    VORPIPE_VAR(backend, parseBackend(item.substr(0, colon)));
    if (colon + 1 == item.size()) return bad(fmt::format("{} names no device", inQuotes(item)));
    const std::string device(colon < item.size() ? item.substr(colon + 1) : "");
    named.push_back({std::string(item), std::move(backend), device});
  }
  return named;
}

Parsed<std::vector<std::string>> parseBackendList(std::string_view text) {
  VORPIPE_LET(named, parseBackendDevices(text));
  std::vector<std::string> names;
  for (const BackendDevice& each : named) {
    if (!each.device.empty()) return bad(fmt::format("{} names a device", inQuotes(each.text)));
    names.push_back(each.backend);
  }
  return names;
}

Parsed<std::string> parseAttribute(std::string_view text) {
  if (text.size() > 1 && text.starts_with('@')) return std::string(text.substr(1));
  return tl::unexpected(fmt::format("{} is not @NAME, an attribute of the sites", inQuotes(text)));
}

Parsed<std::string> parseAttributeWord(std::string_view text) {
  return text.starts_with('@') ? parseAttribute(text) : std::string(text);
}

Parsed<std::string> parseFile(std::string_view text, std::string_view extension) {
  if (text.empty() || text.starts_with('-'))
    return bad(fmt::format("{} is not the name of a file", inQuotes(text)));
  const std::string found = lowerExtension(std::string(text));
  if (!extension.empty() && !found.empty() && found != extension)
    return bad(fmt::format("{} does not end in {}", inQuotes(text), extension));
  return std::string(text);
}

Parsed<std::string> parseFolder(std::string_view text, StepsTo to) {
  constexpr std::array<std::string_view, 24> of_files{
      ".apng", ".avi", ".bmp", ".gif", ".jpeg", ".jpg", ".m4v", ".mkv",  ".mov", ".mp4", ".mpeg", ".mpg",
      ".npz",  ".ogv", ".pdf", ".png", ".pvd",  ".svg", ".tif", ".tiff", ".vtp", ".vtu", ".webm", ".webp"};
  VORPIPE_VAR(path, parseFile(text, ""));
  const std::string found = lowerExtension(path);
  const bool may_be_film = to == StepsTo::folder_or_film;
  if (may_be_film && found == view::film_extension) return path;
  if (std::ranges::find(of_files, found) == of_files.end()) return path;
  std::error_code none;
  if (std::filesystem::is_directory(path, none)) return path;
  if (!may_be_film) return bad(fmt::format("{} is the name of a file; name a folder", inQuotes(text)));
  return bad(fmt::format("{} is the name of a file that is no film; name an {} or a folder", inQuotes(text),
                         view::film_extension));
}

Parsed<FormatChoice> parseFormat(std::string_view text) {
  const std::string lower = lowerCase(text);
  const std::size_t comma = std::min(lower.find(','), lower.size());
  FormatChoice choice{lower.substr(0, comma), comma < lower.size() ? lower.substr(comma + 1) : lower};
  if (isKind(choice.input) && isKind(choice.output)) return choice;
  return tl::unexpected(
      fmt::format("{} is no kind of file, as in csv, or two, as in csv,geojson", vorpipe::inQuotes(text)));
}

}  // namespace vorpipe::cli

#include "io/base/wkt_system.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <system_error>
#include <utility>

#include "io/base/lower_case.h"
#include "io/base/number.h"

namespace vorpipe {
namespace {

/// Returns the last word of text, in lower case.
std::string lastWord(std::string_view text) {
  text = trimmed(text);
  const auto isLetter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  const auto begin = std::find_if_not(text.rbegin(), text.rend(), isLetter).base();
  return lowerCase(text.substr(static_cast<std::size_t>(begin - text.begin())));
}

/// Returns the AUTHORITY or ID in the outermost brackets of a definition; empty if there is none.
std::string_view outermostId(std::string_view text) {
  std::size_t depth = 0;
  bool quoted = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    if (c == ']' || c == ')') depth -= depth > 0 ? 1u : 0u;
    if (c != '[' && c != '(') continue;
    if (depth++ != 1) continue;
    const std::string word = lastWord(text.substr(0, k));
    if (word != "authority" && word != "id") continue;
    const std::string_view rest = text.substr(k + 1);
    return rest.substr(0, rest.find_first_of("])"));
  }
  return {};
}

/// Takes an id: "EPSG","25832", the second also without quotes.
void takeId(std::string_view id, CoordinateSystem& system) {
  const std::size_t comma = id.find(',');
  if (comma == std::string_view::npos) return;
  const auto unquoted = [](std::string_view text) {
    text = trimmed(text);
    if (text.starts_with('"')) text.remove_prefix(1);
    return text.substr(0, text.find('"'));
  };
  const std::string_view organization = unquoted(id.substr(0, comma)), code = unquoted(id.substr(comma + 1));
  std::int64_t number = 0;
  const auto [stop, error] = std::from_chars(code.data(), code.data() + code.size(), number);
  if (organization.empty() || error != std::errc() || stop != code.data() + code.size()) return;
  system.organization = organization;
  for (char& c : system.organization) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  system.code = number;
}

/// The letters and digits of a name.
std::string lettersOf(std::string_view name) {
  std::string letters = lowerCase(name);
  std::erase_if(letters, [](char c) { return !((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')); });
  return letters;
}

/// Returns the EPSG code of a UTM zone, as in "WGS_1984_UTM_Zone_32N" and "WGS 84 / UTM zone 32N"; 0: none.
std::int64_t codeOfZone(std::string_view letters) {
  struct Datum {
    std::string_view name;
    std::int64_t north, south;
  };
  constexpr std::array<Datum, 6> datums = {{{"wgs1984", 32600, 32700},
                                            {"wgs84", 32600, 32700},
                                            {"etrs1989", 25800, 0},
                                            {"etrs89", 25800, 0},
                                            {"nad1983", 26900, 0},
                                            {"nad83", 26900, 0}}};
  constexpr std::string_view words = "utmzone";
  for (const auto& [name, north, south] : datums) {
    if (!letters.starts_with(name)) continue;
    const std::string_view rest = letters.substr(name.size());
    if (!rest.starts_with(words)) continue;
    const std::string_view zone = rest.substr(words.size());
    std::int64_t number = 0;
    const auto [stop, error] = std::from_chars(zone.data(), zone.data() + zone.size(), number);
    constexpr std::int64_t zones = 60;
    if (error != std::errc() || number < 1 || number > zones) return 0;
    const std::string_view half(stop, zone.data() + zone.size());
    const std::int64_t base = half == "n" ? north : half == "s" ? south : 0;
    return base == 0 ? 0 : base + number;
  }
  return 0;
}

/// Returns a system's code by its name in definitions without codes, such as ESRI's; 0: none.
std::int64_t codeOfName(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, std::int64_t>, 12> names = {
      {{"gcswgs1984", 4326},
       {"wgs84", 4326},
       {"gcsetrs1989", 4258},
       {"etrs89", 4258},
       {"gcsnorthamerican1983", 4269},
       {"nad83", 4269},
       {"wgs1984webmercatorauxiliarysphere", 3857},
       {"wgs84pseudomercator", 3857},
       {"etrs1989laea", 3035},
       {"etrs89laeaeurope", 3035},
       {"rgf1993lambert93", 2154},
       {"britishnationalgrid", 27700}}};
  const std::string letters = lettersOf(name);
  const auto* const found = std::ranges::find(names, letters, [](const auto& pair) { return pair.first; });
  return found == names.end() ? codeOfZone(letters) : found->second;
}

}  // namespace

std::string nameInWkt(std::string_view definition) {
  const std::size_t begin = definition.find('"');
  if (begin == std::string_view::npos) return {};
  const std::string_view rest = definition.substr(begin + 1);
  return std::string(rest.substr(0, rest.find('"')));
}

CoordinateKind kindOfWkt(std::string_view definition) {
  const std::string lower = lowerCase(definition);
  const auto names = [&](std::string_view word) { return lower.find(word) != std::string::npos; };
  constexpr std::array<std::string_view, 5> planes = {"projcs", "projcrs", "projectedcrs", "local_cs",
                                                      "engcrs"};
  constexpr std::array<std::string_view, 5> degrees = {"geogcs", "geogcrs", "geographiccrs", "geodcrs",
                                                       "geodeticcrs"};
  if (std::ranges::any_of(planes, names)) return CoordinateKind::plane;
  return std::ranges::any_of(degrees, names) ? CoordinateKind::degrees : CoordinateKind::unknown;
}

std::optional<CoordinateSystem> systemOfWkt(std::string_view text) {
  text = trimmed(text);
  CoordinateSystem system{kindOfWkt(text)};
  if (system.kind == CoordinateKind::unknown || text.find_first_of("[(") == std::string_view::npos) return {};
  takeId(outermostId(text), system);
  if (system.code == 0) {
    if ((system.code = codeOfName(nameInWkt(text))) != 0) system.organization = "EPSG";
  }
  system.definition = text;
  return system;
}

}  // namespace vorpipe

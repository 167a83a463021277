#include "io/base/coordinate_system.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/extension.h"
#include "io/base/input_file.h"
#include "io/base/number.h"
#include "io/base/quoted.h"

namespace vorpipe {
namespace {

/// Returns the last word of text, in lower case.
std::string lastWord(std::string_view text) {
  text = trimmed(text);
  const auto isLetter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  const auto begin = std::find_if_not(text.rbegin(), text.rend(), isLetter).base();
  return lowerCase(text.substr(static_cast<std::size_t>(begin - text.begin())));
}

/// Calls `visit(depth, word, rest)` for each opening bracket outside quotes, until it returns true: `word`
/// precedes the bracket, in lower case; `rest` follows it; `depth` counts the brackets around it.
template <class Visit>
void eachBracket(std::string_view text, const Visit& visit) {
  std::size_t depth = 0;
  bool quoted = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    if (c == ']' || c == ')') depth -= depth > 0 ? 1u : 0u;
    if (c != '[' && c != '(') continue;
    if (visit(depth++, lastWord(text.substr(0, k)), text.substr(k + 1))) return;
  }
}

/// Returns the AUTHORITY or ID in the outermost brackets of a definition; empty if there is none.
std::string_view outermostId(std::string_view text) {
  std::string_view id;
  eachBracket(text, [&](std::size_t depth, const std::string& word, std::string_view rest) {
    if (depth != 1 || (word != "authority" && word != "id")) return false;
    id = rest.substr(0, rest.find_first_of("])"));
    return true;
  });
  return id;
}

/// Returns the meters in a unit of length of the plane that a definition describes; none if it does not say.
std::optional<double> metersInWkt(std::string_view text) {
  std::optional<double> meters;
  eachBracket(text, [&](std::size_t depth, const std::string& word, std::string_view rest) {
    // In WKT 2 the unit may be that of each axis.
    const bool unit = (word == "unit" && depth == 1) || (word == "lengthunit" && (depth == 1 || depth == 2));
    const std::size_t comma = rest.find("\",");
    if (!unit || comma == std::string_view::npos) return false;
    const std::string_view factor = rest.substr(comma + 2);
    const auto number = parseNumber(trimmed(factor.substr(0, factor.find_first_of(",])"))));
    if (number && *number > 0) meters = *number;
    return meters.has_value();
  });
  return meters;
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
  const auto number = wholeNumber<std::int64_t>(code);
  if (organization.empty() || !number) return;
  system.organization = upperCase(organization);
  system.code = *number;
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

/// Returns the name in a definition; empty if there is none.
std::string nameInWkt(std::string_view definition) {
  const std::size_t begin = definition.find('"');
  if (begin == std::string_view::npos) return {};
  const std::string_view rest = definition.substr(begin + 1);
  return std::string(rest.substr(0, rest.find('"')));
}

/// Systems of degrees that differ from WGS 84 by at most the drift of the plates: ETRS89, NAD83, and those of
/// other continents.
constexpr std::array<std::int64_t, 18> near_wgs84 = {4326, 4979, 4258, 4937, 4269, 6318, 4171, 4619, 4173,
                                                     4283, 7844, 4167, 4674, 4490, 4612, 6668, 4737, 4148};

bool isNearWgs84(std::int64_t code) { return std::ranges::find(near_wgs84, code) != near_wgs84.end(); }

/// Maps the several codes that Web Mercator has had to one.
std::int64_t usualCode(std::int64_t code) {
  constexpr std::int64_t web_mercator = 3857;
  constexpr std::array<std::int64_t, 4> others = {3785, 900913, 102100, 102113};
  return std::ranges::find(others, code) == others.end() ? code : web_mercator;
}

/// Codes of EPSG whose unit is the meter: zones of UTM, and national grids. Not all that there are.
struct CodeRange {
  std::int64_t first, last;
};
constexpr std::array metric_ranges = {
    CodeRange{32601, 32660}, CodeRange{32701, 32760},  // WGS 84 / UTM
    CodeRange{25828, 25838}, CodeRange{23028, 23038},  // ETRS89 and ED50 / UTM
    CodeRange{26901, 26923}, CodeRange{31965, 31985},  // NAD83 and SIRGAS 2000 / UTM
    CodeRange{28348, 28358}, CodeRange{7846, 7859},    // Australia: MGA94, MGA2020
    CodeRange{31466, 31469}, CodeRange{31254, 31259},  // Gauss-Krueger of Germany, of Austria
    CodeRange{3942, 3950},   CodeRange{2176, 2179},    // France: CC42 to CC50; Poland: CS2000
    CodeRange{3007, 3018},   CodeRange{7791, 7793},    // SWEREF99 by zones; Italy: RDN2008
    CodeRange{2443, 2461},   CodeRange{6669, 6687}};   // Japan
constexpr std::array<std::int64_t, 50> metric_codes = {
    2154, 27700, 2157, 29902, 29903, 31370, 3812, 28992, 2056, 21781, 31287, 3416, 3034,
    3035, 4647,  3003, 3004,  3763,  2100,  3765, 3794,  2180, 5514,  3006,  3067, 3301,
    3059, 3346,  3844, 23700, 2193,  27200, 3577, 3111,  3005, 3347,  3978,  3979, 5070,
    6350, 6933,  8857, 2326,  3414,  5179,  5186, 3826,  2039, 9377,  5880};

bool isMetricCode(std::int64_t code) {
  const auto holds = [code](const CodeRange& range) { return code >= range.first && code <= range.last; };
  return std::ranges::any_of(metric_ranges, holds) ||
         std::ranges::find(metric_codes, code) != metric_codes.end();
}

/// Whether a definition is of a Mercator projection that is neither transverse nor oblique.
bool isMercator(std::string_view definition) {
  const std::string letters = lettersOf(definition);
  constexpr std::string_view word = "mercator";
  const auto upright = [&](std::size_t at) {
    const std::string_view before = std::string_view(letters).substr(0, at);
    return !before.ends_with("transverse") && !before.ends_with("oblique");
  };
  for (std::size_t at = letters.find(word); at != std::string::npos; at = letters.find(word, at + 1)) {
    if (upright(at)) return true;
  }
  return false;
}

bool hasCode(const CoordinateSystem& system) {
  return system.code > 0 && !system.organization.empty() && system.organization != "NONE";
}

/// Whether texts are equal except for blanks and case.
bool readTheSame(std::string_view a, std::string_view b) {
  const auto plain = [](std::string_view text) {
    std::string letters = lowerCase(text);
    std::erase_if(letters, [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; });
    return letters;
  };
  return plain(a) == plain(b);
}

/// Returns the system that a definition describes: its kind, its code if it has one or a common name implies
/// one, and the text itself. None if it defines no system.
std::optional<CoordinateSystem> systemOfWkt(std::string_view text) {
  text = trimmed(text);
  CoordinateSystem system{kindOfWkt(text)};
  if (system.kind == CoordinateKind::unknown || text.find_first_of("[(") == std::string_view::npos) return {};
  takeId(outermostId(text), system);
  if (system.code == 0 && (system.code = codeOfName(nameInWkt(text))) != 0) system.organization = "EPSG";
  system.definition = text;
  return system;
}

}  // namespace

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

CoordinateSystem systemOfCode(std::int64_t code) {
  // EPSG uses these codes for systems of longitude and latitude, except a geocentric one.
  constexpr std::int64_t first = 4001, last = 4999, geocentric = 4978;
  const bool degrees = (code >= first && code <= last && code != geocentric) || isNearWgs84(code);
  return {degrees ? CoordinateKind::degrees : CoordinateKind::plane, "EPSG", code, {}, {}};
}

tl::expected<CoordinateSystem, std::string> systemNamed(std::string_view text) {
  text = trimmed(text);
  if (text.find_first_of("[(") != std::string_view::npos) {
    if (auto system = systemOfWkt(text)) return std::move(*system);
    return tl::unexpected(fmt::format("{} is no coordinate system in WKT", inQuotes(text)));
  }
  const std::string lower = lowerCase(text);
  const std::string_view last = std::string_view(lower).substr(lower.find_last_of(":/") + 1);
  if (last == "crs84" || last == "crs84h") return wgs84();
  const std::int64_t code = wholeNumber<std::int64_t>(last).value_or(0);
  const bool of_epsg = last.size() == lower.size() || lower.find("epsg") != std::string::npos;
  if (of_epsg && code > 0) return systemOfCode(code);
  return tl::unexpected(fmt::format("{} is no system of EPSG and not CRS84", inQuotes(text)));
}

bool hasName(const CoordinateSystem& system) { return hasCode(system) || !system.definition.empty(); }

std::string nameOf(const CoordinateSystem& system) {
  if (hasCode(system)) return fmt::format("{}:{}", system.organization, system.code);
  if (std::string name = nameInWkt(system.definition); !name.empty()) return printable(name);
  switch (system.kind) {
    case CoordinateKind::degrees:
      return "degrees of longitude and latitude";
    case CoordinateKind::plane:
      return "a plane";
    case CoordinateKind::unknown:
      break;
  }
  return "a system that nothing names";
}

SystemsAre compared(const CoordinateSystem& a, const CoordinateSystem& b) {
  using enum SystemsAre;
  const auto unknown = CoordinateKind::unknown;
  if (a.kind != b.kind && a.kind != unknown && b.kind != unknown) {
    // An unnamed plane may be that of the other: files that declare degrees are written with any coordinates.
    return hasName(a.kind == CoordinateKind::plane ? a : b) ? different : unclear;
  }
  if (!hasName(a) || !hasName(b)) return one;
  if (hasCode(a) && hasCode(b)) {
    if (usualCode(a.code) == usualCode(b.code)) return one;
    if (a.organization == b.organization)
      return isNearWgs84(a.code) && isNearWgs84(b.code) ? near : different;
  }
  return readTheSame(a.definition, b.definition) ? one : unclear;
}

std::optional<double> squareKilometersIn(const CoordinateSystem& system) {
  constexpr std::int64_t web_mercator = 3857, world_mercator = 3395;
  constexpr double meters_in_kilometer = 1000;
  if (system.equal_area_center) return 1;
  const std::int64_t code = system.organization == "EPSG" ? usualCode(system.code) : 0;
  if (system.kind != CoordinateKind::plane || code == web_mercator || code == world_mercator) return {};
  if (isMercator(system.definition)) return {};
  auto meters = metersInWkt(system.definition);
  if (!meters && isMetricCode(code)) meters = 1;
  if (!meters) return {};
  const double kilometers = *meters / meters_in_kilometer;
  return kilometers * kilometers;
}

std::string geoJsonSystem(const CoordinateSystem& system) {
  if (system.organization != "EPSG" || compared(system, wgs84()) != SystemsAre::different) return {};
  return fmt::format(R"("crs":{{"type":"name","properties":{{"name":"urn:ogc:def:crs:EPSG::{}"}}}},)",
                     system.code);
}

Result<void> readSystemBeside(const std::string& path, CoordinateSystem& system) {
  constexpr std::size_t longest = std::size_t{1} << 20;  // bytes
  if (path == "-" || hasName(system)) return {};
  std::error_code none;
  std::string beside = besides(path, ".prj");
  if (!std::filesystem::is_regular_file(beside, none)) beside = besides(path, ".PRJ");
  if (!std::filesystem::is_regular_file(beside, none)) return {};
  VORPIPE_VAR(file, InputFile::open(beside));
  VORPIPE_LET(text, readText(file, longest));
  auto read = systemOfWkt(text);
  if (!read) return inputError(fmt::format("{}: is no coordinate system in WKT", beside));
  if (compared(*read, system) == SystemsAre::different) {
    return inputError(fmt::format("{}: says {}, and {} has {}", beside, nameOf(*read), path, nameOf(system)));
  }
  system = std::move(*read);
  return {};
}

}  // namespace vorpipe

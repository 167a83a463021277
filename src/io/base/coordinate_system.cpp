#include "io/base/coordinate_system.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <system_error>

#include "io/base/lower_case.h"
#include "io/base/number.h"
#include "io/base/quoted.h"
#include "io/base/wkt_system.h"

namespace vorpipe {
namespace {

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

}  // namespace

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
  std::int64_t code = 0;
  const char* const end = last.data() + last.size();
  const auto [stop, error] = std::from_chars(last.data(), end, code);
  const bool of_epsg = last.size() == lower.size() || lower.find("epsg") != std::string::npos;
  if (of_epsg && stop == end && error == std::errc() && code > 0) return systemOfCode(code);
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

}  // namespace vorpipe

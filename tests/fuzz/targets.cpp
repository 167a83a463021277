#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>

#include "io/base/quoted.h"
#include "target.h"

namespace vorpipe::fuzz {
namespace {

constexpr std::size_t small = 512, usual = 4096, large = 16384;

constexpr std::array<Target, 25> all = {{{"csv", fuzzCsv, usual, "text"},
                                         {"text", fuzzText, usual, "text"},
                                         {"npy", fuzzNpy, usual, "binary"},
                                         {"geojson", fuzzGeoJson, usual, "json"},
                                         {"geojsonl", fuzzGeoJsonLines, usual, "json"},
                                         {"wkt", fuzzWkt, usual, "text"},
                                         {"gpkg", fuzzGeoPackage, large, "binary"},
                                         {"geometry", fuzzGeometry, small, "binary"},
                                         {"weights", fuzzWeights, usual, "text"},
                                         {"masses", fuzzMasses, usual, "text"},
                                         {"outline_geojson", fuzzOutlineGeoJson, usual, "json"},
                                         {"outline_wkt", fuzzOutlineWkt, usual, "text"},
                                         {"density_npy", fuzzDensityNpy, usual, "binary"},
                                         {"png", fuzzPng, usual, "binary"},
                                         {"jpeg", fuzzJpeg, usual, "binary"},
                                         {"ids", fuzzIds, usual, "binary"},
                                         {"checkpoint", fuzzCheckpoint, large, "binary"},
                                         {"stats", fuzzRecordedRun, usual, "json"},
                                         {"script", fuzzScript, usual, "text"},
                                         {"command_line", fuzzCommandLine, small, "options"},
                                         {"library", fuzzLibrary, small, ""},
                                         {"cells", fuzzCells, small, ""},
                                         {"judge", fuzzJudge, small, ""},
                                         {"space", fuzzSpace, small, ""},
                                         {"space_sites", fuzzSpaceSites, usual, "text"}}};

}  // namespace

std::span<const Target> targets() { return all; }

const Target* targetNamed(std::string_view name) {
  const auto* const found = std::ranges::find(all, name, &Target::name);
  return found == all.end() ? nullptr : found;
}

void require(bool kept, std::string_view promise) {
  if (kept) return;
  std::fprintf(stderr, "fuzz: broken: %.*s\n", static_cast<int>(promise.size()), promise.data());
  std::abort();
}

void requireTold(const Error& error, std::string_view subject) {
  constexpr std::size_t longest = 2000;
  require(error.message.starts_with(subject), "an error begins with what it is about: " + error.message);
  require(escaped(error.message) == error.message, "an error is one line of UTF-8: " + error.message);
  require(error.message.size() <= longest, "an error is no longer than 2000 bytes");
  require(error.code == ErrorCode::input, "bad input is an input error: " + error.message);
}

}  // namespace vorpipe::fuzz

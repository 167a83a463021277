/// Text of CSV, JSON and GeoJSON. The JSON library's writer, which takes long to compile, stays in the
/// source.
#pragma once

#include <fmt/core.h>
#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/try.h"
#include "io/base/coordinate_system.h"
#include "io/base/print.h"
#include "vorpipe.h"

namespace vorpipe {

/// Appends a CSV field by RFC 4180. Quotes it if it has a comma, a quote, a line end, or blanks at an end. An
/// empty field is also in double quotes, to differ from a missing one.
void printCsvField(Bytes& text, std::string_view field);

/// Appends a JSON string: in double quotes, with control characters escaped and invalid UTF-8 replaced.
void printJsonString(Bytes& text, std::string_view string);

/// Returns `text` with invalid UTF-8 replaced.
std::string utf8Of(std::string_view text);

/// Returns JSON as text with a final line end. Invalid UTF-8 is replaced: a driver's name may hold any bytes.
std::string jsonText(const nlohmann::ordered_json& json, int indent);

/// Returns UTF-8 text as a JSON string in double quotes.
std::string jsonString(std::string_view text);

inline constexpr ListText json_list{"[", ",", "]"};

/// Appends a position.
inline void printJsonPoint(Bytes& text, const Point& point) {
  print(text, FMT_COMPILE("[{},{}]"), point.x, point.y);
}

enum class FeaturesAs : std::uint8_t {
  collection,  ///< one object of GeoJSON
  lines,       ///< GeoJSONSeq without record separators, as GDAL, PostGIS and tile makers stream it
};

/// Writes the feature that `put(bytes, index)` appends for each index below `count`; put returns false if it
/// appends none. Calls put as writeEach() does. A collection names `system` in its member `crs`;
/// lines of features have no such member. Error (device): writing failed.
template <class Put>
Result<void> writeFeatures(ByteSink& sink, FeaturesAs as, const CoordinateSystem& system, std::size_t count,
                           const Put& put, int threads) {
  const bool lines = as == FeaturesAs::lines;
  if (!lines) {
    VORPIPE_TRY(
        sink.write(fmt::format(R"({{"type":"FeatureCollection",{}"features":[)", geoJsonSystem(system))));
  }
  const auto putFeature = [&](Bytes& text, std::size_t index) {
    const std::size_t before = text.size();
    if (!lines) text.append(std::string_view(",\n"));
    if (!put(text, index)) {
      text.resize(before);
    } else if (lines) {
      text.push_back('\n');
    }
  };
  const std::size_t first_comma = lines ? 0 : 1;
  auto written = writeEach(sink, count, putFeature, threads, first_comma);
  if (!written || lines) return written;
  return sink.write("\n]}\n");
}

}  // namespace vorpipe

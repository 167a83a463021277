/// Features of GeoJSON, in a collection or one to a line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "base/try.h"
#include "io/base/print.h"
#include "vorpipe.h"

namespace vorpipe {

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
/// appends none. Calls put as writeEach() does. Error (device): writing failed.
template <class Put>
Result<void> writeFeatures(ByteSink& sink, FeaturesAs as, std::size_t count, const Put& put, int threads) {
  const bool lines = as == FeaturesAs::lines;
  if (!lines) {
    VORPIPE_TRY(sink.write(R"({"type":"FeatureCollection","features":[)"));
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

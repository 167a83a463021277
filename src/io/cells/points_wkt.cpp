#include "io/base/print.h"
#include "io/cells/points_file.h"

namespace vorpipe {
namespace {

/// One POINT per line.
Result<void> writeWktPoints(ByteSink& sink, const PointsOutput& output) {
  const auto put = [&](Bytes& text, std::size_t site) {
    print(text, FMT_COMPILE("POINT ({} {})\n"), output.sites.x[site], output.sites.y[site]);
  };
  return writeEach(sink, output.sites.size(), put, output.threads);
}

}  // namespace

extern const PointsFormat wkt_points;
const PointsFormat wkt_points{.extension = ".wkt", .write = writeWktPoints};

}  // namespace vorpipe

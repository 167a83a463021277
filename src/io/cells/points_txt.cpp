#include "io/base/print.h"
#include "io/cells/points_file.h"

namespace vorpipe {
namespace {

/// One site per line: x, y, and its weight if it has one.
Result<void> writeTxtPoints(ByteSink& sink, const PointsOutput& output) {
  const Sites& sites = output.sites;
  const auto put = [&](Bytes& text, std::size_t site) {
    print(text, FMT_COMPILE("{} {}"), sites.x[site], sites.y[site]);
    if (!sites.weight.empty()) print(text, FMT_COMPILE(" {}"), sites.weight[site]);
    text.push_back('\n');
  };
  return writeEach(sink, sites.size(), put, output.threads);
}

}  // namespace

extern const PointsFormat txt_points;
const PointsFormat txt_points{.extension = ".txt", .write = writeTxtPoints};

}  // namespace vorpipe

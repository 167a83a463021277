#include "io/base/npy_array.h"
#include "io/base/print.h"
#include "io/cells/points_file.h"

namespace vorpipe {
namespace {

/// float64, a row for each site: x, y, and its weight if it has one.
Result<void> writeNpyPoints(ByteSink& sink, const PointsOutput& output) {
  const Sites& sites = output.sites;
  const bool weighted = !sites.weight.empty();
  const std::uint64_t shape[] = {sites.size(), weighted ? 3U : 2U};
  return sink.write(npyHeader(npyType<double>(), shape)).and_then([&] {
    return writeEach(sink, sites.size(), [&](Bytes& bytes, std::size_t site) {
      const auto add = [&bytes](double number) {
        const auto* const first = reinterpret_cast<const char*>(&number);
        bytes.append(first, first + sizeof(number));
      };
      add(sites.x[site]);
      add(sites.y[site]);
      if (weighted) add(sites.weight[site]);
    });
  });
}

}  // namespace

extern const PointsFormat npy_points;
const PointsFormat npy_points{.extension = ".npy", .write = writeNpyPoints};

}  // namespace vorpipe

#include "io/base/print.h"
#include "io/cells/edges_file.h"

namespace vorpipe {
namespace {

/// Columns edge,site_a,site_b,length,x1,y1,x2,y2.
Result<void> writeCsvEdges(ByteSink& sink, const EdgesOutput& output) {
  return sink.write("edge,site_a,site_b,length,x1,y1,x2,y2\n").and_then([&] {
    const auto put = [&](Bytes& text, std::size_t edge) {
      const EdgeLine line = edgeLine(output, edge);
      print(text, FMT_COMPILE("{},{},{},{},{},{},{},{}\n"), edge, line.site_a, line.site_b, line.length,
            line.begin.x, line.begin.y, line.end.x, line.end.y);
    };
    return writeEach(sink, output.topology.edge_entry.size(), put, output.threads);
  });
}

}  // namespace

extern const EdgesFormat csv_edges;
const EdgesFormat csv_edges{.extension = ".csv", .write = writeCsvEdges};

}  // namespace vorpipe

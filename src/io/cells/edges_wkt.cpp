#include "io/base/print.h"
#include "io/cells/edges_file.h"

namespace vorpipe {
namespace {

/// Writes a line for each edge, from its beginning to its end.
Result<void> writeWktEdges(ByteSink& sink, const EdgesOutput& output) {
  const std::size_t count = output.topology.edge_entry.size();
  if (count == 0) return sink.write("GEOMETRYCOLLECTION EMPTY\n");
  return sink.write("GEOMETRYCOLLECTION (")
      .and_then([&] {
        const auto put = [&](Bytes& text, std::size_t edge) {
          const EdgeLine line = edgeLine(output, edge);
          print(text, FMT_COMPILE("{}\nLINESTRING ({} {}, {} {})"), edge == 0 ? "" : ",", line.begin.x,
                line.begin.y, line.end.x, line.end.y);
        };
        return writeEach(sink, count, put, output.threads);
      })
      .and_then([&] { return sink.write("\n)\n"); });
}

}  // namespace

extern const EdgesFormat wkt_edges;
const EdgesFormat wkt_edges{.extension = ".wkt", .write = writeWktEdges};

}  // namespace vorpipe

/// Writes the edges of cells as lines, in a file of any known kind.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/base/byte_sink.h"
#include "io/base/coordinate_system.h"
#include "vorpipe.h"

namespace vorpipe {

/// The edges of a diagram, each once.
struct EdgesOutput {
  const Diagram& diagram;
  const Topology& topology;   ///< of the diagram
  CoordinateSystem system{};  ///< of all positions
  int threads = 0;            ///< that format text; 0 for all
};

/// A kind of file for edges. Each has a writer and a line in edges_file.cpp.
struct EdgesFormat {
  std::string_view extension;
  /// The errors are those of writeEdges.
  Result<void> (*write)(ByteSink& sink, const EdgesOutput& output);
  bool in_memory = false;  ///< whether the whole file is in memory before it is written
};

/// The extensions of all kinds, in the order in which messages name them.
std::vector<std::string_view> edgesExtensions();

/// The format that the path's extension names; never null. Error (input): it names none.
Result<const EdgesFormat*> edgesFormatOf(const std::string& path);

/// Writes the edges in the topology's order: that of their first cells. Equal cells give equal bytes, and
/// numbers in text read back to the same double. Each edge has its number, its two sites and its length.
/// Error (device): writing failed or memory ran out.
Result<void> writeEdges(ByteSink& sink, const EdgesOutput& output, const EdgesFormat& format);

}  // namespace vorpipe

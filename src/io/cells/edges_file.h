/// Writes the edges of cells, or of the triangulation of their sites, as lines in a file of any known kind.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/attribute.h"
#include "io/base/byte_sink.h"
#include "io/base/coordinate_system.h"
#include "vorpipe.h"

namespace vorpipe {

/// A line between two cells, or from a site to another.
struct EdgeLine {
  Point begin, end;
  std::int64_t site_a;  ///< of cells: on its left
  std::int64_t site_b;  ///< of cells: on its right, a site or a wall (isWall())
  double length;
};

/// Lines, and what all of their files say.
struct LinesOutput {
  std::string_view layer;  ///< of a GeoPackage
  std::size_t count;
  std::function<EdgeLine(std::size_t)> line;
  CoordinateSystem system{};         ///< of all positions
  int threads = 0;                   ///< that format text; 0 for all
  const Attribute* names = nullptr;  ///< of sites, in place of their numbers
  /// Points that lines share, and the two of a line; empty: each has its own ends.
  std::span<const Point> points{};
  std::function<std::array<std::uint32_t, 2>(std::size_t)> ends{};
  /// On the globe: the points of a line, a great circle, as of globeEdge(). Empty elsewhere, where lines are
  /// straight.
  std::function<std::vector<Point>(std::size_t)> path{};
};

/// Returns the edges of a diagram, each once, in the topology's order: that of their first cells. All must
/// outlive the lines.
LinesOutput edgesOf(const Sites& sites, const Diagram& diagram, const Topology& topology,
                    const CoordinateSystem& system);

/// The edges of a triangulation, each once.
struct TriangulationLines {
  std::vector<SitePair> sites;
  std::vector<double> lengths;
};

/// Finds them for sites in the plane, or on the globe, of a diagram with triangles.
TriangulationLines triangulationLines(const Sites& sites, const Diagram& diagram);

/// Returns them as lines between sites as files have them. Both must outlive the lines.
LinesOutput linesOf(const TriangulationLines& lines, const Sites& shown, const CoordinateSystem& system);

/// A kind of file for edges. Each has a writer and a line in edges_file.cpp.
struct EdgesFormat {
  std::string_view extension;
  /// The errors are those of writeLines.
  Result<void> (*write)(ByteSink& sink, const LinesOutput& output);
  bool in_memory = false;  ///< whether the whole file is in memory before it is written
  bool names = false;      ///< whether it can have names of sites
};

/// The extensions of all kinds, in the order in which messages name them.
std::vector<std::string_view> edgesExtensions();

/// The format that the path's extension names; never null. Error (input): it names none.
Result<const EdgesFormat*> edgesFormatOf(const std::string& path);

/// Writes lines in their order. Equal lines give equal bytes, and numbers in text read back to the same
/// double. Each has its number, its two sites and its length. Error (device): writing failed or memory ran
/// out.
Result<void> writeLines(ByteSink& sink, const LinesOutput& output, const EdgesFormat& format);

}  // namespace vorpipe

/// Writes sites as a file of any known kind from which sites can be read.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/attribute.h"
#include "io/base/byte_sink.h"
#include "io/base/coordinate_system.h"
#include "vorpipe.h"

namespace vorpipe {

struct PointsOutput {
  const Sites& sites;
  std::span<const Attribute> attributes{};  ///< each as long as the sites
  CoordinateSystem system{};
  int threads = 0;  ///< that format text; 0 for all
};

/// A kind of file for sites. Each has a writer and a line in points_file.cpp.
struct PointsFormat {
  std::string_view extension;
  /// The errors are those of writePoints.
  Result<void> (*write)(ByteSink& sink, const PointsOutput& output);
  bool attributes = false;  ///< whether it contains those of the input
  bool in_memory = false;   ///< whether the whole file is in memory before it is written
};

/// The extensions of all kinds, in the order in which messages name them.
std::vector<std::string_view> pointsExtensions();

/// The format that the path's extension names; never null. Error (input): it names none.
Result<const PointsFormat*> pointsFormatOf(const std::string& path);

/// Writes sites in input order, so that readSites reads back the same numbers and attributes; equal sites
/// give equal bytes. Errors: too many attributes for the kind of file (input); writing failed or memory ran
/// out (device).
Result<void> writePoints(ByteSink& sink, const PointsOutput& output, const PointsFormat& format);

}  // namespace vorpipe

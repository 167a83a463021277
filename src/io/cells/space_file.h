/// Writes cells in space as a file of any known kind.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/attribute.h"
#include "io/base/byte_sink.h"
#include "vorpipe.h"

namespace vorpipe {

/// Cells in space, and further contents of their records.
struct SpaceOutput {
  std::span<const Point3> sites;
  const Diagram3& diagram;
  std::span<const Attribute> attributes{};  ///< each as long as the sites
  Detail3 detail = Detail3::polyhedra;      ///< what the diagram has
  int threads = 0;                          ///< that format text; 0 for all
  std::span<const double> weights{};        ///< of the sites, or none
  std::string_view voro_format{};           ///< of a .vol, which checkVoroFormat() took; empty: its usual one
  const Attribute* names = nullptr;         ///< of sites in a .vol; null: their numbers
};

/// A kind of file for cells in space.
struct SpaceFormat {
  std::string_view extension;
  Detail3 detail;  ///< the parts of a Diagram3 that it needs; .npz also writes less
  /// Errors: more vertices than an index counts (input); writing failed or memory ran out (device).
  Result<void> (*write)(ByteSink& sink, const SpaceOutput& output);
  bool attributes = false;      ///< whether it contains those of the input
  bool only_polyhedra = false;  ///< whether it leaves out cells that are flat
};

/// Whether a text is a format of Voro++'s option -c: any text with codes such as %i. The error says what is
/// wrong with it.
tl::expected<void, std::string> checkVoroFormat(std::string_view format);

/// The extensions of all kinds, in the order in which messages name them.
std::vector<std::string_view> spaceExtensions();

/// The format that the path's extension names; never null. Error (input): it names none.
Result<const SpaceFormat*> spaceFormatOf(const std::string& path);

/// Writes cells in input order; equal cells give equal bytes. Numbers in text read back to the same double.
Result<void> writeSpaceCells(ByteSink& sink, const SpaceOutput& output, const SpaceFormat& format);

}  // namespace vorpipe

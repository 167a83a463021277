/// Writes the pieces of cells in the features of an outline, as a file of any known kind.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/attribute.h"
#include "io/base/byte_sink.h"
#include "io/base/coordinate_system.h"
#include "vorpipe.h"
#include "vorpipe/pieces.h"

namespace vorpipe {

/// Pieces, and what their records say of features and sites.
struct PiecesOutput {
  const Pieces& pieces;
  const Sites& sites;                         ///< all
  const Attribute& by;                        ///< names of the features
  std::span<const Attribute> attributes{};    ///< of the sites
  CoordinateSystem system{};                  ///< of all positions
  std::optional<double> square_kilometers{};  ///< in a unit of area, if that is known
  int threads = 0;                            ///< that format text; 0 for all
};

/// A kind of file for pieces. Each has a writer and a line in pieces_file.cpp.
struct PiecesFormat {
  std::string_view extension;
  /// The errors are those of writePieces.
  Result<void> (*write)(ByteSink& sink, const PiecesOutput& output);
};

/// The extensions of all kinds, in the order in which messages name them.
std::vector<std::string_view> piecesExtensions();

/// The format of that extension; null if there is none.
const PiecesFormat* piecesFormat(std::string_view extension);

/// Writes a record for each piece: the name of its feature, site, x, y, weight (if sites have one), area,
/// area_km2 (if that is known), share of the feature, and the attributes of the site. Equal pieces give equal
/// bytes. Error (device): writing failed or memory ran out.
Result<void> writePieces(ByteSink& sink, const PiecesOutput& output, const PiecesFormat& format);

}  // namespace vorpipe

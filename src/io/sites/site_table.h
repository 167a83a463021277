/// Sites of a file, with all their data in it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/attribute.h"
#include "io/base/coordinate_system.h"
#include "vorpipe.h"

namespace vorpipe {

/// An attribute that each row must have a value of, just as a place.
struct NeededAttribute {
  std::string name;
  std::function<tl::expected<void, std::string>(std::string_view)> check;  ///< what is wrong with a value
};

/// How to read a file with sites, if the file does not define it.
struct ReadOptions {
  /// The kind of file by its extension, without the dot: "csv", "geojson". Empty: the path's own; "csv" for
  /// standard input.
  std::string format{};
  /// X,Y or X,Y,W: names in any case, or numbers from 1. One name: a column of WKT points. Empty: as in the
  /// header.
  std::vector<std::string> columns{};
  std::string layer{};        ///< of a GeoPackage; empty: its only one with points
  bool skip_missing = false;  ///< leaves out rows without a place, or with an empty weight, and counts them
  bool attributes = true;     ///< whether attributes are kept
  std::optional<NeededAttribute> needed{};  ///< if there is one of that name; it is kept
};

struct SiteTable {
  Sites sites;
  std::vector<Attribute> attributes{};  ///< in the file's order, each as long as the sites
  CoordinateSystem system{};
  std::uint64_t skipped = 0;         ///< rows that were left out
  std::vector<std::string> notes{};  ///< what was reinterpreted or ignored: a line each, with the file's name
};

}  // namespace vorpipe

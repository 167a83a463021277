/// Fields of cells and sites that several formats share: attributes of the input, status, neighbors.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/attribute.h"
#include "io/base/geopackage.h"
#include "io/base/print.h"
#include "io/cells/cells_file.h"
#include "vorpipe.h"

namespace vorpipe {

/// Fields of cells that only some runs have: a cell's area over `divisor`.
struct AddedField {
  std::string_view name;
  double divisor;
};

/// Returns area_km2 if the output's system has a known unit, and share if it is wanted.
std::vector<AddedField> addedFields(const CellsOutput& output);

/// Returns the names of attributes in files of cells. A name gets the prefix input_, repeatedly if necessary,
/// if it is empty, or is that of an earlier attribute or of a vorpipe field in any format. Names that differ
/// only in case count as equal, as in databases.
std::vector<std::string> attributeNames(std::span<const Attribute> attributes,
                                        std::span<const AddedField> added = {});

/// The same for files of pieces, first the name of the features' attribute, which gets the prefix feature_,
/// and of sites' attributes, which get site_.
std::vector<std::string> pieceAttributeNames(const Attribute& by, std::span<const Attribute> attributes);

/// The same for files of sites: the fields are names that readers take for a position or a weight.
std::vector<std::string> pointAttributeNames(std::span<const Attribute> attributes);

/// Returns a line that lists the attributes renamed in files of cells; empty if all keep their names.
std::string renamingNote(std::span<const Attribute> attributes, std::span<const AddedField> added = {});

/// The same two for cells in space.
std::vector<std::string> attributeNamesInSpace(std::span<const Attribute> attributes);
std::string renamingNoteInSpace(std::span<const Attribute> attributes);

/// Appends names as CSV fields, each after a comma.
void printCsvNames(Bytes& text, std::span<const std::string> names);

/// Appends a site's values as CSV fields, each after a comma; nothing for one that is missing.
void printCsvValues(Bytes& text, std::span<const Attribute> attributes, std::size_t site);

/// Returns names as JSON strings, each with the colon after it.
std::vector<std::string> jsonKeys(std::span<const std::string> names);

/// Appends a site's value as JSON; null if it is missing.
void printJsonValue(Bytes& text, const Attribute& attribute, std::size_t site);

/// Appends the fields of a GeoPackage that hold attributes under these names.
void addAttributeFields(std::vector<LayerField>& fields, std::span<const Attribute> attributes,
                        std::span<const std::string> names);

/// Returns a site's name, or a wall's: "xmin", "outline".
std::string_view nameOfSite(const Attribute& names, std::int64_t site);

std::string_view statusWord(Status status);

/// Returns the neighbors of a site for a list of names: each once, however many edges it has; all if each
/// edge has a shift.
std::vector<std::int64_t> namedNeighbors(const Diagram& diagram, std::size_t site);

/// Appends the neighbors of a site, separated by spaces; named ones, which may have spaces, each once by
/// semicolons, and walls by their names.
void printNeighbors(Bytes& text, const CellsOutput& output, std::size_t site);

/// Appends a site or a wall as JSON: its number, or if sites are named its name.
void printJsonSite(Bytes& text, const Attribute* names, std::int64_t site);

/// Appends their shifts, each kx:ky, separated by spaces.
void printShifts(Bytes& text, const Diagram& diagram, std::size_t site);

}  // namespace vorpipe

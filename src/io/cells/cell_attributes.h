/// Attributes of the input as additional fields of cells.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "io/base/attribute.h"
#include "io/base/print.h"

namespace vorpipe {

/// Returns the names of attributes in files of cells. A name gets the prefix input_, repeatedly if necessary,
/// if it is empty, or is that of an earlier attribute or of a vorpipe field in any format. Names that differ
/// only in case count as equal, as in databases.
std::vector<std::string> attributeNames(std::span<const Attribute> attributes);

/// Returns a line that lists the attributes renamed in files of cells; empty if all keep their names.
std::string renamingNote(std::span<const Attribute> attributes);

/// Appends a site's value as JSON; null if it is missing.
void printJsonValue(Bytes& text, const Attribute& attribute, std::size_t site);

/// Appends a site's value as a CSV field; nothing if it is missing.
void printCsvValue(Bytes& text, const Attribute& attribute, std::size_t site);

}  // namespace vorpipe

/// Attributes of the input as further fields of cells.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "io/base/attribute.h"
#include "io/base/print.h"

namespace vorpipe {

/// The names under which attributes stand in files of cells: their own; but one that a field of vorpipe's has
/// in any format, or an attribute before it, or that is empty, begins with input_, as often as it takes.
/// Names that differ in their case alone are one, as they are to databases.
std::vector<std::string> attributeNames(std::span<const Attribute> attributes);

/// A line that says which attributes have other names in files of cells; empty where all have their own.
std::string renamingNote(std::span<const Attribute> attributes);

/// Appends a site's value as JSON; null where it is missing.
void printJsonValue(Bytes& text, const Attribute& attribute, std::size_t site);

/// Appends a site's value as a field of CSV; nothing where it is missing.
void printCsvValue(Bytes& text, const Attribute& attribute, std::size_t site);

}  // namespace vorpipe

/// Writes any text as a field of a file.
#pragma once

#include <string>
#include <string_view>

#include "io/base/print.h"

namespace vorpipe {

/// Appends a CSV field by RFC 4180. Quotes it if it has a comma, a quote, a line end, or blanks at an end. An
/// empty field is also in double quotes, to differ from a missing one.
void printCsvField(Bytes& text, std::string_view field);

/// Appends a JSON string: in double quotes, with control characters escaped and invalid UTF-8 replaced.
void printJsonString(Bytes& text, std::string_view string);

/// Returns `text` with invalid UTF-8 replaced.
std::string utf8Of(std::string_view text);

}  // namespace vorpipe

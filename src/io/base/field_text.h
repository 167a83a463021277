/// Text of any kind as a field of a file.
#pragma once

#include <string>
#include <string_view>

#include "io/base/print.h"

namespace vorpipe {

/// Appends a field of CSV by RFC 4180: in double quotes where it has a comma, a quote, a line's end or blanks
/// at an end, or is empty, so that it differs from one that is missing.
void printCsvField(Bytes& text, std::string_view field);

/// Appends a string of JSON: in double quotes, with control characters escaped, and what is no UTF-8
/// replaced.
void printJsonString(Bytes& text, std::string_view string);

/// `text`, with what is no UTF-8 replaced.
std::string utf8Of(std::string_view text);

}  // namespace vorpipe

/// Finds the field separator of a table from its first line.
#pragma once

#include <optional>
#include <string_view>

namespace vorpipe {

/// Returns the separator of a line's fields: comma, semicolon or tab. Prefers one with only numbers between,
/// which may have decimal commas unless it is a comma. Otherwise returns the most frequent one; a comma if
/// there is none.
char separatorOf(std::string_view line);

/// Returns the separator that a line "sep=;" names; spreadsheets write it as the first line.
std::optional<char> namedSeparator(std::string_view line);

}  // namespace vorpipe

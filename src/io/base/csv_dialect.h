/// What separates the fields of a table, told from its first line.
#pragma once

#include <optional>
#include <string_view>

namespace vorpipe {

/// Of a comma, a semicolon and a tab, what stands between the fields of a line: if all that it then separates
/// are numbers, which may have decimal commas where it is no comma, that; else what there is most of. A comma
/// where there is none.
char separatorOf(std::string_view line);

/// The separator that a line "sep=;" names, which spreadsheets write before all others.
std::optional<char> namedSeparator(std::string_view line);

}  // namespace vorpipe

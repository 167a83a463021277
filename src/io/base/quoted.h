/// Text of files and options in messages.
#pragma once

#include <string>
#include <string_view>

namespace vorpipe {

/// Returns `text` as one line that a terminal shows but does not obey. UTF-8 stays, except characters that
/// end a line, control a terminal or change the writing direction. Their bytes, and invalid UTF-8, become
/// \xNN.
std::string escaped(std::string_view text);

/// The same, cut after at most 40 bytes of `text`, between characters.
std::string printable(std::string_view text);

/// The same in double quotes.
std::string inQuotes(std::string_view text);

}  // namespace vorpipe

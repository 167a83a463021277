/// Text of files and options in messages.
#pragma once

#include <string>
#include <string_view>

namespace vorpipe {

/// `text` as one line that a terminal shows and does not obey: UTF-8 stays, but for characters that end a
/// line, control a terminal or turn the direction of writing. Their bytes, and those that are no UTF-8, are
/// \xNN.
std::string escaped(std::string_view text);

/// The same, cut after 40 bytes of `text`, at a whole character.
std::string printable(std::string_view text);

/// The same in double quotes.
std::string inQuotes(std::string_view text);

}  // namespace vorpipe

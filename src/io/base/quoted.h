/// Text of unknown encoding, and how messages and command lines show it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vorpipe {

/// Returns `text` as one line that a terminal shows but does not obey. UTF-8 stays, except characters that
/// end a line, control a terminal or change the writing direction. Their bytes, and invalid UTF-8, become
/// \xNN.
std::string escaped(std::string_view text);

/// The same, cut after at most 40 bytes of `text`, between characters.
std::string printable(std::string_view text);

/// The same in double quotes.
std::string inQuotes(std::string_view text);

/// Returns `text` as one word of bash or zsh: in single quotes, which are closed for each one inside.
std::string shellQuoted(std::string_view text);

/// Joins words with blanks so that a shell reads each as it is: quoted if necessary. A word that a terminal
/// would partly take for a command is in $'...', as in bash, zsh and ksh.
std::string shellLine(const std::vector<std::string>& words);

/// Whether all bytes form characters of UTF-8; surrogates and overlong forms are none.
bool isUtf8(std::string_view bytes);

/// Converts text in Windows-1252, which includes Latin-1, to UTF-8.
std::string fromWindows1252(std::string_view bytes);

}  // namespace vorpipe

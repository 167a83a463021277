/// Command lines as they can be typed.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vorpipe {

/// Returns `text` as one word of bash or zsh: in single quotes, which are closed for each one inside.
std::string shellQuoted(std::string_view text);

/// Joins words with blanks so that a shell reads each as it is: quoted if necessary. A word that a terminal
/// would partly take for a command is in $'...', as in bash, zsh and ksh.
std::string shellLine(const std::vector<std::string>& words);

}  // namespace vorpipe

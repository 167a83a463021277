/// Command lines as they can be typed.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vorpipe {

/// `text` as one word of bash or zsh: in single quotes, which end for each one inside.
std::string shellQuoted(std::string_view text);

/// Words with blanks between, each of which a shell reads as it is: quoted where it needs to be, and in
/// $'...', which bash, zsh and ksh know, where a terminal would take a part of it for a command.
std::string shellLine(const std::vector<std::string>& words);

}  // namespace vorpipe

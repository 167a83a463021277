/// Scripts that teach shells to complete the command line.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/options/declared.h"

namespace vorpipe::cli {

std::string bashCompletions(const DeclaredProgram& program);
std::string zshCompletions(const DeclaredProgram& program);
std::string fishCompletions(const DeclaredProgram& program);

/// `text` as one word of bash or zsh: in single quotes, which end for each one inside.
std::string shellQuoted(std::string_view text);

/// Words with blanks between.
std::string spaced(const std::vector<std::string>& words);

}  // namespace vorpipe::cli

/// Completion scripts for shells.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/options/declared.h"

namespace vorpipe::cli {

std::string bashCompletions(const DeclaredProgram& program);
std::string zshCompletions(const DeclaredProgram& program);
std::string fishCompletions(const DeclaredProgram& program);

/// Joins words with blanks.
std::string spaced(const std::vector<std::string>& words);

}  // namespace vorpipe::cli

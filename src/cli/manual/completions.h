/// Completion scripts for shells.
#pragma once

#include <string>

#include "cli/options/declared.h"

namespace vorpipe::cli {

std::string bashCompletions(const DeclaredProgram& program);
std::string zshCompletions(const DeclaredProgram& program);
std::string fishCompletions(const DeclaredProgram& program);

/// Returns the start of a description: up to its first `:`, `;`, `[` or the end of its first sentence.
std::string briefly(const std::string& description);

}  // namespace vorpipe::cli

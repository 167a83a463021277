/// Man pages, in roff with the macros of man(7).
#pragma once

#include <string>

#include "cli/options/declared.h"

namespace vorpipe::cli {

/// Returns the page vorpipe(1).
std::string programPage(const DeclaredProgram& program);

/// Returns a page such as vorpipe-cells(1).
std::string subcommandPage(const DeclaredProgram& program, const DeclaredSubcommand& subcommand);

}  // namespace vorpipe::cli

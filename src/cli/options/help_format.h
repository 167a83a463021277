/// The layout of --help.
#pragma once

#include <memory>

namespace CLI {
class FormatterBase;
}  // namespace CLI

namespace vorpipe::cli {

/// Options by their groups, in the order of optionGroups().
std::shared_ptr<CLI::FormatterBase> helpFormat();

}  // namespace vorpipe::cli

/// The declared command line as plain data, the source of man pages and shell completions.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vorpipe::cli {

/// The group of --help and --version.
inline constexpr std::string_view help_group = "Help";

/// Sorts groups of options into the order of help and man pages: from the input to the run.
std::vector<std::string> inOrder(std::vector<std::string> groups);

/// The known choices for the values of an option.
struct Choices {
  std::vector<std::string> words;       ///< a word that ends in : or = is only a prefix
  std::vector<std::string> extensions;  ///< of files that the value may name, each with its dot
  bool listed = false;                  ///< the value is several words, separated by commas

  [[nodiscard]] bool empty() const { return words.empty() && extensions.empty(); }
};

struct DeclaredOption {
  std::vector<std::string> names;  ///< e.g. -h and --help; for an operand, its name in help
  std::string value;               ///< name of the value in help; empty for a flag
  std::string description;
  std::string group;  ///< heading in help
  Choices choices;
  bool required = false;
  bool repeatable = false;
  bool takes_value = false;
  std::vector<std::string> needs, excludes;  ///< names of other options
};

struct DeclaredSubcommand {
  std::string name, description;
  std::vector<DeclaredOption> operands, options;
};

struct DeclaredProgram {
  std::string name, description;
  std::vector<DeclaredOption> options;
  std::vector<DeclaredSubcommand> subcommands;
};

}  // namespace vorpipe::cli

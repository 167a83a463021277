/// What was declared of the command line, as plain data: man pages and the completions of shells are made of
/// it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vorpipe::cli {

/// Of --help and --version.
inline constexpr std::string_view help_group = "Help";

/// Groups of options, in the order in which help and man pages have them: from the input to the run.
std::vector<std::string> inOrder(std::vector<std::string> groups);

/// What is known of the values that an option takes.
struct Choices {
  std::vector<std::string> words;       ///< one that ends in : or = is only a beginning
  std::vector<std::string> extensions;  ///< of the files that it may name, each with its dot
  bool listed = false;                  ///< several words, with commas between them

  [[nodiscard]] bool empty() const { return words.empty() && extensions.empty(); }
};

struct DeclaredOption {
  std::vector<std::string>
      names;          ///< -h and --help; of an operand, which stands without one, what help calls it
  std::string value;  ///< what help calls its value; empty for a flag
  std::string description;
  std::string group;  ///< under which heading help has it
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

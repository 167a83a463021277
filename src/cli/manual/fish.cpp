#include <fmt/format.h>

#include "cli/manual/brief.h"
#include "cli/manual/completions.h"

namespace vorpipe::cli {
namespace {

/// Quotes a word for fish; inside single quotes, a backslash escapes a quote or a backslash.
std::string fishQuoted(std::string_view text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "'";
}

/// Functions that complete one value, which may be joined to its option by =.
constexpr std::string_view functions = R"fish(
# Folders, and files that end in one of the arguments; all files where there are none of these.
function __vorpipe_files
    set -l typed (commandline -ct | string replace -r -- '^--[a-z-]+=' '')
    set -l paths (complete -C "'' $typed" | string split -f1 \t)
    set -l endings (string join '|' -- '/' (string escape --style=regex -- $argv))
    set -l fitting (string match -rie -- "(?:$endings)\$" $paths)
    set -q fitting[1]; or set fitting $paths
    string join \n -- $fitting
end

# The names in the arguments, after those of a list with commas that are there.
function __vorpipe_list
    set -l typed (commandline -ct | string replace -r -- '^--[a-z-]+=' '')
    set -l listed (string match -r -- '^.*,' $typed; or echo '')
    for name in $argv
        contains -- $name (string split , -- $listed); or echo $listed$name
    end
end
)fish";

/// Returns the choices for a value, as arguments of complete.
std::string value(const Choices& choices) {
  if (choices.listed)
    return fmt::format(" -a {}", fishQuoted(fmt::format("(__vorpipe_list {})", spaced(choices.words))));
  std::vector<std::string> offered = choices.words;
  if (!choices.extensions.empty())
    offered.push_back(fmt::format("(__vorpipe_files {})", spaced(choices.extensions)));
  return offered.empty() ? "" : fmt::format(" -a {}", fishQuoted(spaced(offered)));
}

std::string line(const DeclaredProgram& program, std::string_view condition, const DeclaredOption& option) {
  std::string script = fmt::format("complete -c {} -n {}", program.name, fishQuoted(condition));
  for (const std::string& name : option.names) {
    script += name.starts_with("--") ? fmt::format(" -l {}", name.substr(2))
                                     : fmt::format(" -s {}", name.substr(1));
  }
  // -x: offers only files with the known extensions.
  if (option.takes_value) script += " -x";
  script += value(option.choices);
  return script + fmt::format(" -d {}\n", fishQuoted(briefly(option.description)));
}

}  // namespace

std::string fishCompletions(const DeclaredProgram& program) {
  std::string script = fmt::format(
      "# fish completions of {0}; it wrote them itself.\n{1}\ncomplete -c {0} -f\n", program.name, functions);
  constexpr std::string_view first = "__fish_use_subcommand";
  for (const DeclaredSubcommand& subcommand : program.subcommands) {
    script += fmt::format("complete -c {} -n {} -a {} -d {}\n", program.name, first, subcommand.name,
                          fishQuoted(briefly(subcommand.description)));
  }
  for (const DeclaredOption& option : program.options) script += line(program, first, option);
  for (const DeclaredSubcommand& subcommand : program.subcommands) {
    const std::string condition = "__fish_seen_subcommand_from " + subcommand.name;
    for (const DeclaredOption& option : subcommand.options) script += line(program, condition, option);
    if (!subcommand.operands.empty()) {
      script += fmt::format("complete -c {} -n {}{}\n", program.name, fishQuoted(condition),
                            value(subcommand.operands.front().choices));
    }
  }
  return script;
}

}  // namespace vorpipe::cli

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/manual/brief.h"
#include "cli/manual/completions.h"

namespace vorpipe::cli {
namespace {

/// A word of fish, where a backslash inside single quotes stands before a quote or another one.
std::string fishQuoted(std::string_view text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "'";
}

/// What may stand for a value, as arguments of complete.
std::string value(const Choices& choices) {
  if (choices.listed) {
    return fmt::format(" -a {}", fishQuoted(fmt::format("(__fish_complete_list , \"printf '%s\\n' {}\")",
                                                        spaced(choices.words))));
  }
  std::vector<std::string> offered = choices.words;
  if (!choices.extensions.empty())
    offered.push_back(fmt::format("(__fish_complete_suffix {})", spaced(choices.extensions)));
  return offered.empty() ? "" : fmt::format(" -k -a {}", fishQuoted(spaced(offered)));
}

std::string line(const DeclaredProgram& program, std::string_view condition, const DeclaredOption& option) {
  std::string script = fmt::format("complete -c {} -n {}", program.name, fishQuoted(condition));
  for (const std::string& name : option.names) {
    script += name.starts_with("--") ? fmt::format(" -l {}", name.substr(2))
                                     : fmt::format(" -s {}", name.substr(1));
  }
  // -x: files are offered by their extensions alone.
  if (option.takes_value) script += " -x";
  script += value(option.choices);
  return script + fmt::format(" -d {}\n", fishQuoted(briefly(option.description)));
}

}  // namespace

std::string fishCompletions(const DeclaredProgram& program) {
  std::string script =
      fmt::format("# fish completions of {0}; it wrote them itself.\ncomplete -c {0} -f\n", program.name);
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

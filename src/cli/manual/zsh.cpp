#include <fmt/format.h>

#include "cli/manual/brief.h"
#include "cli/manual/completions.h"
#include "io/base/quoted.h"

namespace vorpipe::cli {
namespace {

/// Completes a value by the words in $1 and by files with the extensions in $2. A word that ends in : or = is
/// only a prefix.
constexpr std::string_view functions = R"zsh(
_vorpipe_value() {
  local -a words=(${=1}) extensions=(${=2}) expl
  local -a begun=(${(M)words:#*[:=]}) whole=(${words:#*[:=]})
  local found=1
  if (( $#whole )); then _wanted values expl value compadd -a whole && found=0; fi
  if (( $#begun )); then _wanted values expl value compadd -S '' -a begun && found=0; fi
  if (( $#extensions )); then _files -g "(#i)*(${(j:|:)extensions})" && found=0; fi
  return found
}
)zsh";

/// Escapes text for use inside [ ] or between colons in a specification for _arguments.
std::string inSpecification(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

/// Returns ":NAME:ACTION", for an option's value or an operand.
std::string value(const std::string& name, const Choices& choices) {
  std::string action = " ";
  if (choices.listed) {
    action = fmt::format("_sequence compadd - {}", spaced(choices.words));
  } else if (!choices.empty()) {
    // The blank keeps zsh from adding arguments of its own.
    action = fmt::format(" _vorpipe_value \"{}\" \"{}\"", inSpecification(spaced(choices.words)),
                         spaced(choices.extensions));
  }
  return fmt::format(":{}:{}", inSpecification(name.empty() ? "value" : name), action);
}

/// Returns the names that an option excludes.
std::string excluded(const DeclaredOption& option) {
  if (option.names.back() == "--help" || option.names.back() == "--version") return "(- *)";
  return option.excludes.empty() ? "" : fmt::format("({})", spaced(option.excludes));
}

/// Returns the specifications of an option, one for each name.
std::string specifications(const DeclaredOption& option) {
  std::string script;
  for (const std::string& name : option.names) {
    std::string spec = option.repeatable ? "*" : excluded(option);
    spec += name;
    if (option.takes_value) spec += name.starts_with("--") ? "=" : "+";
    spec += fmt::format("[{}]", inSpecification(briefly(option.description)));
    if (option.takes_value) spec += value(option.value, option.choices);
    script += fmt::format(" \\\n        {}", shellQuoted(spec));
  }
  return script;
}

std::string subcommandCase(const DeclaredSubcommand& subcommand) {
  std::string script = fmt::format("    {})\n      _arguments -s", subcommand.name);
  for (const DeclaredOption& option : subcommand.options) script += specifications(option);
  for (const DeclaredOption& operand : subcommand.operands) {
    const std::string spec = (operand.repeatable ? "*" : "") + value(operand.names.front(), operand.choices);
    script += fmt::format(" \\\n        {}", shellQuoted(spec));
  }
  return script + " ;;\n";
}

}  // namespace

std::string zshCompletions(const DeclaredProgram& program) {
  std::string script = fmt::format("#compdef {}\n# zsh completions of {}; it wrote them itself.\n{}",
                                   program.name, program.name, functions);
  script += "\n_vorpipe() {\n  local -a subcommands=(\n";
  for (const DeclaredSubcommand& subcommand : program.subcommands) {
    script += fmt::format(
        "    {}\n", shellQuoted(subcommand.name + ":" + inSpecification(briefly(subcommand.description))));
  }
  script += "  )\n  if (( CURRENT == 2 )) && [[ $words[2] != -* ]]; then\n";
  script += "    _describe subcommand subcommands\n    return\n  fi\n";
  script += "  if (( CURRENT == 2 )); then\n    _arguments";
  for (const DeclaredOption& option : program.options) script += specifications(option);
  script += "\n    return\n  fi\n  shift words\n  (( CURRENT-- ))\n  case $words[1] in\n";
  for (const DeclaredSubcommand& subcommand : program.subcommands) script += subcommandCase(subcommand);
  return script +
         "  esac\n}\n\nif [[ $zsh_eval_context[-1] == loadautofunc ]]; then\n  _vorpipe \"$@\"\nelse\n"
         "  compdef _vorpipe " +
         program.name + "\nfi\n";
}

}  // namespace vorpipe::cli

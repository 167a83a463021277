#include "cli/manual/completions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "io/base/quoted.h"

namespace vorpipe::cli {
namespace {

/// Joins words with blanks.
std::string spaced(const std::vector<std::string>& words) { return fmt::to_string(fmt::join(words, " ")); }

/// Functions that complete one value. They do not need the package bash-completion, so the script works when
/// merely sourced.
constexpr std::string_view bash_functions = R"bash(
# Adds those of the words in $1 that begin with $current. After one that ends in : or = no space is put.
_vorpipe_words() {
  local word
  for word in $1; do
    [[ $word == "$current"* ]] || continue
    COMPREPLY+=("$before$word")
    [[ $word != *[:=] ]] || compopt -o nospace 2>/dev/null
  done
}

# The same for lists with commas: completes the last name, and leaves out those that are there.
_vorpipe_list() {
  local word listed=
  [[ $current != *,* ]] || listed=${current%,*},
  for word in $1; do
    [[ $listed$word == "$current"* && ,$listed != *,"$word",* ]] || continue
    COMPREPLY+=("$before$listed$word")
  done
  compopt -o nospace 2>/dev/null
}

# Adds folders, and files that end in one of the extensions in $1; all files where there are none of these.
_vorpipe_files() {
  local path extension
  local -a paths=() others=()
  while IFS= read -r path; do
    if [[ -d $path ]]; then paths+=("$before$path"); continue; fi
    for extension in $1; do
      if [[ ${path,,} == *"$extension" ]]; then paths+=("$before$path"); continue 2; fi
    done
    others+=("$before$path")
  done < <(compgen -f -- "$current")
  ((${#paths[@]})) || paths=("${others[@]}")
  # Else a word such as random: would be quoted as a file's name.
  if ((${#COMPREPLY[@]} == 0 && ${#paths[@]})); then compopt -o filenames 2>/dev/null; fi
  COMPREPLY+=("${paths[@]}")
}

_vorpipe() {
  local current=${COMP_WORDS[COMP_CWORD]} before= option=
  COMPREPLY=()
  # Bash takes --option=value for three words, unless = has been taken from COMP_WORDBREAKS.
  if [[ $current == --*=* ]]; then
    option=${current%%=*} before=${current%%=*}= current=${current#*=}
  elif [[ $current == '=' ]]; then
    option=${COMP_WORDS[COMP_CWORD - 1]} current=
  elif [[ ${COMP_WORDS[COMP_CWORD - 1]} == '=' ]]; then
    option=${COMP_WORDS[COMP_CWORD - 2]}
    [[ $option == --* ]] || return 0
  else
    option=${COMP_WORDS[COMP_CWORD - 1]}
    [[ $current != ':' && $option != ':' ]] || return 0
  fi
)bash";

std::string bashValue(const Choices& choices) {
  std::string script;
  if (!choices.words.empty()) {
    script += fmt::format("{} {}; ", choices.listed ? "_vorpipe_list" : "_vorpipe_words",
                          shellQuoted(spaced(choices.words)));
  }
  if (!choices.extensions.empty())
    script += fmt::format("_vorpipe_files {}; ", shellQuoted(spaced(choices.extensions)));
  return script;
}

/// Returns a case pattern such as "--sites" or "-h|--help".
std::string pattern(const DeclaredSubcommand& subcommand, const DeclaredOption& option) {
  std::string names;
  for (const std::string& name : option.names)
    names += fmt::format("{}'{} {}'", names.empty() ? "" : "|", subcommand.name, name);
  return names;
}

std::string namesOf(const std::vector<DeclaredOption>& options) {
  std::vector<std::string> names;
  for (const DeclaredOption& option : options)
    names.insert(names.end(), option.names.begin(), option.names.end());
  return spaced(names);
}

/// Returns the completion after an option with a value; offers nothing if its choices are unknown.
std::string afterOptions(const DeclaredProgram& program) {
  std::string script = "  case \"${COMP_WORDS[1]} $option\" in\n";
  for (const DeclaredSubcommand& subcommand : program.subcommands) {
    for (const DeclaredOption& option : subcommand.options) {
      if (!option.takes_value) continue;
      script +=
          fmt::format("    {}) {}return 0 ;;\n", pattern(subcommand, option), bashValue(option.choices));
    }
  }
  return script + "  esac\n";
}

std::string optionsAndOperands(const DeclaredProgram& program) {
  std::string script = "  case ${COMP_WORDS[1]} in\n";
  for (const DeclaredSubcommand& subcommand : program.subcommands) {
    script += fmt::format("    {})\n", subcommand.name);
    if (!subcommand.operands.empty()) {
      script += fmt::format("      if [[ $current != -* ]]; then {}return 0; fi\n",
                            bashValue(subcommand.operands.front().choices));
    }
    script += fmt::format("      _vorpipe_words {} ;;\n", shellQuoted(namesOf(subcommand.options)));
  }
  return script + "  esac\n";
}

/// Quotes a word for fish; inside single quotes, a backslash escapes a quote or a backslash.
std::string fishQuoted(std::string_view text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "'";
}

/// Functions that complete one fishValue, which may be joined to its option by =.
constexpr std::string_view fish_functions = R"fish(
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

/// Returns the choices for a fishValue, as arguments of complete.
std::string fishValue(const Choices& choices) {
  if (choices.listed)
    return fmt::format(" -a {}", fishQuoted(fmt::format("(__vorpipe_list {})", spaced(choices.words))));
  std::vector<std::string> offered = choices.words;
  if (!choices.extensions.empty())
    offered.push_back(fmt::format("(__vorpipe_files {})", spaced(choices.extensions)));
  return offered.empty() ? "" : fmt::format(" -a {}", fishQuoted(spaced(offered)));
}

std::string fishLine(const DeclaredProgram& program, std::string_view condition,
                     const DeclaredOption& option) {
  std::string script = fmt::format("complete -c {} -n {}", program.name, fishQuoted(condition));
  for (const std::string& name : option.names) {
    script += name.starts_with("--") ? fmt::format(" -l {}", name.substr(2))
                                     : fmt::format(" -s {}", name.substr(1));
  }
  // -x: offers only files with the known extensions.
  if (option.takes_value) script += " -x";
  script += fishValue(option.choices);
  return script + fmt::format(" -d {}\n", fishQuoted(briefly(option.description)));
}

/// Completes a zshValue by the words in $1 and by files with the extensions in $2. A word that ends in : or =
/// is only a prefix.
constexpr std::string_view zsh_functions = R"zsh(
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

/// Returns ":NAME:ACTION", for an option's zshValue or an operand.
std::string zshValue(const std::string& name, const Choices& choices) {
  std::string action = " ";
  if (choices.listed) {
    action = fmt::format("_sequence compadd - {}", spaced(choices.words));
  } else if (!choices.empty()) {
    // The blank keeps zsh from adding arguments of its own.
    action = fmt::format(" _vorpipe_value \"{}\" \"{}\"", inSpecification(spaced(choices.words)),
                         spaced(choices.extensions));
  }
  return fmt::format(":{}:{}", inSpecification(name.empty() ? "zshValue" : name), action);
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
    if (option.takes_value) spec += zshValue(option.value, option.choices);
    script += fmt::format(" \\\n        {}", shellQuoted(spec));
  }
  return script;
}

std::string subcommandCase(const DeclaredSubcommand& subcommand) {
  std::string script = fmt::format("    {})\n      _arguments -s", subcommand.name);
  for (const DeclaredOption& option : subcommand.options) script += specifications(option);
  for (const DeclaredOption& operand : subcommand.operands) {
    const std::string spec =
        (operand.repeatable ? "*" : "") + zshValue(operand.names.front(), operand.choices);
    script += fmt::format(" \\\n        {}", shellQuoted(spec));
  }
  return script + " ;;\n";
}

}  // namespace

std::string briefly(const std::string& description) {
  constexpr std::array<std::string_view, 4> ends = {":", ";", " [", ". "};
  std::size_t end = description.size();
  for (const std::string_view mark : ends) end = std::min(end, description.find(mark));
  return description.substr(0, end);
}

std::string bashCompletions(const DeclaredProgram& program) {
  std::vector<std::string> first;
  for (const DeclaredSubcommand& subcommand : program.subcommands) first.push_back(subcommand.name);
  std::string script =
      fmt::format("# bash completions of {}; it wrote them itself.\n{}", program.name, bash_functions);
  script += fmt::format("  if ((COMP_CWORD == 1)); then _vorpipe_words {}; return 0; fi\n",
                        shellQuoted(spaced(first) + " " + namesOf(program.options)));
  script += afterOptions(program) + optionsAndOperands(program);
  return script + fmt::format("}}\ncomplete -F _vorpipe {}\n", program.name);
}

std::string fishCompletions(const DeclaredProgram& program) {
  std::string script =
      fmt::format("# fish completions of {0}; it wrote them itself.\n{1}\ncomplete -c {0} -f\n", program.name,
                  fish_functions);
  constexpr std::string_view first = "__fish_use_subcommand";
  for (const DeclaredSubcommand& subcommand : program.subcommands) {
    script += fmt::format("complete -c {} -n {} -a {} -d {}\n", program.name, first, subcommand.name,
                          fishQuoted(briefly(subcommand.description)));
  }
  for (const DeclaredOption& option : program.options) script += fishLine(program, first, option);
  for (const DeclaredSubcommand& subcommand : program.subcommands) {
    const std::string condition = "__fish_seen_subcommand_from " + subcommand.name;
    for (const DeclaredOption& option : subcommand.options) script += fishLine(program, condition, option);
    if (!subcommand.operands.empty()) {
      script += fmt::format("complete -c {} -n {}{}\n", program.name, fishQuoted(condition),
                            fishValue(subcommand.operands.front().choices));
    }
  }
  return script;
}

std::string zshCompletions(const DeclaredProgram& program) {
  std::string script = fmt::format("#compdef {}\n# zsh completions of {}; it wrote them itself.\n{}",
                                   program.name, program.name, zsh_functions);
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

#include <fmt/format.h>

#include "cli/manual/completions.h"
#include "io/base/quoted.h"

namespace vorpipe::cli {
namespace {

/// Functions that complete one value. They do not need the package bash-completion, so the script works when
/// merely sourced.
constexpr std::string_view functions = R"bash(
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

std::string valueOf(const Choices& choices) {
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
      script += fmt::format("    {}) {}return 0 ;;\n", pattern(subcommand, option), valueOf(option.choices));
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
                            valueOf(subcommand.operands.front().choices));
    }
    script += fmt::format("      _vorpipe_words {} ;;\n", shellQuoted(namesOf(subcommand.options)));
  }
  return script + "  esac\n";
}

}  // namespace

std::string bashCompletions(const DeclaredProgram& program) {
  std::vector<std::string> first;
  for (const DeclaredSubcommand& subcommand : program.subcommands) first.push_back(subcommand.name);
  std::string script =
      fmt::format("# bash completions of {}; it wrote them itself.\n{}", program.name, functions);
  script += fmt::format("  if ((COMP_CWORD == 1)); then _vorpipe_words {}; return 0; fi\n",
                        shellQuoted(spaced(first) + " " + namesOf(program.options)));
  script += afterOptions(program) + optionsAndOperands(program);
  return script + fmt::format("}}\ncomplete -F _vorpipe {}\n", program.name);
}

}  // namespace vorpipe::cli

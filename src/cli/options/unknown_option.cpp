#include "cli/options/unknown_option.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>

#include "cli/options/suggestion.h"
#include "io/base/quoted.h"

namespace vorpipe::cli {
namespace {

/// "--name" of "--name=value", "-n" of "-nvalue".
std::string_view nameIn(std::string_view argument) {
  return argument.starts_with("--") ? argument.substr(0, argument.find('=')) : argument.substr(0, 2);
}

bool isOption(std::string_view argument) {
  if (argument.size() < 2 || argument[0] != '-') return false;
  // Otherwise it is a number.
  return std::isdigit(static_cast<unsigned char>(argument[1])) == 0 && argument[1] != '.';
}

const DeclaredOption* find(const std::vector<DeclaredOption>& options, std::string_view name) {
  const auto found = std::ranges::find_if(options, [&](const DeclaredOption& option) {
    return std::ranges::find(option.names, name) != option.names.end();
  });
  return found == options.end() ? nullptr : &*found;
}

std::string isNone(std::string_view name, const DeclaredSubcommand& subcommand) {
  std::vector<std::string> names;
  for (const DeclaredOption& option : subcommand.options)
    names.insert(names.end(), option.names.begin(), option.names.end());
  // Quotes keep it in one line, whatever was typed.
  const std::string typed = inQuotes(name);
  const std::string hint = didYouMean(name, names);
  // The program's own options are declared as a subcommand with the program's name.
  const std::string page = subcommand.name == "vorpipe" ? subcommand.name : "vorpipe " + subcommand.name;
  return fmt::format("unknown option {}{}", std::string_view(typed).substr(1, typed.size() - 2),
                     hint.empty() ? fmt::format("; see {} --help", page) : hint);
}

}  // namespace

std::string unknownOption(const DeclaredSubcommand& subcommand, std::span<char* const> arguments) {
  for (std::size_t at = 0; at < arguments.size(); ++at) {
    const std::string_view argument = arguments[at];
    if (argument == "--") return {};
    if (!isOption(argument)) continue;
    const std::string_view name = nameIn(argument);
    const DeclaredOption* const option = find(subcommand.options, name);
    if (option == nullptr) return isNone(name, subcommand);
    if (option->group == help_group) return {};
    if (option->takes_value && argument == name) ++at;
  }
  return {};
}

}  // namespace vorpipe::cli

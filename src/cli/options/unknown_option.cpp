#include "cli/options/unknown_option.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <vector>

#include "base/words.h"
#include "io/base/quoted.h"

namespace vorpipe::cli {
namespace {

constexpr std::size_t most_edits = 2;

/// Returns how many letters must be added, omitted, changed, or swapped with the next to turn a into b.
std::size_t edits(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> least(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      std::size_t& here = least[i][j];
      here = i + j;
      if (i == 0 || j == 0) continue;
      const std::size_t changed = a[i - 1] == b[j - 1] ? 0 : 1;
      here = std::min({least[i - 1][j] + 1, least[i][j - 1] + 1, least[i - 1][j - 1] + changed});
      const bool exchanged = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (exchanged) here = std::min(here, least[i - 2][j - 2] + 1);
    }
  }
  return least[a.size()][b.size()];
}

/// Returns the word of `known` most likely meant by `typed`, ignoring case. It differs in at most two letters
/// (added, omitted, changed, or two swapped), or is the shortest word that begins with `typed`. Empty if
/// there is none.
std::string closestTo(std::string_view typed, std::span<const std::string> known) {
  constexpr std::size_t longest = 40;
  const std::string word = lowerCase(typed);
  const std::string_view letters =
      std::string_view(word).substr(std::min(word.find_first_not_of('-'), word.size()));
  if (letters.size() < 2 || word.size() > longest) return {};
  // In a word of three letters, two edits would change nearly everything.
  std::size_t best = std::min(most_edits, letters.size() - 2) + 1;
  std::string closest;
  for (const std::string& candidate : known) {
    const std::size_t distance = edits(word, lowerCase(candidate));
    if (distance >= best) continue;
    best = distance;
    closest = candidate;
  }
  if (!closest.empty()) return closest;
  for (const std::string& candidate : known) {
    if (!lowerCase(candidate).starts_with(word)) continue;
    if (closest.empty() || candidate.size() < closest.size()) closest = candidate;
  }
  return closest;
}

}  // namespace

std::string didYouMean(std::string_view typed, std::span<const std::string> known) {
  const std::string closest = closestTo(typed, known);
  return closest.empty() ? "" : "; did you mean " + closest + "?";
}

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

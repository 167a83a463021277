#include "cli/manual/manual.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "cli/manual/completions.h"
#include "cli/manual/roff.h"
#include "io/base/error.h"
#include "io/base/quoted.h"

namespace vorpipe::cli {
namespace {

struct Shell {
  std::string_view name;
  std::string (*script)(const DeclaredProgram& program);
};

constexpr std::array<Shell, 3> shells = {
    {{"bash", bashCompletions}, {"zsh", zshCompletions}, {"fish", fishCompletions}}};

/// Returns the error "--name: 'x' is not one of a, b, c".
template <class Named>
tl::unexpected<Error> noneOf(std::string_view option, const std::string& text, const Named& known) {
  std::vector<std::string_view> names;
  for (const auto& one : known) names.emplace_back(one.name);
  return inputError(fmt::format("{}: {} is not one of {}", option, inQuotes(text), fmt::join(names, ", ")));
}

Result<std::string> manPage(const DeclaredProgram& program, const std::string& subcommand) {
  if (subcommand.empty()) return programPage(program);
  const auto found = std::ranges::find(program.subcommands, subcommand, &DeclaredSubcommand::name);
  if (found == program.subcommands.end()) return noneOf("--help-man", subcommand, program.subcommands);
  return subcommandPage(program, *found);
}

Result<std::string> completions(const DeclaredProgram& program, const std::string& shell) {
  const auto* const found = std::ranges::find(shells, shell, &Shell::name);
  if (found == shells.end()) return noneOf("--completions", shell, shells);
  return found->script(program);
}

}  // namespace

std::optional<Result<std::string>> manualAsked(const CommandLine& line, std::span<char* const> arguments) {
  if (arguments.size() < 2) return std::nullopt;
  const std::string_view option = arguments[1];
  const bool page = option == "--help-man";
  if (!page && option != "--completions") return std::nullopt;
  if (arguments.size() > 3)
    return inputError(fmt::format("{}: {} is too much", option, inQuotes(arguments[3])));
  const std::string value = arguments.size() > 2 ? arguments[2] : "";
  return page ? manPage(line.declared(), value) : completions(line.declared(), value);
}

}  // namespace vorpipe::cli

#include "cli/manual/examples.h"

#include <fmt/format.h>

#include <span>
#include <string>

#include "cli/manual/prose.h"

namespace vorpipe::cli {
namespace {

std::string examplesText(std::span<const Example> examples) {
  std::string text = examples.size() > 1 ? "\nExamples:" : "\nExample:";
  for (const Example& example : examples) {
    text += fmt::format("\n  {}\n", example.what);
    for (const std::string_view command : example.commands) text += fmt::format("    {}\n", command);
  }
  text.pop_back();
  return text;
}

}  // namespace

void addExamples(CommandLine& line) {
  const Prose program = proseOf("");
  line.setFooter("", examplesText(std::span(program.examples).first(1)) +
                         "\n\n`vorpipe SUBCOMMAND --help` has the options of each, and more examples.");
  for (const DeclaredSubcommand& subcommand : line.declared().subcommands) {
    const Prose prose = proseOf(subcommand.name);
    if (!prose.examples.empty()) line.setFooter(subcommand.name, examplesText(prose.examples));
  }
}

}  // namespace vorpipe::cli

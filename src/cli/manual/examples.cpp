#include "cli/manual/examples.h"

#include <fmt/format.h>

#include <span>
#include <string>

#include "cli/manual/prose.h"

namespace vorpipe::cli {
namespace {

std::string examplesText(std::span<const Example> examples) {
  if (examples.empty()) return {};
  std::string text = examples.size() > 1 ? "\nExamples:" : "\nExample:";
  for (const Example& example : examples) {
    text += fmt::format("\n  {}\n", example.what);
    for (const std::string_view command : example.commands) text += fmt::format("    {}\n", command);
  }
  text.pop_back();
  return text;
}

std::string footer(std::string_view subcommand) {
  const Prose prose = proseOf(subcommand);
  if (!subcommand.empty()) return examplesText(prose.examples);
  return examplesText(std::span(prose.examples).first(1)) +
         "\n\n`vorpipe SUBCOMMAND --help` has the options of each, and more examples.";
}

}  // namespace

void addExamples(CommandLine& line) { line.setFooters(footer); }

}  // namespace vorpipe::cli

#include "cli/manual/manual.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <span>
#include <string_view>
#include <vector>

#include "cli/manual/completions.h"
#include "cli/manual/prose.h"
#include "io/base/error.h"
#include "io/base/quoted.h"
#include "vorpipe.h"

namespace vorpipe::cli {
namespace {

/// Escapes a character. All hyphens are typed hyphens, since names with hyphens occur in any text.
std::string escaped(char c) {
  switch (c) {
    case '\\':
      return "\\e";
    case '-':
      return "\\-";
    case '^':
      return "\\(ha";
    case '~':
      return "\\(ti";
    default:
      return {c};
  }
}

/// Escapes text for a man page so that a user can copy it: quotes and dashes stay as they are typed.
std::string literal(std::string_view text) {
  std::string roff;
  for (const char c : text) {
    if (c == '\'') {
      roff += "\\(aq";
    } else if (c == '`') {
      roff += "\\(ga";
    } else {
      roff += escaped(c);
    }
  }
  return roff;
}

std::string bold(std::string_view text) { return fmt::format("\\fB{}\\fP", literal(text)); }
std::string italic(std::string_view text) { return fmt::format("\\fI{}\\fP", literal(text)); }

/// Returns prose, with text in backticks in bold. Whatever a line begins with, roff does not take it for a
/// request.
std::string prose(std::string_view text) {
  std::string roff = text.starts_with('.') || text.starts_with('\'') ? "\\&" : "";
  bool typed = false;
  for (const char c : text) {
    if (c == '`') {
      typed = !typed;
      roff += typed ? "\\fB" : "\\fP";
    } else {
      roff += escaped(c);
    }
  }
  return roff;
}

std::string heading(const std::string& page, const std::string& summary) {
  std::string title = page;
  std::ranges::transform(title, title.begin(),
                         [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  // Turns off hyphenation of names and justification of lines.
  return fmt::format(".TH \"{}\" 1 \"\" \"vorpipe {}\" \"User Commands\"\n.nh\n.ad l\n.SH NAME\n{} \\- {}\n",
                     literal(title), version(), literal(page), prose(briefly(summary)));
}

/// Returns a list entry: a term and its meaning.
std::string entry(const std::string& term, std::string_view meaning) {
  return fmt::format(".TP\n{}\n{}\n", term, prose(meaning));
}

std::string section(std::string_view title, std::span<const Row> rows) {
  std::string roff = fmt::format(".SH {}\n", title);
  for (const Row& row : rows) roff += entry(bold(row.name), row.meaning);
  return roff;
}

/// Returns "-h, --help", "--sites SPEC", or an operand's name in help.
std::string term(const DeclaredOption& option, bool operand) {
  std::vector<std::string> names;
  for (const std::string& name : option.names) names.push_back(operand ? italic(name) : bold(name));
  std::string roff = fmt::to_string(fmt::join(names, ", "));
  if (!operand && !option.value.empty()) roff += " " + italic(option.value);
  return option.repeatable ? roff + " ..." : roff;
}

/// Returns the conditions that help puts between names and description.
std::string conditions(const DeclaredOption& option) {
  std::string text;
  const auto backticked = [](const std::vector<std::string>& names) {
    return fmt::format("`{}`", fmt::join(names, "`, `"));
  };
  if (option.required) text += " Required.";
  if (!option.needs.empty()) text += fmt::format(" Needs {}.", backticked(option.needs));
  if (!option.excludes.empty()) text += fmt::format(" Not together with {}.", backticked(option.excludes));
  return text;
}

/// Returns a description as a sentence.
std::string sentence(const DeclaredOption& option) {
  std::string text = option.description;
  // Does not capitalize the x of "x, y or xy".
  const bool begins_with_word =
      text.size() > 1 && (text[1] == ' ' || std::islower(static_cast<unsigned char>(text[1])) != 0);
  if (begins_with_word) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text + "." + conditions(option);
}

std::string optionsSection(std::string_view title, const std::vector<DeclaredOption>& options,
                           bool operands) {
  if (options.empty()) return {};
  std::string roff = fmt::format(".SH {}\n", title);
  std::vector<std::string> groups;
  for (const DeclaredOption& option : options)
    if (std::ranges::find(groups, option.group) == groups.end()) groups.push_back(option.group);
  for (const std::string& group : inOrder(groups)) {
    if (groups.size() > 1) roff += fmt::format(".SS {}\n", literal(group));
    for (const DeclaredOption& option : options)
      if (option.group == group) roff += entry(term(option, operands), sentence(option));
  }
  return roff;
}

std::string paragraphs(const Prose& of) {
  std::string roff;
  for (const std::string_view paragraph : of.paragraphs) roff += fmt::format(".PP\n{}\n", prose(paragraph));
  return roff;
}

std::string examples(const Prose& of) {
  if (of.examples.empty()) return {};
  std::string roff = ".SH EXAMPLES\n";
  for (const Example& example : of.examples) {
    roff += fmt::format(".PP\n{}\n.PP\n.RS 4\n.EX\n", prose(example.what));
    for (const std::string_view command : example.commands) roff += literal(command) + "\n";
    roff += ".EE\n.RE\n";
  }
  return roff;
}

std::string seeAlso(const DeclaredProgram& program, const std::string& page) {
  std::vector<std::string> pages = {program.name};
  for (const DeclaredSubcommand& other : program.subcommands)
    pages.push_back(program.name + "-" + other.name);
  std::erase(pages, page);
  std::vector<std::string> named;
  for (const std::string& other : pages) named.push_back(fmt::format(".BR {} (1)", literal(other)));
  return fmt::format(".SH SEE ALSO\n{}\n", fmt::join(named, ",\n"));
}

/// Returns the usage of a subcommand: required arguments, then optional ones.
std::string usage(const DeclaredProgram& program, const DeclaredSubcommand& subcommand) {
  std::string roff = bold(program.name + " " + subcommand.name);
  for (const DeclaredOption& option : subcommand.options) {
    if (option.required) roff += fmt::format(" {} {}", bold(option.names.back()), italic(option.value));
  }
  roff += fmt::format(" [{} ...]", italic("OPTION"));
  for (const DeclaredOption& operand : subcommand.operands) {
    const std::string name = italic(operand.names.front()) + (operand.repeatable ? " ..." : "");
    roff += operand.required ? " " + name : fmt::format(" [{}]", name);
  }
  return roff;
}

/// Returns the page vorpipe(1), in roff with the macros of man(7).
std::string programPage(const DeclaredProgram& program) {
  const Prose of = proseOf("");
  std::string roff = heading(program.name, program.description);
  roff += fmt::format(".SH SYNOPSIS\n{} {} [{} ...]\n.br\n{} {}\n", bold(program.name), italic("SUBCOMMAND"),
                      italic("OPTION"), bold(program.name), bold("--help"));
  roff += ".SH DESCRIPTION\n" + paragraphs(of) + ".SH COMMANDS\nEach has a page of its own.\n";
  for (const DeclaredSubcommand& subcommand : program.subcommands)
    roff += entry(bold(subcommand.name), subcommand.description + ".");
  roff += optionsSection("OPTIONS", program.options, false);
  roff += section("EXIT STATUS", exitStatuses());
  roff += section("ENVIRONMENT", environment());
  return roff + examples(of) + seeAlso(program, program.name);
}

/// Returns a page such as vorpipe-cells(1).
std::string subcommandPage(const DeclaredProgram& program, const DeclaredSubcommand& subcommand) {
  const Prose of = proseOf(subcommand.name);
  const std::string page = program.name + "-" + subcommand.name;
  std::string roff = heading(page, subcommand.description);
  roff += fmt::format(".SH SYNOPSIS\n{}\n.SH DESCRIPTION\n", usage(program, subcommand));
  roff +=
      fmt::format(".PP\n{} {}.\n", bold(program.name + " " + subcommand.name), prose(subcommand.description));
  roff += paragraphs(of);
  roff += optionsSection("OPERANDS", subcommand.operands, true);
  roff += optionsSection("OPTIONS", subcommand.options, false);
  roff += section("EXIT STATUS", exitStatuses());
  return roff + examples(of) + seeAlso(program, page);
}

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

void addExamples(CommandLine& line) { line.setFooters(footer); }

}  // namespace vorpipe::cli

#include "cli/options/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <set>
#include <span>
#include <string_view>
#include <utility>

#include "cli/options/error_line.h"
#include "cli/options/unknown_option.h"
#include "io/base/quoted.h"

namespace vorpipe::cli {
namespace {

using Texts = std::vector<std::string>;

/// The layout of --help: options by their groups, in the order of inOrder().
class HelpFormat final : public CLI::Formatter {
 public:
  [[nodiscard]] std::string make_help(const CLI::App* app, std::string name,
                                      CLI::AppFormatMode mode) const override {
    std::string text = make_description(app) + make_usage(app, std::move(name)) + make_positionals(app);
    text += make_subcommands(app, mode);
    for (const std::string& group : inOrder(app->get_groups())) {
      const auto options = app->get_options(
          [&](const CLI::Option* option) { return option->nonpositional() && option->get_group() == group; });
      if (!options.empty()) text += make_group(group, false, options);
    }
    // Does not call CLI11's make_footer: some versions put an empty line before the footer.
    return text + app->get_footer() + '\n';
  }
};

CLI::Option* addTexts(CLI::App& app, const std::string& name, Value value, const std::string& description) {
  auto* option = app.add_option_function<Texts>(
      name, [keep = std::move(value.keep)](const Texts& texts) { std::ranges::for_each(texts, keep); },
      description);
  option->type_name(value.name)->check(std::move(value.fault));
  return option;
}

/// Adds the flags that the program and each subcommand have.
void addCommonFlags(CLI::App& app, const std::string& version_line) {
  const std::string group(help_group);
  app.set_help_flag("-h,--help", "prints the options")->group(group);
  app.set_version_flag("--version", version_line, "prints the version")->group(group);
  app.formatter(std::make_shared<HelpFormat>());
}

std::vector<std::string> namesOf(const std::set<CLI::Option*>& options) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options) names.push_back(option->get_name());
  std::ranges::sort(names);
  return names;
}

DeclaredOption declaredOption(const CLI::Option& option, const ChoicesOf& choices) {
  DeclaredOption declared;
  if (option.get_positional()) {
    declared.names.push_back(option.get_name(true));
  } else {
    for (const std::string& name : option.get_snames()) declared.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) declared.names.push_back("--" + name);
  }
  declared.description = option.get_description();
  declared.group = option.get_group();
  declared.takes_value = option.get_items_expected_min() > 0;
  if (option.get_items_expected_max() > 0) declared.value = option.get_type_name();
  if (const auto known = choices.find(&option); known != choices.end()) declared.choices = known->second;
  declared.required = option.get_required();
  declared.repeatable = option.get_expected_max() > 1;
  declared.needs = namesOf(option.get_needs());
  declared.excludes = namesOf(option.get_excludes());
  return declared;
}

DeclaredSubcommand declaredSubcommand(const CLI::App& app, const ChoicesOf& choices) {
  DeclaredSubcommand declared{app.get_name(), app.get_description(), {}, {}};
  for (const CLI::Option* option : app.get_options()) {
    auto& place = option->get_positional() ? declared.operands : declared.options;
    place.push_back(declaredOption(*option, choices));
  }
  return declared;
}

}  // namespace

Option& Option::required() {
  option_->required();
  return *this;
}

Option& Option::needs(const Option& other) {
  option_->needs(other.option_);
  return *this;
}

Option& Option::excludes(const Option& other) {
  option_->excludes(other.option_);
  return *this;
}

Option Options::add(const std::string& name, Value value, const std::string& description) {
  auto* option = app_->add_option_function<std::string>(name, std::move(value.keep), description);
  option->type_name(value.name)->check(std::move(value.fault));
  return place(option, std::move(value.choices));
}

Option Options::addOptional(const std::string& name, Value value, const std::string& description) {
  // Of an option without its value CLI11 makes an empty text, or, in some versions, that of an empty list.
  const auto given = [](const std::string& text) { return text == "{}" ? std::string() : text; };
  auto* option = app_->add_option_function<std::string>(
      name, [given, keep = std::move(value.keep)](const std::string& text) { keep(given(text)); },
      description);
  option->type_name(value.name.empty() ? "" : fmt::format("[{}]", value.name))->expected(0, 1);
  option->check([given, fault = std::move(value.fault)](const std::string& text) {
    return given(text).empty() ? std::string() : fault(text);
  });
  return place(option, std::move(value.choices));
}

Option Options::addRepeatable(const std::string& name, Value value, const std::string& description) {
  Choices choices = value.choices;
  auto* option = addTexts(*app_, name, std::move(value), description);
  option->allow_extra_args(false)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  return place(option, std::move(choices));
}

Option Options::addList(const std::string& name, Value value, const std::string& description) {
  Choices choices = value.choices;
  return place(addTexts(*app_, name, std::move(value), description), std::move(choices));
}

Option Options::addText(const std::string& name, std::string& target, const std::string& value,
                        const std::string& description, Choices choices) {
  return place(app_->add_option(name, target, description)->type_name(value), std::move(choices));
}

Option Options::addFlag(const std::string& name, bool& target, const std::string& description) {
  return place(app_->add_flag(name, target, description), {});
}

Option Options::place(CLI::Option* option, Choices choices) {
  option->group(group_);
  if (!choices.empty()) choices_->emplace(option, std::move(choices));
  return Option(option);
}

struct CommandLine::Parser {
  struct Subcommand {
    CLI::App* app;
    Run run;
  };

  CLI::App app;
  std::string version_line;
  std::vector<Subcommand> subcommands;
  ChoicesOf choices;

  /// Returns an error text for the first argument that is neither a subcommand nor an option: CLI11 does not
  /// report them in order.
  [[nodiscard]] std::string firstUnknown(std::span<char* const> arguments) const {
    if (arguments.size() < 2) return {};
    const std::string_view first = arguments[1];
    if (first.starts_with('-'))
      return unknownOption(declaredSubcommand(app, choices), arguments.subspan(1, 1));
    std::vector<std::string> names;
    for (const Subcommand& sub : subcommands) {
      names.push_back(sub.app->get_name());
      if (names.back() == first)
        return unknownOption(declaredSubcommand(*sub.app, choices), arguments.subspan(2));
    }
    const std::string hint = didYouMean(first, names);
    return "unknown subcommand " + inQuotes(first) + (hint.empty() ? "; see vorpipe --help" : hint);
  }
};

namespace {

/// Returns CLI11's message, except for repeated options.
std::string messageOf(const CLI::ParseError& error, std::span<char* const> arguments) {
  std::string message = error.what();
  const std::string name = message.substr(0, message.find(':'));
  const auto times = std::ranges::count_if(arguments, [&](std::string_view argument) {
    return argument == name || argument.starts_with(name + "=");
  });
  if (error.get_name() != "ArgumentMismatch" || times < 2) return message;
  return fmt::format("{}: is given {} times; once is enough", name, times);
}

}  // namespace

CommandLine::CommandLine(const std::string& program, const std::string& description,
                         const std::string& version_line)
    : parser_(new Parser{CLI::App(description, program), version_line, {}, {}}) {
  parser_->app.require_subcommand(1);
  addCommonFlags(parser_->app, version_line);
}

CommandLine::~CommandLine() = default;

Options CommandLine::addSubcommand(const std::string& name, const std::string& description, Run run) {
  CLI::App* app = parser_->app.add_subcommand(name, description);
  addCommonFlags(*app, parser_->version_line);
  parser_->subcommands.push_back({app, std::move(run)});
  return Options(app, &parser_->choices);
}

void CommandLine::setFooters(std::string (*footer)(std::string_view subcommand)) {
  parser_->app.footer([footer] { return footer(""); });
  for (const auto& [sub, run] : parser_->subcommands)
    sub->footer([footer, name = sub->get_name()] { return footer(name); });
}

DeclaredProgram CommandLine::declared() const {
  const CLI::App& app = parser_->app;
  DeclaredProgram program{app.get_name(), app.get_description(), {}, {}};
  for (const CLI::Option* option : app.get_options())
    program.options.push_back(declaredOption(*option, parser_->choices));
  for (const auto& [sub, run] : parser_->subcommands)
    program.subcommands.push_back(declaredSubcommand(*sub, parser_->choices));
  return program;
}

tl::expected<Run, int> CommandLine::parse(int count, char** arguments) {
  CLI::App& app = parser_->app;
  const std::span<char* const> given(arguments, static_cast<std::size_t>(count));
  if (const std::string unknown = parser_->firstUnknown(given); !unknown.empty()) {
    printError(unknown);
    return tl::unexpected<int>(exit_input);
  }
  try {
    app.parse(count, arguments);
  } catch (const CLI::Success& asked) {
    return tl::unexpected(app.exit(asked));
  } catch (const CLI::ParseError& error) {
    const auto parsed =
        std::ranges::find_if(parser_->subcommands, [](const auto& sub) { return sub.app->parsed(); });
    const std::string page = parsed == parser_->subcommands.end() ? "" : parsed->app->get_name() + " ";
    printError(fmt::format("{}; see vorpipe {}--help", messageOf(error, given), page));
    return tl::unexpected<int>(exit_input);
  }
  const auto chosen =
      std::ranges::find_if(parser_->subcommands, [](const auto& sub) { return sub.app->parsed(); });
  return chosen->run;
}

}  // namespace vorpipe::cli

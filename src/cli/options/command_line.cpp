#include "cli/options/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>

#include "cli/terminal/error_line.h"
#include "io/files/error.h"

namespace vorpipe::cli {
namespace {

using Texts = std::vector<std::string>;

CLI::Option* addTexts(CLI::App& app, const std::string& name, Value value, const std::string& description) {
  auto* option = app.add_option_function<Texts>(
      name, [keep = std::move(value.keep)](const Texts& texts) { std::ranges::for_each(texts, keep); },
      description);
  option->type_name(value.name)->check(std::move(value.fault));
  return option;
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
  return Option(option);
}

Option Options::addRepeatable(const std::string& name, Value value, const std::string& description) {
  auto* option = addTexts(*app_, name, std::move(value), description);
  option->allow_extra_args(false)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  return Option(option);
}

Option Options::addList(const std::string& name, Value value, const std::string& description) {
  return Option(addTexts(*app_, name, std::move(value), description));
}

Option Options::addText(const std::string& name, std::string& target, const std::string& value,
                        const std::string& description) {
  return Option(app_->add_option(name, target, description)->type_name(value));
}

Option Options::addFlag(const std::string& name, bool& target, const std::string& description) {
  return Option(app_->add_flag(name, target, description));
}

struct CommandLine::Parser {
  struct Subcommand {
    CLI::App* app;
    Run run;
  };

  CLI::App app;
  std::vector<Subcommand> subcommands;

  /// What CLI11 would only call a missing subcommand.
  [[nodiscard]] bool knowsNot(std::string_view argument) const {
    return !argument.starts_with('-') && std::ranges::none_of(subcommands, [&](const Subcommand& sub) {
      return sub.app->get_name() == argument;
    });
  }
};

CommandLine::CommandLine(const std::string& program, const std::string& description)
    : parser_(new Parser{CLI::App(description, program), {}}) {
  parser_->app.require_subcommand(1);
}

CommandLine::~CommandLine() = default;

Options CommandLine::addSubcommand(const std::string& name, const std::string& description, Run run) {
  CLI::App* app = parser_->app.add_subcommand(name, description);
  parser_->subcommands.push_back({app, std::move(run)});
  return Options(app);
}

tl::expected<Run, int> CommandLine::parse(int count, char** arguments, const std::string& version_line) {
  CLI::App& app = parser_->app;
  app.set_version_flag("--version", version_line);
  for (const auto& sub : parser_->subcommands) sub.app->set_version_flag("--version", version_line);
  if (count > 1 && parser_->knowsNot(arguments[1])) {
    printError(quoted(arguments[1]) + " is no subcommand; see vorpipe --help");
    return tl::unexpected<int>(exit_input);
  }
  try {
    app.parse(count, arguments);
  } catch (const CLI::Success& asked) {
    return tl::unexpected(app.exit(asked));
  } catch (const CLI::ParseError& error) {
    printError(std::string(error.what()) + "; see vorpipe --help");
    return tl::unexpected<int>(exit_input);
  }
  const auto chosen =
      std::ranges::find_if(parser_->subcommands, [](const auto& sub) { return sub.app->parsed(); });
  return chosen->run;
}

}  // namespace vorpipe::cli

/// What may stand on the command line, declared here without the parser that reads it: its headers take
/// longer to compile than most of what includes this.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/options/declared.h"
#include "vorpipe.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace vorpipe::cli {

enum ExitCode : int { exit_done = 0, exit_different = 1, exit_input = 2, exit_device = 3 };

/// An option that was declared.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}
  Option& required();
  /// Refused where `other` is not given.
  Option& needs(const Option& other);
  /// Refused where `other` is given.
  Option& excludes(const Option& other);

 private:
  CLI::Option* option_;
};

/// A value: how help calls it, what becomes of its text, and what is known of it beforehand.
struct Value {
  std::string name;
  std::function<std::string(const std::string&)> fault;  ///< what is wrong with it; empty: nothing
  std::function<void(const std::string&)> keep;          ///< called with what has no fault
  Choices choices{};
};

/// What is known of the values of options.
using ChoicesOf = std::map<const CLI::Option*, Choices>;

/// What a subcommand takes. Names are `--name`, `-n`, or for what stands without one `NAME`.
class Options {
 public:
  Options(CLI::App* app, ChoicesOf* choices) : app_(app), choices_(choices) {}
  /// What is given once at most.
  Option add(const std::string& name, Value value, const std::string& description);
  /// What may be given any number of times, with one value each time so that it does not swallow what
  /// follows.
  Option addRepeatable(const std::string& name, Value value, const std::string& description);
  /// Any number of values, one after the other.
  Option addList(const std::string& name, Value value, const std::string& description);
  /// Any text.
  Option addText(const std::string& name, std::string& target, const std::string& value,
                 const std::string& description, Choices choices = {});
  Option addFlag(const std::string& name, bool& target, const std::string& description);
  /// The heading of what is added from now on, in help and man pages; inOrder() has their order.
  void group(std::string heading) { group_ = std::move(heading); }

 private:
  Option place(CLI::Option* option, Choices choices);

  CLI::App* app_;
  ChoicesOf* choices_;
  std::string group_ = "Run";
};

/// How a subcommand was called, and who wants to know what it did.
struct Invocation {
  std::vector<std::string> arguments;  ///< as they were given, without the program's name
  /// Gets what --stats would write, where --stats is not given, as `rerun` needs it; null: it is not needed.
  std::string* stats = nullptr;
};

/// What runs a subcommand once its options are parsed: the exit code, or an error that main prints and turns
/// into one.
using Run = std::function<Result<ExitCode>(const Invocation&)>;

class CommandLine {
 public:
  /// `version_line` is what --version prints.
  CommandLine(const std::string& program, const std::string& description, const std::string& version_line);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// Options refer to what `run` reads.
  Options addSubcommand(const std::string& name, const std::string& description, Run run);

  /// Tells what stands below the options in the help of each subcommand that was added; of "" below that of
  /// the program. It is asked when help is.
  void setFooters(std::string (*footer)(std::string_view subcommand));

  /// All that was declared, in the order in which it was.
  [[nodiscard]] DeclaredProgram declared() const;

  /// The run of the subcommand that is named. Else the exit code: help or the version were asked for, and
  /// printed; or the command line is wrong, and a line on standard error said how. May be called again from
  /// a run, for another subcommand.
  tl::expected<Run, int> parse(int count, char** arguments);

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

}  // namespace vorpipe::cli

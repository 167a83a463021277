/// Declares the command line without including the parser, whose headers take longer to compile than most
/// files that include this one.
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

/// A declared option.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}
  Option& required();
  /// The option is an error if `other` is not given.
  Option& needs(const Option& other);
  /// The option is an error if `other` is given.
  Option& excludes(const Option& other);

 private:
  CLI::Option* option_;
};

/// A value: its name in help, the functions for its text, and its known choices.
struct Value {
  std::string name;
  std::function<std::string(const std::string&)>
      fault;                                     ///< returns what is wrong with the text; empty: nothing
  std::function<void(const std::string&)> keep;  ///< stores a text without fault
  Choices choices{};
};

/// The known choices of options' values.
using ChoicesOf = std::map<const CLI::Option*, Choices>;

/// The options and operands of a subcommand. Names are `--name`, `-n`, or `NAME` for an operand.
class Options {
 public:
  Options(CLI::App* app, ChoicesOf* choices) : app_(app), choices_(choices) {}
  /// Adds an option or operand that is given at most once.
  Option add(const std::string& name, Value value, const std::string& description);
  /// The same for an option whose value may be left out: `keep` then receives an empty text.
  Option addOptional(const std::string& name, Value value, const std::string& description);
  /// Adds an option that may be given any number of times. Each takes one value, so that it does not swallow
  /// the arguments after it.
  Option addRepeatable(const std::string& name, Value value, const std::string& description);
  /// Adds any number of consecutive values.
  Option addList(const std::string& name, Value value, const std::string& description);
  /// Adds an option with any text as its value.
  Option addText(const std::string& name, std::string& target, const std::string& value,
                 const std::string& description, Choices choices = {});
  Option addFlag(const std::string& name, bool& target, const std::string& description);
  /// Sets the heading for options added from now on, in help and man pages; for the order see inOrder().
  void group(std::string heading) { group_ = std::move(heading); }

 private:
  Option place(CLI::Option* option, Choices choices);

  CLI::App* app_;
  ChoicesOf* choices_;
  std::string group_ = "Run";
};

/// How a subcommand was called, and where its statistics go.
struct Invocation {
  std::vector<std::string> arguments;  ///< as given, without the program's name
  /// Without --stats, receives the text that --stats would write; `rerun` needs it. Null: not needed.
  std::string* stats = nullptr;
};

/// Runs a subcommand after its options are parsed. Returns the exit code, or an error that main prints and
/// turns into one.
using Run = std::function<Result<ExitCode>(const Invocation&)>;

class CommandLine {
 public:
  /// `version_line` is what --version prints.
  CommandLine(const std::string& program, const std::string& description, const std::string& version_line);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// The options refer to the variables that `run` reads.
  Options addSubcommand(const std::string& name, const std::string& description, Run run);

  /// Sets the text below the options in the help of each subcommand added so far; for "" in that of the
  /// program. `footer` is called when help is requested.
  void setFooters(std::string (*footer)(std::string_view subcommand));

  /// Returns all declarations, in their order.
  [[nodiscard]] DeclaredProgram declared() const;

  /// Returns the run of the named subcommand. Else returns the exit code: help or the version was requested
  /// and printed, or the command line is wrong and a line on standard error says how. A run may call this
  /// again for another subcommand.
  tl::expected<Run, int> parse(int count, char** arguments);

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

}  // namespace vorpipe::cli

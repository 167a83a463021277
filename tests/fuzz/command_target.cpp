/// Command lines, up to where a run would begin.
#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <string>
#include <vector>

#include "cli/commands/command.h"
#include "cli/manual/manual.h"
#include "target.h"

namespace vorpipe::fuzz {
namespace {

/// Blanks separate; a byte 1 stands for a blank in an argument, and 2 for an empty argument.
std::vector<std::string> argumentsIn(std::string_view bytes) {
  std::vector<std::string> arguments{"vorpipe"};
  bool begun = false;
  for (const char c : bytes) {
    if (c == ' ' || c == '\n' || c == '\0') {
      begun = false;
      continue;
    }
    if (!begun) arguments.emplace_back();
    begun = true;
    if (c != '\2') arguments.back() += c == '\1' ? ' ' : c;
  }
  return arguments;
}

/// While it lives, what is printed is lost: help and errors of a million command lines.
class Silence {
 public:
  Silence() {
    std::fflush(stdout);
    const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, stream);
    ::close(nowhere);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;
  ~Silence() {
    std::fflush(stdout);
    ::dup2(output_, STDOUT_FILENO);
    ::dup2(errors_, STDERR_FILENO);
    ::close(output_);
    ::close(errors_);
  }

 private:
  int output_ = ::dup(STDOUT_FILENO), errors_ = ::dup(STDERR_FILENO);
};

}  // namespace

void fuzzCommandLine(std::string_view bytes) {
  std::vector<std::string> arguments = argumentsIn(bytes);
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  // What options keep stands in the line, so that each gets a new one.
  cli::CommandLine line("vorpipe", "", "");
  for (const auto add :
       {cli::addRender, cli::addCells, cli::addRelax, cli::addTransport, cli::addFluid, cli::addView,
        cli::addDiff, cli::addCompare, cli::addRerun, cli::addDevices, cli::addBench, cli::addSelftest})
    add(line);
  cli::addExamples(line);
  const auto run = [&] {
    const Silence silence;
    return line.parse(static_cast<int>(pointers.size()), pointers.data());
  }();
  require(run ? static_cast<bool>(*run) : run.error() == cli::exit_done || run.error() == cli::exit_input,
          "a command line is a run, help, or refused with 2");
}

}  // namespace vorpipe::fuzz

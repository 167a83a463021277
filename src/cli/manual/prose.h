/// The text of man pages besides the options: paragraphs and examples. `Words in backticks` are set in the
/// style of typed text.
#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace vorpipe::cli {

struct Example {
  std::string_view what;
  std::vector<std::string_view> commands;
};

struct Prose {
  std::string_view subcommand;  ///< empty: the program
  std::vector<std::string_view> paragraphs;
  std::vector<Example> examples;
};

/// Returns the prose of a subcommand, or of the program; without paragraphs if there is none.
Prose proseOf(std::string_view subcommand);

struct Row {
  std::string_view name, meaning;
};

/// Exit codes, and the relevant environment variables.
std::span<const Row> exitStatuses();
std::span<const Row> environment();

}  // namespace vorpipe::cli

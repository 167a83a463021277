/// What man pages say beside the options: paragraphs and examples. In text, `words in backticks` are set as
/// they are typed.
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
  std::string_view subcommand;  ///< empty: of the program
  std::vector<std::string_view> paragraphs;
  std::vector<Example> examples;
};

/// That of a subcommand, or of the program; one without any has no paragraphs.
Prose proseOf(std::string_view subcommand);

struct Row {
  std::string_view name, meaning;
};

/// Exit codes, and the environment that matters.
std::span<const Row> exitStatuses();
std::span<const Row> environment();

}  // namespace vorpipe::cli

#include "cli/options/help_format.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "cli/options/declared.h"

namespace vorpipe::cli {
namespace {

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

}  // namespace

std::shared_ptr<CLI::FormatterBase> helpFormat() { return std::make_shared<HelpFormat>(); }

}  // namespace vorpipe::cli

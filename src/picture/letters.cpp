// Which letters pictures have.

#include <fmt/core.h>

#include <functional>
#include <string>
#include <string_view>

#include "picture/glyphs.h"
#include "vorpipe.h"

namespace vorpipe {

Result<void> checkLetters(const RenderOptions& options, std::string_view what,
                          const std::function<bool(std::string_view)>& has) {
  Result<void> checked;
  const auto check = [&](std::string_view name, const std::string& text) {
    if (!checked || has(text)) return;
    checked = tl::unexpected(
        Error{ErrorCode::input,
              fmt::format("{} \"{}\": {} does not have these letters; .svg has all", name, text, what)});
  };
  check("title", options.title);
  if (options.legend)
    check("legend", options.legend_title.empty() ? options.values.title : options.legend_title);
  if (options.legend) {
    for (const std::string& name : options.values.names) check("legend", name);
  }
  if (options.labels) {
    for (const std::string& text : options.texts) check("label", text);
  }
  return checked;
}

bool pixelsHaveLetters(std::string_view text) {
  bool all = true;
  core::eachCharacter(text,
                      [&](char32_t character) { all = all && core::letterOf(character).glyph != nullptr; });
  return all;
}

}  // namespace vorpipe

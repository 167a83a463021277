#include "view/script.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "io/base/error.h"
#include "io/base/input_file.h"
#include "io/base/number.h"
#include "io/base/quoted.h"
#include "view/words.h"
#include "vorpipe/picture.h"

namespace vorpipe::view {
namespace {

template <class T>
using Read = tl::expected<T, WordProblem>;

tl::unexpected<WordProblem> wrong(std::size_t column, std::string what) {
  return tl::unexpected(WordProblem{column, std::move(what)});
}

/// Reads the words after the first, one by one.
class Rest {
 public:
  explicit Rest(std::span<const Word> words) : words_(words) {}

  [[nodiscard]] bool empty() const { return next_ == words_.size(); }
  [[nodiscard]] const Word& front() const { return words_[next_]; }
  void drop() { ++next_; }
  /// Returns the column of a missing word: the end of the line.
  [[nodiscard]] std::size_t end() const { return words_.back().column + words_.back().text.size(); }

  /// Returns the next word; `what` names it in errors, e.g. "X".
  Read<Word> word(std::string_view what) {
    if (empty()) return wrong(end(), fmt::format("{} is missing after {}", what, words_[0].text));
    return words_[next_++];
  }

  Read<double> number(std::string_view what) {
    const auto text = word(what);
    if (!text) return tl::unexpected(text.error());
    const auto value = parseNumber(text->text);
    if (!value) return wrong(text->column, fmt::format("{}: {}", what, value.error()));
    return *value;
  }

  Read<int> side(std::string_view what) {
    const std::size_t column = empty() ? end() : front().column;
    const auto value = number(what);
    if (!value) return tl::unexpected(value.error());
    if (*value >= 1 && *value <= largest_side && *value == std::floor(*value))
      return static_cast<int>(*value);
    return wrong(column,
                 fmt::format("{}: {} is not a whole number from 1 to {}", what, *value, largest_side));
  }

  /// Reads any of shift, control and alt.
  Modifiers modifiers() {
    Modifiers held;
    for (; !empty(); ++next_) {
      const std::string& name = front().text;
      bool* const which = name == "shift" ? &held.shift : name == "control" ? &held.control : &held.alt;
      if (which == &held.alt && name != "alt") break;
      *which = true;
    }
    return held;
  }

 private:
  std::span<const Word> words_;
  std::size_t next_ = 1;
};

constexpr std::array<std::string_view, 3> button_words = {"left", "right", "middle"};

Read<Button> buttonOf(Rest& rest) {
  const auto word = rest.word("a button");
  if (!word) return tl::unexpected(word.error());
  const auto* const found = std::ranges::find(button_words, word->text);
  if (found == button_words.end()) {
    return wrong(word->column, fmt::format("{} is not left, right or middle", inQuotes(word->text)));
  }
  return static_cast<Button>(found - button_words.begin());
}

Read<Event> moveOf(Rest& rest) {
  const auto x = rest.number("X");
  if (!x) return tl::unexpected(x.error());
  const auto y = rest.number("Y");
  if (!y) return tl::unexpected(y.error());
  return Move{{*x, *y}};
}

Read<Event> pressOf(Rest& rest) {
  const auto button = buttonOf(rest);
  if (!button) return tl::unexpected(button.error());
  return Press{*button, rest.modifiers()};
}

Read<Event> releaseOf(Rest& rest) {
  return buttonOf(rest).map([](Button button) -> Event { return Release{button}; });
}

Read<Event> scrollOf(Rest& rest) {
  const auto by = rest.number("STEPS");
  if (!by) return tl::unexpected(by.error());
  return Scroll{*by, rest.modifiers()};
}

Read<Event> keyOf(Rest& rest) {
  const auto name = rest.word("a key");
  if (!name) return tl::unexpected(name.error());
  if (std::ranges::find(keyNames(), name->text) == keyNames().end()) {
    return wrong(name->column,
                 fmt::format("{} is not a key: a to z, 0 to 9, f1 to f12, escape, tab, space ...",
                             inQuotes(name->text)));
  }
  return Key{name->text, rest.modifiers()};
}

Read<Event> resizeOf(Rest& rest) {
  const auto width = rest.side("WIDTH");
  if (!width) return tl::unexpected(width.error());
  const auto height = rest.side("HEIGHT");
  if (!height) return tl::unexpected(height.error());
  return Resize{*width, *height};
}

Read<Event> dropOf(Rest& rest) {
  Drop drop;
  do {
    const auto path = rest.word("a path");
    if (!path) return tl::unexpected(path.error());
    drop.paths.push_back(path->text);
  } while (!rest.empty());
  return drop;
}

Read<Event> waitOf(Rest& rest) {
  if (rest.empty()) return Wait{};
  const std::size_t column = rest.front().column;
  const auto seconds = rest.number("SECONDS");
  if (!seconds) return tl::unexpected(seconds.error());
  constexpr double longest = 86400;
  if (*seconds > 0 && *seconds <= longest) return Wait{*seconds};
  return wrong(column, fmt::format("SECONDS: {} is not above 0 and up to {}", *seconds, longest));
}

Read<Event> screenshotOf(Rest& rest) {
  const auto path = rest.word("a .png file");
  if (!path) return tl::unexpected(path.error());
  if (!path->text.ends_with(".png")) {
    return wrong(path->column, fmt::format("{} does not end in .png", inQuotes(path->text)));
  }
  const bool panel = !rest.empty() && rest.front().text == "panel";
  if (panel) rest.drop();
  return Screenshot{path->text, panel};
}

template <class Simple>
Read<Event> simpleOf(Rest& /*rest*/) {
  return Simple{};
}

struct Verb {
  std::string_view name;
  Read<Event> (*read)(Rest& rest);
};

constexpr std::array<Verb, 12> verbs = {{{"move", moveOf},
                                         {"press", pressOf},
                                         {"release", releaseOf},
                                         {"scroll", scrollOf},
                                         {"key", keyOf},
                                         {"resize", resizeOf},
                                         {"minimize", simpleOf<Minimize>},
                                         {"restore", simpleOf<Restore>},
                                         {"drop", dropOf},
                                         {"wait", waitOf},
                                         {"screenshot", screenshotOf},
                                         {"close", simpleOf<Close>}}};

Read<Event> eventOf(std::span<const Word> words) {
  const Word& first = words[0];
  const auto* const verb = std::ranges::find(verbs, first.text, &Verb::name);
  if (verb == verbs.end()) {
    return wrong(first.column, fmt::format("{} is no event: move, press, release, scroll, key, text, resize, "
                                           "minimize, restore, drop, wait, screenshot or close",
                                           inQuotes(first.text)));
  }
  Rest rest(words);
  auto event = verb->read(rest);
  if (event && !rest.empty()) {
    return wrong(rest.front().column, fmt::format("{} is too much here", inQuotes(rest.front().text)));
  }
  return event;
}

/// The text after `text ` is taken verbatim.
constexpr std::string_view text_verb = "text ";

}  // namespace

Result<Script> readScript(const std::string& path) {
  auto file = InputFile::open(path);
  if (!file) return tl::unexpected(std::move(file.error()));
  constexpr std::size_t most = std::size_t{1} << 24;
  const auto text = readText(*file, most);
  if (!text) return tl::unexpected(text.error());
  return parseScript(file->name(), *text);
}

Result<Script> parseScript(const std::string& name, std::string_view text) {
  Script script{name, {}};
  std::size_t number = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    ++number;
    while (line.ends_with('\r')) line.remove_suffix(1);
    if (line.starts_with(text_verb)) {
      script.lines.push_back({Text{std::string(line.substr(text_verb.size()))}, number});
      continue;
    }
    const auto words = wordsOf(line);
    if (words && words->empty()) continue;
    auto event = words ? eventOf(*words) : Read<Event>(tl::unexpected(words.error()));
    if (!event) {
      return inputError(fmt::format("{}:{}:{}: {}", name, number, event.error().column, event.error().what));
    }
    script.lines.push_back({std::move(*event), number});
  }
  return script;
}

}  // namespace vorpipe::view

#include "view/script.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/input_file.h"
#include "io/base/number.h"
#include "io/base/quoted.h"
#include "vorpipe/picture.h"

namespace vorpipe::view {
namespace {

struct Word {
  std::string text;
  std::size_t column = 1;  ///< column of its first byte, from 1
};

struct WordProblem {
  std::size_t column = 1;
  std::string what;
};

constexpr std::string_view blanks = " \t\r";

/// Splits a line into words at blanks. A word in double quotes may contain blanks; in it \" is a quote, and
/// \\ a backslash. A word that begins with # ends the line.
tl::expected<std::vector<Word>, WordProblem> wordsOf(std::string_view line) {
  std::vector<Word> words;
  std::size_t at = 0;
  while ((at = line.find_first_not_of(blanks, at)) != std::string_view::npos && line[at] != '#') {
    Word word{{}, at + 1};
    if (line[at] != '"') {
      const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
      word.text = line.substr(at, end - at);
      at = end;
    } else {
      for (++at; at < line.size() && line[at] != '"'; ++at) {
        const bool escaped = line[at] == '\\' && at + 1 < line.size();
        word.text += line[escaped ? ++at : at];
      }
      if (at == line.size()) return tl::unexpected(WordProblem{word.column, "the quote does not end"});
      ++at;
    }
    words.push_back(std::move(word));
  }
  return words;
}

std::vector<std::string> allKeyNames() {
  std::vector<std::string> names = {
      "escape",    "tab",        "space",      "enter",      "backspace",  "insert",       "delete",
      "home",      "end",        "left",       "right",      "up",         "down",         "page_up",
      "page_down", "print",      "menu",       "plus",       "minus",      "asterisk",     "slash",
      "question",  "equal",      "comma",      "period",     "colon",      "semicolon",    "apostrophe",
      "quotedbl",  "grave",      "exclam",     "numbersign", "dollar",     "percent",      "ampersand",
      "parenleft", "parenright", "less",       "greater",    "at",         "left_bracket", "right_bracket",
      "backslash", "circumflex", "underscore", "braceleft",  "braceright", "bar",          "tilde"};
  for (char letter = 'a'; letter <= 'z'; ++letter) names.emplace_back(1, letter);
  for (char digit = '0'; digit <= '9'; ++digit) names.emplace_back(1, digit);
  constexpr int function_keys = 12;
  for (int number = 1; number <= function_keys; ++number) names.push_back("f" + std::to_string(number));
  return names;
}

/// Names of keys in scripts of older versions, and those of today.
constexpr std::array<std::pair<std::string_view, std::string_view>, 4> older_key_names = {
    {{"pageup", "page_up"},
     {"pagedown", "page_down"},
     {"bracketleft", "left_bracket"},
     {"bracketright", "right_bracket"}}};

constexpr std::array<std::string_view, 3> button_names = {"left", "right", "middle"};

/// Reads the words of a line after the first. After a problem, of which the first counts, values mean
/// nothing.
class LineReader {
 public:
  explicit LineReader(std::span<const Word> words) : words_(words) {}

  [[nodiscard]] const std::optional<WordProblem>& problem() const { return problem_; }
  [[nodiscard]] bool empty() const { return next_ == words_.size(); }
  /// Whether the next word is `text`; takes it if so.
  bool takes(std::string_view text) {
    const bool same = !empty() && words_[next_].text == text;
    if (same) ++next_;
    return same;
  }

  /// Returns the next word; `what` names it in errors, e.g. "X".
  std::string word(std::string_view what) {
    if (!empty()) return words_[next_++].text;
    const Word& last = words_.back();
    fail(last.column + last.text.size(), fmt::format("{} is missing after {}", what, words_[0].text));
    return {};
  }

  double number(std::string_view what) {
    const std::string text = word(what);
    const auto value = parseNumber(text);
    if (!value) fail(fmt::format("{}: {}", what, value.error()));
    return value.value_or(0);
  }

  int side(std::string_view what) {
    const double value = number(what);
    if (value >= 1 && value <= largest_side && value == std::floor(value)) return static_cast<int>(value);
    fail(fmt::format("{}: {} is not a whole number from 1 to {}", what, value, largest_side));
    return 0;
  }

  double seconds() {
    const double value = number("SECONDS");
    constexpr double longest = 86400;
    if (!(value > 0 && value <= longest)) {
      fail(fmt::format("SECONDS: {} is not above 0 and up to {}", value, longest));
    }
    return value;
  }

  Button button() {
    const std::string name = word("a button");
    const auto* const found = std::ranges::find(button_names, name);
    if (found == button_names.end()) fail(fmt::format("{} is not left, right or middle", inQuotes(name)));
    return static_cast<Button>(found - button_names.begin());
  }

  std::string key() {
    std::string name = word("a key");
    for (const auto& [older, now] : older_key_names) {
      if (name == older) name = now;
    }
    if (std::ranges::find(keyNames(), name) == keyNames().end()) {
      fail(fmt::format("{} is not a key: a to z, 0 to 9, f1 to f12, escape, tab, space ...", inQuotes(name)));
    }
    return name;
  }

  /// Reads any of shift, control and alt.
  Modifiers modifiers() {
    Modifiers held;
    for (;;) {
      if (takes("shift")) {
        held.shift = true;
      } else if (takes("control")) {
        held.control = true;
      } else if (takes("alt")) {
        held.alt = true;
      } else {
        return held;
      }
    }
  }

  std::string picturePath() {
    std::string path = word("a .png file");
    if (!path.ends_with(".png")) fail(fmt::format("{} does not end in .png", inQuotes(path)));
    return path;
  }

  std::vector<std::string> paths() {
    std::vector<std::string> all{word("a path")};
    while (!empty()) all.push_back(word("a path"));
    return all;
  }

  void finish() {
    if (!empty())
      fail(words_[next_].column, fmt::format("{} is too much here", inQuotes(words_[next_].text)));
  }

 private:
  void fail(std::size_t column, std::string what) {
    if (!problem_) problem_ = WordProblem{column, std::move(what)};
  }
  /// A problem of the last word.
  void fail(std::string what) { fail(words_[next_ - 1].column, std::move(what)); }

  std::span<const Word> words_;
  std::size_t next_ = 1;
  std::optional<WordProblem> problem_{};
};

struct Verb {
  std::string_view name;
  Event (*read)(LineReader& line);
};

// The members of an initializer list are read in order.
constexpr auto verbs = std::to_array<Verb>({
    {"move",
     [](LineReader& line) -> Event {
       return Move{{line.number("X"), line.number("Y")}};
     }},
    {"press",
     [](LineReader& line) -> Event {
       return Press{line.button(), line.modifiers()};
     }},
    {"release", [](LineReader& line) -> Event { return Release{line.button()}; }},
    {"scroll",
     [](LineReader& line) -> Event {
       return Scroll{line.number("STEPS"), line.modifiers()};
     }},
    {"key",
     [](LineReader& line) -> Event {
       return Key{line.key(), line.modifiers()};
     }},
    {"resize",
     [](LineReader& line) -> Event {
       return Resize{line.side("WIDTH"), line.side("HEIGHT")};
     }},
    {"minimize", [](LineReader&) -> Event { return Minimize{}; }},
    {"restore", [](LineReader&) -> Event { return Restore{}; }},
    {"drop", [](LineReader& line) -> Event { return Drop{line.paths()}; }},
    {"wait", [](LineReader& line) -> Event { return line.empty() ? Wait{} : Wait{line.seconds()}; }},
    {"screenshot",
     [](LineReader& line) -> Event {
       return Screenshot{line.picturePath(), line.takes("panel")};
     }},
    {"close", [](LineReader&) -> Event { return Close{}; }},
});

tl::expected<Event, WordProblem> eventOf(std::span<const Word> words) {
  const Word& first = words[0];
  const auto* const verb = std::ranges::find(verbs, first.text, &Verb::name);
  if (verb == verbs.end()) {
    return tl::unexpected(WordProblem{
        first.column, fmt::format("{} is no event: move, press, release, scroll, key, text, resize, "
                                  "minimize, restore, drop, wait, screenshot or close",
                                  inQuotes(first.text))});
  }
  LineReader line(words);
  Event event = verb->read(line);
  line.finish();
  if (line.problem()) return tl::unexpected(*line.problem());
  return event;
}

/// The text after `text ` is taken verbatim.
constexpr std::string_view text_verb = "text ";

}  // namespace

const std::vector<std::string>& keyNames() {
  static const std::vector<std::string> names = allKeyNames();
  return names;
}

Result<Script> readScript(const std::string& path) {
  VORPIPE_VAR(file, InputFile::open(path));
  constexpr std::size_t most = std::size_t{1} << 24;
  VORPIPE_LET(text, readText(file, most));
  return parseScript(file.name(), text);
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
    auto event = words ? eventOf(*words) : tl::expected<Event, WordProblem>(tl::unexpected(words.error()));
    if (!event) {
      return inputError(fmt::format("{}:{}:{}: {}", name, number, event.error().column, event.error().what));
    }
    script.lines.push_back({std::move(*event), number});
  }
  return script;
}

}  // namespace vorpipe::view

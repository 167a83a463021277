#include "view/script.h"

namespace vorpipe::view {
namespace {

std::vector<std::string> allKeyNames() {
  std::vector<std::string> names = {
      "escape",    "tab",        "space",      "enter",      "backspace",  "insert",      "delete",
      "home",      "end",        "left",       "right",      "up",         "down",        "pageup",
      "pagedown",  "print",      "menu",       "plus",       "minus",      "asterisk",    "slash",
      "question",  "equal",      "comma",      "period",     "colon",      "semicolon",   "apostrophe",
      "quotedbl",  "grave",      "exclam",     "numbersign", "dollar",     "percent",     "ampersand",
      "parenleft", "parenright", "less",       "greater",    "at",         "bracketleft", "bracketright",
      "backslash", "circumflex", "underscore", "braceleft",  "braceright", "bar",         "tilde"};
  for (char letter = 'a'; letter <= 'z'; ++letter) names.emplace_back(1, letter);
  for (char digit = '0'; digit <= '9'; ++digit) names.emplace_back(1, digit);
  constexpr int function_keys = 12;
  for (int number = 1; number <= function_keys; ++number) names.push_back("f" + std::to_string(number));
  return names;
}

}  // namespace

const std::vector<std::string>& keyNames() {
  static const std::vector<std::string> names = allKeyNames();
  return names;
}

}  // namespace vorpipe::view

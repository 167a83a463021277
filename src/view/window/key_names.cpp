#include "view/window/key_names.h"

#include <algorithm>
#include <array>

#include "view/window/glfw.h"

namespace vorpipe::view {
namespace {

struct NamedKey {
  int key;
  std::string_view name;
};
// Keys that give a character are listed by their character on an American keyboard.
constexpr std::array<NamedKey, 42> named_keys = {{
    {GLFW_KEY_SPACE, "space"},
    {GLFW_KEY_ESCAPE, "escape"},
    {GLFW_KEY_ENTER, "enter"},
    {GLFW_KEY_KP_ENTER, "enter"},
    {GLFW_KEY_TAB, "tab"},
    {GLFW_KEY_BACKSPACE, "backspace"},
    {GLFW_KEY_INSERT, "insert"},
    {GLFW_KEY_DELETE, "delete"},
    {GLFW_KEY_LEFT, "left"},
    {GLFW_KEY_RIGHT, "right"},
    {GLFW_KEY_UP, "up"},
    {GLFW_KEY_DOWN, "down"},
    {GLFW_KEY_PAGE_UP, "page_up"},
    {GLFW_KEY_PAGE_DOWN, "page_down"},
    {GLFW_KEY_HOME, "home"},
    {GLFW_KEY_END, "end"},
    {GLFW_KEY_APOSTROPHE, "apostrophe"},
    {GLFW_KEY_COMMA, "comma"},
    {GLFW_KEY_MINUS, "minus"},
    {GLFW_KEY_PERIOD, "period"},
    {GLFW_KEY_SLASH, "slash"},
    {GLFW_KEY_SEMICOLON, "semicolon"},
    {GLFW_KEY_EQUAL, "equal"},
    {GLFW_KEY_LEFT_BRACKET, "left_bracket"},
    {GLFW_KEY_BACKSLASH, "backslash"},
    {GLFW_KEY_RIGHT_BRACKET, "right_bracket"},
    {GLFW_KEY_GRAVE_ACCENT, "grave"},
    {GLFW_KEY_KP_ADD, "plus"},
    {GLFW_KEY_KP_SUBTRACT, "minus"},
    {GLFW_KEY_KP_EQUAL, "equal"},
    {GLFW_KEY_F1, "f1"},
    {GLFW_KEY_F2, "f2"},
    {GLFW_KEY_F3, "f3"},
    {GLFW_KEY_F4, "f4"},
    {GLFW_KEY_F5, "f5"},
    {GLFW_KEY_F6, "f6"},
    {GLFW_KEY_F7, "f7"},
    {GLFW_KEY_F8, "f8"},
    {GLFW_KEY_F9, "f9"},
    {GLFW_KEY_F10, "f10"},
    {GLFW_KEY_F11, "f11"},
    {GLFW_KEY_F12, "f12"},
}};

struct NamedCharacter {
  char character;
  std::string_view name;
};
constexpr std::array<NamedCharacter, 13> named_characters = {{
    {'+', "plus"},
    {'-', "minus"},
    {'?', "question"},
    {'=', "equal"},
    {',', "comma"},
    {'.', "period"},
    {'/', "slash"},
    {';', "semicolon"},
    {'\'', "apostrophe"},
    {'`', "grave"},
    {'\\', "backslash"},
    {'[', "left_bracket"},
    {']', "right_bracket"},
}};

constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz", digits = "0123456789";

}  // namespace

std::string_view nameOfKey(int key) {
  if (key >= GLFW_KEY_A && key <= GLFW_KEY_Z)
    return letters.substr(static_cast<std::size_t>(key - GLFW_KEY_A), 1);
  if (key >= GLFW_KEY_0 && key <= GLFW_KEY_9)
    return digits.substr(static_cast<std::size_t>(key - GLFW_KEY_0), 1);
  if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9) {
    return digits.substr(static_cast<std::size_t>(key - GLFW_KEY_KP_0), 1);
  }
  const auto* const found = std::ranges::find(named_keys, key, &NamedKey::key);
  return found == named_keys.end() ? std::string_view() : found->name;
}

std::string nameOfCharacter(std::uint32_t character) {
  if (character >= 'A' && character <= 'Z') character += 'a' - 'A';
  if ((character >= 'a' && character <= 'z') || (character >= '0' && character <= '9')) {
    return {static_cast<char>(character)};
  }
  const auto* const found = std::ranges::find_if(named_characters, [&](const NamedCharacter& named) {
    return static_cast<std::uint32_t>(named.character) == character;
  });
  return found == named_characters.end() ? std::string() : std::string(found->name);
}

bool givesCharacter(int key) {
  return (key > GLFW_KEY_SPACE && key <= GLFW_KEY_WORLD_2) ||
         (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_ADD) || key == GLFW_KEY_KP_EQUAL;
}

}  // namespace vorpipe::view

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "view/window/window_parts.h"

namespace vorpipe::view {
namespace {

struct NamedKey {
  int key;
  std::string_view name;
};
constexpr auto named_keys = std::to_array<NamedKey>({
    {GLFW_KEY_SPACE, "space"},     {GLFW_KEY_ESCAPE, "escape"},
    {GLFW_KEY_ENTER, "enter"},     {GLFW_KEY_KP_ENTER, "enter"},
    {GLFW_KEY_TAB, "tab"},         {GLFW_KEY_BACKSPACE, "backspace"},
    {GLFW_KEY_INSERT, "insert"},   {GLFW_KEY_DELETE, "delete"},
    {GLFW_KEY_LEFT, "left"},       {GLFW_KEY_RIGHT, "right"},
    {GLFW_KEY_UP, "up"},           {GLFW_KEY_DOWN, "down"},
    {GLFW_KEY_PAGE_UP, "page_up"}, {GLFW_KEY_PAGE_DOWN, "page_down"},
    {GLFW_KEY_HOME, "home"},       {GLFW_KEY_END, "end"},
    {GLFW_KEY_KP_ADD, "plus"},     {GLFW_KEY_KP_SUBTRACT, "minus"},
    {GLFW_KEY_KP_EQUAL, "equal"},
});

struct NamedCharacter {
  char character;
  std::string_view name;
};
constexpr auto named_characters = std::to_array<NamedCharacter>({
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
});

/// Returns the name of the key for a character: 'A' is "a", '?' is "question"; empty if there is none. Empty
/// for blanks too: their key is named when it goes down.
std::string nameOfCharacter(std::uint32_t character) {
  if (character >= 'A' && character <= 'Z') character += 'a' - 'A';
  if ((character >= 'a' && character <= 'z') || (character >= '0' && character <= '9')) {
    return {static_cast<char>(character)};
  }
  const auto* const found = std::ranges::find_if(named_characters, [&](const NamedCharacter& named) {
    return static_cast<std::uint32_t>(named.character) == character;
  });
  return std::string(found == named_characters.end() ? "" : found->name);
}

/// Returns the name of a GLFW key by its position on an American keyboard; empty for keys without a name,
/// such as modifiers.
std::string nameOfKey(int key) {
  // GLFW numbers keys that give a character by that character in ASCII.
  if (key > GLFW_KEY_SPACE && key <= GLFW_KEY_GRAVE_ACCENT) {
    return nameOfCharacter(static_cast<std::uint32_t>(key));
  }
  if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9) return std::to_string(key - GLFW_KEY_KP_0);
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12) return "f" + std::to_string(key - GLFW_KEY_F1 + 1);
  const auto* const found = std::ranges::find(named_keys, key, &NamedKey::key);
  return std::string(found == named_keys.end() ? "" : found->name);
}

/// Whether a key gives a character, which then determines its name better than its position.
bool givesCharacter(int key) {
  return (key > GLFW_KEY_SPACE && key <= GLFW_KEY_WORLD_2) ||
         (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_ADD) || key == GLFW_KEY_KP_EQUAL;
}

// GLFW's callbacks get only the window, so its functions are kept here, from any Input.
const Glfw* shared = nullptr;

Input& inputOf(GLFWwindow* window) { return *static_cast<Input*>(shared->getWindowUserPointer(window)); }

Modifiers modifiersOf(int bits) {
#ifdef __APPLE__
  constexpr int control = GLFW_MOD_SUPER | GLFW_MOD_CONTROL;
#else
  constexpr int control = GLFW_MOD_CONTROL;
#endif
  return {(bits & GLFW_MOD_SHIFT) != 0, (bits & control) != 0, (bits & GLFW_MOD_ALT) != 0};
}

// GLFW does not report modifiers with the wheel.
Modifiers heldNow(const Glfw& glfw, GLFWwindow* window) {
  const auto held = [&](int left, int right) {
    return glfw.getKey(window, left) == GLFW_PRESS || glfw.getKey(window, right) == GLFW_PRESS;
  };
  return {held(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT),
          held(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL), held(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT)};
}

bool isAscii(std::string_view text) {
  return std::ranges::all_of(text, [](char byte) { return static_cast<unsigned char>(byte) < 0x80; });
}

// A key that gives a character is named by that character, when it arrives: only so '?' works on every
// keyboard. No character comes while Control or Alt is held, and those of other scripts have no name. Then
// the key's own character or its position determines the name.
void onKey(GLFWwindow* window, int key, int scancode, int action, int bits) {
  if (action == GLFW_RELEASE) return;
  Input& input = inputOf(window);
  const Modifiers with = modifiersOf(bits);
  std::string name = nameOfKey(key);
  if (givesCharacter(key)) {
    const char* const alone = input.glfw->getKeyName(key, scancode);
    const bool has_name = alone != nullptr && isAscii(alone);
    if (has_name && !with.control && !with.alt) return;
    if (has_name) {
      if (std::string given = nameOfCharacter(static_cast<unsigned char>(*alone)); !given.empty())
        name = std::move(given);
    }
  }
  if (!name.empty()) input.events.emplace_back(Key{std::move(name), with});
}

std::string utf8(std::uint32_t point) {
  if (point < 0x80) return {static_cast<char>(point)};
  const int following = point < 0x800 ? 1 : point < 0x10000 ? 2 : 3;
  std::string text{static_cast<char>((0xFF00U >> (following + 1) & 0xFFU) | point >> 6 * following)};
  for (int k = following - 1; k >= 0; --k) text += static_cast<char>(0x80U | (point >> 6 * k & 0x3FU));
  return text;
}

void onCharacter(GLFWwindow* window, unsigned int point) {
  Input& input = inputOf(window);
  if (std::string name = nameOfCharacter(point); !name.empty()) {
    // Held modifiers only produced the character, so they are dropped. Letters keep their name with Shift, so
    // they keep Shift.
    const bool is_letter = (point >= 'a' && point <= 'z') || (point >= 'A' && point <= 'Z');
    Modifiers with{};
    with.shift = is_letter && heldNow(*input.glfw, window).shift;
    input.events.emplace_back(Key{std::move(name), with});
  }
  input.events.emplace_back(Text{utf8(point)});
}

// GLFW uses the desktop's units, which may differ from pixels of the framebuffer.
Position inPixels(const Glfw& glfw, GLFWwindow* window, double x, double y) {
  int width = 0, height = 0, pixels_wide = 0, pixels_high = 0;
  glfw.getWindowSize(window, &width, &height);
  glfw.getFramebufferSize(window, &pixels_wide, &pixels_high);
  if (width <= 0 || height <= 0) return {x, y};
  return {x * pixels_wide / width, y * pixels_high / height};
}

void onMove(GLFWwindow* window, double x, double y) {
  Input& input = inputOf(window);
  input.events.emplace_back(Move{inPixels(*input.glfw, window, x, y)});
}

void onButton(GLFWwindow* window, int number, int action, int bits) {
  Input& input = inputOf(window);
  if (number > GLFW_MOUSE_BUTTON_MIDDLE) return;
  const Button button = number == GLFW_MOUSE_BUTTON_LEFT    ? Button::left
                        : number == GLFW_MOUSE_BUTTON_RIGHT ? Button::right
                                                            : Button::middle;
  input.events.push_back(action == GLFW_PRESS ? Event(Press{button, modifiersOf(bits)}) : Release{button});
}

// With Shift held, some desktops turn the wheel's steps sideways.
void onScroll(GLFWwindow* window, double sideways, double up) {
  Input& input = inputOf(window);
  input.events.emplace_back(Scroll{up != 0 ? up : sideways, heldNow(*input.glfw, window)});
}

void onDrop(GLFWwindow* window, int count, const char** paths) {
  inputOf(window).events.emplace_back(Drop{std::vector<std::string>(paths, paths + count)});
}

// The receiver of the event decides whether the window closes.
void onClose(GLFWwindow* window) {
  Input& input = inputOf(window);
  input.glfw->setWindowShouldClose(window, GLFW_FALSE);
  input.events.emplace_back(Close{});
}

void onIconify(GLFWwindow* window, int minimized) {
  Input& input = inputOf(window);
  if (input.minimized == (minimized == GLFW_TRUE)) return;
  input.minimized = minimized == GLFW_TRUE;
  input.events.push_back(input.minimized ? Event(Minimize{}) : Restore{});
}

// Of consecutive resizes only the last one counts. On some systems a minimized window has no pixels.
void onSize(GLFWwindow* window, int width, int height) {
  Input& input = inputOf(window);
  if (width <= 0 || height <= 0) return;
  if (!input.events.empty() && std::holds_alternative<Resize>(input.events.back())) input.events.pop_back();
  input.events.emplace_back(Resize{width, height});
}

// The desktop has lost part of the window's contents.
void onRefresh(GLFWwindow* window) {
  int width = 0, height = 0;
  inputOf(window).glfw->getFramebufferSize(window, &width, &height);
  onSize(window, width, height);
}

// Letters must be drawn anew.
void onScale(GLFWwindow* window, float /*x*/, float /*y*/) { onRefresh(window); }

}  // namespace

void listen(GLFWwindow* window, Input& input) {
  const Glfw& glfw = *input.glfw;
  shared = &glfw;
  glfw.setWindowUserPointer(window, &input);
  glfw.setKeyCallback(window, onKey);
  glfw.setCharCallback(window, onCharacter);
  glfw.setCursorPosCallback(window, onMove);
  glfw.setMouseButtonCallback(window, onButton);
  glfw.setScrollCallback(window, onScroll);
  glfw.setDropCallback(window, onDrop);
  glfw.setWindowCloseCallback(window, onClose);
  glfw.setWindowIconifyCallback(window, onIconify);
  glfw.setWindowRefreshCallback(window, onRefresh);
  glfw.setFramebufferSizeCallback(window, onSize);
  glfw.setWindowContentScaleCallback(window, onScale);
}

}  // namespace vorpipe::view

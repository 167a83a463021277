#include "view/window/input.h"

#include <string>
#include <utility>

#include "view/window/key_names.h"

namespace vorpipe::view {
namespace {

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

bool isAscii(const char* text) {
  for (; *text != '\0'; ++text) {
    if (static_cast<unsigned char>(*text) >= 0x80) return false;
  }
  return true;
}

// A key that gives a character is named by that character, when it arrives: only so '?' works on every
// keyboard. No character comes while Control or Alt is held, and those of other scripts have no name. Then
// the key's own character or its place determines the name.
void onKey(GLFWwindow* window, int key, int scancode, int action, int bits) {
  if (action == GLFW_RELEASE) return;
  Input& input = inputOf(window);
  const Modifiers with = modifiersOf(bits);
  std::string name(nameOfKey(key));
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
  std::string text;
  const auto put = [&](std::uint32_t byte) { text += static_cast<char>(byte); };
  const auto follow = [&](int shift) { put(0x80U | ((point >> shift) & 0x3FU)); };
  if (point < 0x80) {
    put(point);
  } else if (point < 0x800) {
    put(0xC0U | (point >> 6));
    follow(0);
  } else if (point < 0x10000) {
    put(0xE0U | (point >> 12));
    follow(6);
    follow(0);
  } else {
    put(0xF0U | (point >> 18));
    follow(12);
    follow(6);
    follow(0);
  }
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
Place inPixels(const Glfw& glfw, GLFWwindow* window, double x, double y) {
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
  if (action == GLFW_PRESS) {
    input.events.emplace_back(Press{button, modifiersOf(bits)});
  } else {
    input.events.emplace_back(Release{button});
  }
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
  if (input.minimized) {
    input.events.emplace_back(Minimize{});
  } else {
    input.events.emplace_back(Restore{});
  }
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

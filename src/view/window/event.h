/// Events, in the order in which they happened: a window reports them, and a script makes a window do the
/// same.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace vorpipe::view {

/// A position in a window, in pixels of the framebuffer from the left and the top.
struct Position {
  double x = 0, y = 0;
  friend bool operator==(const Position&, const Position&) = default;
};

enum class Button : std::uint8_t { left, right, middle };

/// Modifier keys held down with another key.
struct Modifiers {
  bool shift = false, control = false, alt = false;
  friend bool operator==(const Modifiers&, const Modifiers&) = default;
};

struct Move {
  Position to;
};
struct Press {
  Button button = Button::left;
  Modifiers with{};
};
struct Release {
  Button button = Button::left;
};
struct Scroll {
  double by = 0;  ///< steps of the wheel, up is positive
  Modifiers with{};
};
struct Key {
  std::string name;  ///< "a".."z", "0".."9", "f1", "escape", "tab", "space", "home", "left", "plus", "minus",
                     ///< "question" ...
  Modifiers with{};
};
struct Text {
  std::string utf8;  ///< typed into a field of the panel
};
struct Resize {
  int width = 0, height = 0;
};
struct Minimize {};
struct Restore {};
struct Drop {
  std::vector<std::string> paths;
};
struct Close {};
/// In scripts only. Waits until the window shows the sharp picture of all events before, or for `seconds` if
/// not 0.
struct Wait {
  double seconds = 0;
};
/// In scripts only. Writes what the window shows, with or without the panel, into a .png.
struct Screenshot {
  std::string path;
  bool panel = false;
};

using Event = std::variant<Move, Press, Release, Scroll, Key, Text, Resize, Minimize, Restore, Drop, Close,
                           Wait, Screenshot>;

}  // namespace vorpipe::view

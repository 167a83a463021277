// What a window tells of its user, and what it says where it cannot be opened.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "view/window/window.h"

namespace vorpipe::view {
namespace {

constexpr double longest = 10;  // seconds, that a desktop may take

std::string words(const Modifiers& with) {
  return std::string(with.shift ? " shift" : "") + (with.control ? " control" : "") +
         (with.alt ? " alt" : "");
}

// An event as one line; empty for what a desktop may tell at any time.
std::string line(const Event& event) {
  const auto number = [](double value) { return std::to_string(static_cast<int>(value)); };
  const auto button = [](Button which) { return std::to_string(static_cast<int>(which)); };
  if (const auto* const move = std::get_if<Move>(&event))
    return "move " + number(move->to.x) + ' ' + number(move->to.y);
  if (const auto* const press = std::get_if<Press>(&event))
    return "press " + button(press->button) + words(press->with);
  if (const auto* const release = std::get_if<Release>(&event)) return "release " + button(release->button);
  if (const auto* const scroll = std::get_if<Scroll>(&event))
    return "scroll " + number(scroll->by) + words(scroll->with);
  if (const auto* const key = std::get_if<Key>(&event)) return "key " + key->name + words(key->with);
  if (const auto* const text = std::get_if<Text>(&event)) return "text " + text->utf8;
  if (std::holds_alternative<Close>(event)) return "close";
  return {};
}

TEST(Input, TellsWhatAUserDoes) {
  WindowOptions options;
  options.title = "input";
  options.width = 300;
  options.height = 200;
  auto window = Window::open(options);
  ASSERT_TRUE(window.has_value()) << window.error().message;
  while (!window->events(0.05).empty()) {
  }
  const std::string command =
      std::string(std::getenv("VORPIPE_TEST_PYTHON")) + " " + VORPIPE_SEND_INPUT +
      " input move:30,40 press:1 move:50,60 release:1 press:3 release:3 press:4 release:4"
      " hold:Shift_L press:5 release:5 key:a key:slash let:Shift_L key:a key:plus key:space"
      " hold:Control_L key:z hold:Shift_L key:z let:Shift_L let:Control_L"
      " key:F1 key:Left key:Prior key:Tab key:Escape key:bracketleft close";
  ASSERT_EQ(std::system(command.c_str()), 0);
  std::vector<std::string> told;
  const auto begun = std::chrono::steady_clock::now();
  while ((told.empty() || told.back() != "close") &&
         std::chrono::steady_clock::now() - begun < std::chrono::duration<double>(longest)) {
    for (const Event& event : window->events(longest)) {
      if (std::string one = line(event); !one.empty()) told.push_back(std::move(one));
    }
  }
  EXPECT_EQ(told, (std::vector<std::string>{
                      "move 30 40",  "press 0",          "move 50 60",    "release 0",
                      "press 1",     "release 1",        "scroll 1",      "scroll -1 shift",
                      "key a shift", "text A",           "key question",  "text ?",
                      "key a",       "text a",           "key equal",     "text =",
                      "key space",   "text  ",           "key z control", "key z shift control",
                      "key f1",      "key left",         "key page_up",   "key tab",
                      "key escape",  "key left_bracket", "text [",        "close"}));
}

TEST(Opening, SaysThatThereIsNoDisplay) {
  const std::string display = std::getenv("DISPLAY");
  for (const auto& [api, none] : {std::pair(WindowApi::vulkan, ""), std::pair(WindowApi::opengl, ":60999")}) {
    ::setenv("DISPLAY", none, 1);
    WindowOptions options;
    options.api = api;
    const auto window = Window::open(options);
    ::setenv("DISPLAY", display.c_str(), 1);
    ASSERT_FALSE(window.has_value());
    EXPECT_EQ(window.error().code, ErrorCode::device);
    EXPECT_THAT(window.error().message, testing::StartsWith("no display: "));
    EXPECT_THAT(window.error().message, testing::Not(testing::HasSubstr("\n")));
  }
}

TEST(Opening, SaysThatThereIsNoSuchDevice) {
  WindowOptions options;
  options.device = "none of this name";
  const auto window = Window::open(options);
  ASSERT_FALSE(window.has_value());
  EXPECT_EQ(window.error().code, ErrorCode::device);
  EXPECT_THAT(window.error().message, testing::HasSubstr("no Vulkan device 'none of this name'"));
}

// Run with hide_glfw.cpp.
TEST(WithoutGlfw, AWindowSaysWhatToInstall) {
  const auto window = Window::open({});
  ASSERT_FALSE(window.has_value());
  EXPECT_EQ(window.error().code, ErrorCode::device);
  EXPECT_EQ(
      window.error().message,
      "a window needs GLFW, and libglfw.so.3 cannot be loaded: install libglfw3 (Debian, Ubuntu) or glfw "
      "(Fedora, Arch, Homebrew)");
}

}  // namespace
}  // namespace vorpipe::view

#include "view/feed.h"

#include <array>
#include <string_view>
#include <utility>
#include <variant>

#include <imgui.h>

namespace vorpipe::view {
namespace {

// Since 1.87, Dear ImGui takes input by functions; earlier versions by fields.
#if IMGUI_VERSION_NUM >= 18700
void feedPlace(Place place) {
  ImGui::GetIO().AddMousePosEvent(static_cast<float>(place.x), static_cast<float>(place.y));
}
void feedButton(Button button, bool down) {
  ImGui::GetIO().AddMouseButtonEvent(static_cast<int>(button), down);
}
void feedWheel(double steps) { ImGui::GetIO().AddMouseWheelEvent(0, static_cast<float>(steps)); }
void feedKey(int key, bool down) { ImGui::GetIO().AddKeyEvent(static_cast<ImGuiKey>(key), down); }
void feedModifiers(const Modifiers& with) {
  ImGuiIO& io = ImGui::GetIO();
  // Each frame sees all passed events: next() already separates those that must be apart.
  io.ConfigInputTrickleEventQueue = false;
#if IMGUI_VERSION_NUM >= 18900
  io.AddKeyEvent(ImGuiMod_Shift, with.shift);
  io.AddKeyEvent(ImGuiMod_Ctrl, with.control);
  io.AddKeyEvent(ImGuiMod_Alt, with.alt);
#else
  io.AddKeyEvent(ImGuiKey_ModShift, with.shift);
  io.AddKeyEvent(ImGuiKey_ModCtrl, with.control);
  io.AddKeyEvent(ImGuiKey_ModAlt, with.alt);
#endif
}
#else
void feedPlace(Place place) {
  ImGui::GetIO().MousePos = {static_cast<float>(place.x), static_cast<float>(place.y)};
}
void feedButton(Button button, bool down) { ImGui::GetIO().MouseDown[static_cast<int>(button)] = down; }
void feedWheel(double steps) { ImGui::GetIO().MouseWheel += static_cast<float>(steps); }
void feedKey(int key, bool down) {
  // Maps each ImGui key to itself.
  ImGui::GetIO().KeyMap[key] = key;
  ImGui::GetIO().KeysDown[key] = down;
}
void feedModifiers(const Modifiers& with) {
  ImGuiIO& io = ImGui::GetIO();
  io.KeyShift = with.shift;
  io.KeyCtrl = with.control;
  io.KeyAlt = with.alt;
}
#endif

// The keys for editing a number.
constexpr auto keys = std::to_array<std::pair<std::string_view, int>>({
    {"left", ImGuiKey_LeftArrow},
    {"right", ImGuiKey_RightArrow},
    {"up", ImGuiKey_UpArrow},
    {"down", ImGuiKey_DownArrow},
    {"home", ImGuiKey_Home},
    {"end", ImGuiKey_End},
    {"tab", ImGuiKey_Tab},
    {"enter", ImGuiKey_Enter},
    {"backspace", ImGuiKey_Backspace},
    {"delete", ImGuiKey_Delete},
    {"escape", ImGuiKey_Escape},
    {"a", ImGuiKey_A},
    {"c", ImGuiKey_C},
    {"v", ImGuiKey_V},
    {"x", ImGuiKey_X},
    {"y", ImGuiKey_Y},
    {"z", ImGuiKey_Z},
});

}  // namespace

bool Feed::next() {
  bool any = !held_.empty();
  for (const int key : held_) feedKey(key, false);
  held_.clear();
  bool moved = false;
  while (!events_.empty()) {
    // A drag follows the pointer only while the button is held, so the release comes a frame after the move.
    if (moved && std::holds_alternative<Release>(events_.front())) return true;
    const Event event = std::move(events_.front());
    events_.pop_front();
    if (const auto* move = std::get_if<Move>(&event)) {
      feedPlace(move->to);
      any = moved = true;
      continue;
    }
    if (const auto* press = std::get_if<Press>(&event)) {
      feedModifiers(press->with);
      feedButton(press->button, true);
      return true;
    }
    if (const auto* release = std::get_if<Release>(&event)) {
      feedButton(release->button, false);
      return true;
    }
    if (const auto* scroll = std::get_if<Scroll>(&event)) {
      feedModifiers(scroll->with);
      feedWheel(scroll->by);
      return true;
    }
    if (const auto* text = std::get_if<Text>(&event)) {
      // Modifiers still held from the previous key would turn the text into a command.
      feedModifiers({});
      ImGui::GetIO().AddInputCharactersUTF8(text->utf8.c_str());
      return true;
    }
    if (const auto* pressed = std::get_if<Key>(&event)) {
      feedModifiers(pressed->with);
      for (const auto& [name, key] : keys) {
        if (name != pressed->name) continue;
        feedKey(key, true);
        held_.push_back(key);
      }
      return true;
    }
  }
  return any;
}

}  // namespace vorpipe::view

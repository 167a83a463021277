#include "view/imgui_io.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string_view>
#include <utility>
#include <variant>

#include <imgui.h>

#include "io/pictures/font_file.h"

namespace vorpipe::view {
namespace {

// Since 1.87, Dear ImGui takes input by functions; earlier versions by fields.
#if IMGUI_VERSION_NUM >= 18700
void sendPosition(Position position) {
  ImGui::GetIO().AddMousePosEvent(static_cast<float>(position.x), static_cast<float>(position.y));
}
void sendButton(Button button, bool down) {
  ImGui::GetIO().AddMouseButtonEvent(static_cast<int>(button), down);
}
void sendWheel(double steps) { ImGui::GetIO().AddMouseWheelEvent(0, static_cast<float>(steps)); }
void sendKey(int key, bool down) { ImGui::GetIO().AddKeyEvent(static_cast<ImGuiKey>(key), down); }
void sendModifiers(const Modifiers& with) {
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
void sendPosition(Position position) {
  ImGui::GetIO().MousePos = {static_cast<float>(position.x), static_cast<float>(position.y)};
}
void sendButton(Button button, bool down) { ImGui::GetIO().MouseDown[static_cast<int>(button)] = down; }
void sendWheel(double steps) { ImGui::GetIO().MouseWheel += static_cast<float>(steps); }
void sendKey(int key, bool down) {
  // Maps each ImGui key to itself.
  ImGui::GetIO().KeyMap[key] = key;
  ImGui::GetIO().KeysDown[key] = down;
}
void sendModifiers(const Modifiers& with) {
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

std::int32_t inside(float value, int size) {
  return static_cast<std::int32_t>(std::clamp(value, 0.0F, static_cast<float>(size)));
}

void add(const ImDrawList& list, int width, int height, PanelTriangles& triangles) {
  const auto base = static_cast<std::uint32_t>(triangles.vertices.size());
  for (const ImDrawVert& vertex : list.VtxBuffer) {
    triangles.vertices.push_back({vertex.pos.x, vertex.pos.y, vertex.uv.x, vertex.uv.y, vertex.col});
  }
  for (const ImDrawCmd& command : list.CmdBuffer) {
    const PanelPart part{
        static_cast<std::uint32_t>(triangles.indices.size()), command.ElemCount,
        inside(std::floor(command.ClipRect.x), width),        inside(std::floor(command.ClipRect.y), height),
        inside(std::ceil(command.ClipRect.z), width),         inside(std::ceil(command.ClipRect.w), height)};
    if (part.indices == 0 || part.left >= part.right || part.top >= part.bottom) continue;
    for (unsigned i = 0; i < command.ElemCount; ++i) {
      const ImDrawIdx index = list.IdxBuffer[static_cast<int>(command.IdxOffset + i)];
      triangles.indices.push_back(base + command.VtxOffset + index);
    }
    triangles.parts.push_back(part);
  }
}

}  // namespace

bool InputQueue::next() {
  bool any = !held_.empty();
  for (const int key : held_) sendKey(key, false);
  held_.clear();
  bool moved = false;
  while (!events_.empty()) {
    // A drag follows the pointer only while the button is held, so the release comes a frame after the move.
    if (moved && std::holds_alternative<Release>(events_.front())) return true;
    const Event event = std::move(events_.front());
    events_.pop_front();
    if (const auto* move = std::get_if<Move>(&event)) {
      sendPosition(move->to);
      any = moved = true;
      continue;
    }
    if (const auto* press = std::get_if<Press>(&event)) {
      sendModifiers(press->with);
      sendButton(press->button, true);
      return true;
    }
    if (const auto* release = std::get_if<Release>(&event)) {
      sendButton(release->button, false);
      return true;
    }
    if (const auto* scroll = std::get_if<Scroll>(&event)) {
      sendModifiers(scroll->with);
      sendWheel(scroll->by);
      return true;
    }
    if (const auto* text = std::get_if<Text>(&event)) {
      // Modifiers still held from the previous key would turn the text into a command.
      sendModifiers({});
      ImGui::GetIO().AddInputCharactersUTF8(text->utf8.c_str());
      return true;
    }
    if (const auto* pressed = std::get_if<Key>(&event)) {
      sendModifiers(pressed->with);
      for (const auto& [name, key] : keys) {
        if (name != pressed->name) continue;
        sendKey(key, true);
        held_.push_back(key);
      }
      return true;
    }
  }
  return any;
}

PanelTexture drawFont(double scale) {
  // Pairs of first and last character, ended by 0. Dear ImGui keeps the pointer.
  static constexpr std::array<ImWchar, 11> ranges{0x20,   0x17F,  0x391,  0x3C9,  0x400, 0x45F,
                                                  0x2010, 0x2265, 0x25A0, 0x2715, 0};
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  atlas.Clear();
#if IMGUI_VERSION_NUM >= 19200
  // Otherwise the texture starts as RGBA, and GetTexDataAsAlpha8() would build it again.
  atlas.TexDesiredFormat = ImTextureFormat_Alpha8;
#endif
  atlas.Flags |= ImFontAtlasFlags_NoMouseCursors;
  ImFontConfig config;
  config.FontDataOwnedByAtlas = false;
  config.OversampleH = 2;
  config.OversampleV = 1;
  config.PixelSnapH = true;
  const std::span<const unsigned char> file = fontFile();
  // ImGui only reads it.
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast)
  auto* bytes = const_cast<unsigned char*>(file.data());
  atlas.AddFontFromMemoryTTF(bytes, static_cast<int>(file.size()),
                             std::max(6.0F, std::round(static_cast<float>(14 * scale))), &config,
                             ranges.data());
  PanelTexture texture;
  unsigned char* alpha = nullptr;
  atlas.GetTexDataAsAlpha8(&alpha, &texture.width, &texture.height);
  texture.alpha.assign(alpha, alpha + std::ptrdiff_t{texture.width} * texture.height);
  return texture;
}

void takeTriangles(int width, int height, PanelTriangles& triangles) {
  triangles.vertices.clear();
  triangles.indices.clear();
  triangles.parts.clear();
  const ImDrawData& drawn = *ImGui::GetDrawData();
  for (int i = 0; i < drawn.CmdListsCount; ++i) add(*drawn.CmdLists[i], width, height, triangles);
  if (triangles.parts.empty()) triangles.vertices.clear();
}

}  // namespace vorpipe::view
